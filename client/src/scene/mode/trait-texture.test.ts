import type { DataTexture, Vector2 } from "three";
import { describe, expect, it } from "vitest";
import { PlainTable } from "../../../test/plain-table";
import { sampleTree } from "../../../test/sample-tree";
import type { Uniforms } from "../materials";
import type { TreeTable } from "../table/tree-table";
import { DRAW_MODES, type DrawMode } from "./draw-mode";
import { TraitTexture } from "./trait-texture";

function grown(): TreeTable {
  const table = new PlainTable(() => 0);
  table.apply(sampleTree({ seed: 3, height: 26, orders: 3 }));
  return table;
}

/** What a shader would read of a row, from 0 for the first colour to 1 for the last. */
function shareOf(uniforms: Uniforms, row: number): number {
  const texture: DataTexture = uniforms.uTraits!.value;
  const ends: Vector2 = uniforms.uTraitEnds!.value;
  const value = (texture.image.data as Float32Array)[row]!;
  return (value - ends.x) / (ends.y - ends.x);
}

function showing(mode: DrawMode, table: TreeTable): { uniforms: Uniforms; traits: TraitTexture } {
  const uniforms: Uniforms = {};
  const traits = new TraitTexture(uniforms);
  traits.show(mode);
  traits.upload(table);
  return { uniforms, traits };
}

describe("what a draw mode shows", () => {
  it.each(DRAW_MODES)("%s has a legend if it shows a number", (mode) => {
    const { uniforms, traits } = showing(mode, grown());
    const { legend } = traits;
    expect(uniforms.uMode!.value).toBe(DRAW_MODES.indexOf(mode));
    expect(legend === null).toBe(["lit", "skeleton", "wireframe"].includes(mode));
    if (!legend) return;
    expect(legend.range[0]).toBeLessThan(legend.range[1]);
    expect(legend.colours.every((colour) => /^rgb\(\d+ \d+ \d+\)$/.test(colour))).toBe(true);
  });

  it("exposure and vigor are shares of the most there can be", () => {
    const table = grown();
    for (const [mode, of] of [
      ["exposure", (row: number) => table.light[row]! / 255],
      ["vigor", (row: number) => (table.foliage[row]! >> 4) / 15],
    ] as const) {
      const { uniforms } = showing(mode, table);
      for (let row = 0; row < table.rows; row += 7) expect(shareOf(uniforms, row)).toBeCloseTo(of(row), 5);
    }
  });

  it("the youngest are 0 and the oldest 1 by age", () => {
    const table = grown();
    const { uniforms, traits } = showing("age", table);
    const living = Array.from({ length: table.rows }, (_, row) => row).filter((row) => table.radiusCode[row] !== 0);
    const born = living.map((row) => table.born[row]!);
    const [first, last] = [Math.min(...born), Math.max(...born)];
    expect(traits.legend!.range).toEqual([0, last - first]);
    expect(shareOf(uniforms, living[born.indexOf(last)]!)).toBeCloseTo(0);
    expect(shareOf(uniforms, living[born.indexOf(first)]!)).toBeCloseTo(1);
  });

  it("what changes later is shown, and rows cut off are not counted", () => {
    const table = grown();
    const { uniforms, traits } = showing("order", table);
    expect(traits.legend!.range[1]).toBe(3);
    table.light[5] = 77;
    traits.show("exposure");
    traits.upload(table);
    expect(shareOf(uniforms, 5)).toBeCloseTo(77 / 255, 5);
    table.light[5] = 255;
    traits.update(5, false);
    traits.upload(table);
    expect(shareOf(uniforms, 5)).toBe(1);
    traits.show("order");
    table.apply({
      epoch: 1,
      sequence: 2,
      catchUp: true,
      changes: [{ change: "truncate", rows: 20, chunk: 0, generation: 2 } as never],
    });
    traits.truncate(20);
    traits.upload(table);
    expect(traits.legend!.range[1]).toBe(1);
  });

  it("is uploaded whole, for three.js takes each texel of a part for four numbers", () => {
    const table = grown();
    const { uniforms, traits } = showing("exposure", table);
    const texture: DataTexture = uniforms.uTraits!.value;
    const before = texture.version;
    traits.update(table.rows - 1, false);
    traits.upload(table);
    expect(texture.version).toBeGreaterThan(before);
    expect(texture.updateRanges).toEqual([]);
  });
});
