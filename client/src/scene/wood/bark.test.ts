import { readFileSync } from "node:fs";
import { describe, expect, it, vi } from "vitest";
import { idlePainter } from "../../../test/idle-painter";
import { type BarkKind, DEFAULT_APPEARANCE } from "../../wire/generated";
import type { Uniforms } from "../materials";
import { cells, noCell, turbulence, waves } from "../painting/bark-noise";
import { barkPalette } from "../painting/bark-palette";
import { BARK_PATTERNS } from "../painting/bark-pattern";
import { type BarkTexels, barkTexels } from "../painting/bark-relief";
import { Bark } from "./bark";

const KINDS = Object.keys(BARK_PATTERNS) as BarkKind[];
const SIDE = 64;
const PLAIN_BARK = { ...DEFAULT_APPEARANCE.bark, kind: "furrowed" as const };

/** Mean difference of heights between each line of texels and the next, the last one's next being the first. */
function steps({ colours }: BarkTexels, next: "across" | "along"): number[] {
  const height = (x: number, y: number) => colours[4 * ((y % SIDE) * SIDE + (x % SIDE)) + 3]!;
  return Array.from({ length: SIDE }, (_, i) => {
    let sum = 0;
    for (let j = 0; j < SIDE; j += 1) {
      sum += next === "across" ? Math.abs(height(i + 1, j) - height(i, j)) : Math.abs(height(j, i + 1) - height(j, i));
    }
    return sum / SIDE;
  });
}

describe("noise", () => {
  it("comes again after one square, around and along", () => {
    const fields = [waves(5, 3, 1), turbulence(3, 4, 3, 2)];
    for (const field of fields) {
      for (const [u, v] of [
        [0.123, 0.9],
        [0.999, 0.001],
      ] as const) {
        expect(field(u + 1, v)).toBeCloseTo(field(u, v), 5);
        expect(field(u, v - 1)).toBeCloseTo(field(u, v), 5);
      }
    }
    const cell = cells(4, 6, 0.9, 3);
    expect(cell(1.01, 0.5, noCell()).nearest).toBeCloseTo(cell(0.01, 0.5, noCell()).nearest, 5);
  });

  it("finds no middle of a cell nearer than the nearest", () => {
    const cell = cells(5, 5, 1, 4);
    for (let i = 0; i < 200; i += 1) {
      const { nearest, second, across, along } = cell((i * 0.37) % 1, (i * 0.73) % 1, noCell());
      expect(second).toBeGreaterThanOrEqual(nearest);
      expect(Math.hypot(across, along)).toBeCloseTo(nearest, 5);
    }
  });
});

describe.each(KINDS)("%s bark", (kind) => {
  const texels = barkTexels(kind, SIDE);

  it("has no seam", () => {
    for (const next of ["across", "along"] as const) {
      const all = steps(texels, next);
      const seam = all.pop()!;
      expect(seam, next).toBeLessThanOrEqual(Math.max(...all));
    }
  });

  it("is rough, and of more than one colour", () => {
    const { colours, relief } = texels;
    const spread = (from: Uint8Array, channel: number) => {
      const values = from.filter((_, i) => i % 4 === channel);
      return Math.max(...values) - Math.min(...values);
    };
    for (const channel of [0, 1]) expect(spread(relief, channel)).toBeGreaterThan(3);
    expect(spread(colours, 0)).toBeGreaterThan(40);
    expect(Math.max(spread(colours, 1), spread(colours, 2))).toBeGreaterThan(60);
    for (let at = 0; at < colours.length; at += 4) {
      expect(colours[at + 1]! + colours[at + 2]!).toBeLessThanOrEqual(256);
    }
  });

  it("is the same every time", () => {
    expect(barkTexels(kind, SIDE)).toEqual(texels);
  });
});

it("slopes tell how heights rise", () => {
  const { colours, relief } = barkTexels("papery", SIDE);
  let agreeing = 0;
  let compared = 0;
  for (let y = 0; y < SIDE; y += 1) {
    for (let x = 1; x + 1 < SIDE; x += 1) {
      const at = 4 * (y * SIDE + x);
      const rise = colours[at + 4 + 3]! - colours[at - 4 + 3]!;
      const slope = relief[at]! - 127.5;
      if (Math.abs(rise) < 8) continue;
      compared += 1;
      if (Math.sign(rise) === Math.sign(slope)) agreeing += 1;
    }
  }
  expect(compared).toBeGreaterThan(50);
  expect(agreeing).toBe(compared);
});

describe("a palette", () => {
  it("has the tint itself, as light", () => {
    expect(barkPalette("furrowed", [255, 0, 188])[0]).toEqual([1, 0, expect.closeTo(0.503, 3)]);
  });

  it("is that of exports", () => {
    const file = new URL("../../../../server/export/golden/bark.json", import.meta.url);
    for (const { kind, tint, palette } of JSON.parse(readFileSync(file, "utf8"))) {
      const found = barkPalette(kind, tint).flat();
      for (const [i, wanted] of palette.flat().entries()) expect(found[i]).toBeCloseTo(wanted, 4);
    }
  });

  it("has a pine's limbs redder than its trunk", () => {
    const [trunk, , , , limb] = barkPalette("plated", [128, 102, 84]);
    expect(limb[0] / limb[2]).toBeGreaterThan(1.5 * (trunk[0] / trunk[2]));
  });

  it.each(KINDS)("of %s follows the tint in all its colours", (kind) => {
    const [dark, light] = [barkPalette(kind, [60, 60, 60]), barkPalette(kind, [200, 200, 200])];
    for (const [i, colour] of dark.entries()) {
      for (const [channel, value] of colour.entries()) expect(value).toBeLessThan(light[i]![channel]!);
    }
  });
});

describe("the bark worn", () => {
  const setUp = () => {
    const uniforms: Uniforms = {};
    return { uniforms, bark: new Bark(uniforms, idlePainter()) };
  };

  it("keeps its textures while only colour and shape change", () => {
    const { uniforms, bark } = setUp();
    bark.setLook(PLAIN_BARK);
    const texture = uniforms.uBarkRelief!.value;
    bark.setLook({ ...PLAIN_BARK, tint: [1, 2, 3], relief: 2, smoothing: 0 });
    expect(uniforms.uBarkRelief!.value).toBe(texture);
    expect(uniforms.uBarkShape!.value.toArray()).toEqual([2, 1, 1, 0]);
  });

  it("lets go of the textures of the kind before", () => {
    const { uniforms, bark } = setUp();
    bark.setLook(PLAIN_BARK);
    const texture = uniforms.uBarkColours!.value;
    const gone = vi.fn();
    texture.addEventListener("dispose", gone);
    bark.setLook({ ...PLAIN_BARK, kind: "papery" });
    expect(uniforms.uBarkColours!.value).not.toBe(texture);
    expect(gone).toHaveBeenCalledOnce();
  });

  it("is uploaded anew to a restored context", () => {
    const { uniforms, bark } = setUp();
    bark.setLook(PLAIN_BARK);
    const before = uniforms.uBarkRelief!.value.version;
    bark.restored();
    expect(uniforms.uBarkRelief!.value.version).toBeGreaterThan(before);
  });
});
