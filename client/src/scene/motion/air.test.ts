import { BufferGeometry, Group, Mesh, RawShaderMaterial } from "three";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { SWAYING_TREES, tableOfSwaying } from "../../../test/swaying-trees";
import { BRANCH_VERTEX, branchFragment } from "../glsl/branch";
import { Air, type AirStage } from "./air";
import { type AirSettings, CALM } from "./air-settings";
import type { SharedClock } from "./shared-clock";

const SCALE = { internodeLength: 0.1, leafSize: 1 };
const BREEZE: AirSettings = { ...CALM, speed: 5, direction: 0, turbulence: 0.5 };
const STORM: AirSettings = { ...CALM, speed: 18, direction: 170, turbulence: 0.8 };
const SNOW: AirSettings = { ...CALM, snow: 0.15 };
/** Milliseconds from one frame to the next. */
const FRAME = 10;
/** What changes by no more from frame to frame does not jump. */
const SMALL = 0.02;

beforeEach(() => {
  vi.stubGlobal("document", { hidden: false, addEventListener: () => {}, removeEventListener: () => {} });
});
afterEach(() => vi.unstubAllGlobals());

/** A tree in the wind that is drawn by nothing; programs are made once `link` says so. */
function setUp() {
  const links: (() => void)[] = [];
  const drawn = { wind: 0 };
  const renderer = {
    compileAsync: () => new Promise<void>((resolve) => links.push(resolve)),
    getRenderTarget: () => null,
    setRenderTarget: () => {},
    render: () => {
      drawn.wind += 1;
    },
  };
  const table = tableOfSwaying(SWAYING_TREES[1]!);
  const material = new RawShaderMaterial({ vertexShader: BRANCH_VERTEX, fragmentShader: branchFragment() });
  const uniforms: Record<string, { value: unknown }> = { uNodes: { value: null } };
  const world = {
    uniforms,
    table,
    tree: { group: new Group().add(new Mesh(new BufferGeometry(), material)), casters: new Group(), overlays: null },
    sun: { margin: 0 },
    obstacles: { shown: [] },
    ghost: { group: { visible: false } },
    shadow: { stale: false },
  };
  const stage = { renderer, world, control: { moved: () => {} }, invalidate: () => {} } as unknown as AirStage;
  let now = 100_000;
  const clock = { read: () => ({ time: now / 1000, jumped: false }) } as unknown as SharedClock;
  const air = new Air(stage, clock);
  return {
    air,
    world,
    drawn,
    set: (settings: AirSettings, told: number | null = null) => air.set(settings, SCALE, 1, told),
    time: () => now / 1000,
    wait: (milliseconds: number) => {
      now += milliseconds;
    },
    frame: () => {
      now += FRAME;
      return air.step(now);
    },
    link: async () => {
      for (const done of links.splice(0)) done();
      await new Promise((resolve) => setTimeout(resolve));
    },
    white: () => (uniforms.uWeather!.value as number[])[0]!,
    lee: () => (uniforms.uLee!.value as { x: number; z: number }).x,
    /** Where some rows are seen. */
    places: () =>
      Array.from({ length: Math.ceil(table.rows / 7) }, (_, i) =>
        air.seenAt(7 * i, { placeOf: () => [0, 0, 0], hides: () => false } as never),
      ),
    /** How far the picture is from the tree as it grew, at its furthest row. */
    lean: () => {
      let far = 0;
      for (let row = 0; row < table.rows; row += 7) {
        const seen = air.seenAt(row, { placeOf: () => [0, 0, 0], hides: () => false } as never);
        far = Math.max(far, ...[0, 1, 2].map((a) => Math.abs(seen[a]! - table.course.placed[3 * row + a]!)));
      }
      return far;
    },
  };
}

type Page = ReturnType<typeof setUp>;

/** Frames of so many milliseconds; what is seen in each. */
function frames<Seen>(page: Page, milliseconds: number, seen: () => Seen): Seen[] {
  return Array.from({ length: milliseconds / FRAME }, () => {
    page.frame();
    return seen();
  });
}

function jump(numbers: readonly number[]): number {
  return Math.max(...numbers.slice(1).map((each, i) => Math.abs(each - numbers[i]!)));
}

describe("the wind in the picture", () => {
  it("rises from none once programs and joints are made, however long that takes", async () => {
    const page = setUp();
    page.set({ ...BREEZE, snow: 0.15 }, page.time() - 0.2);
    frames(page, 3000, () => {});
    expect(page.air.blowing).toBe(false);
    await page.link();
    const white = [0, ...frames(page, 2000, page.white)];
    expect(jump(white)).toBeLessThan(SMALL);
    expect(white.at(-1)).toBe(1);
  });

  it("rises from none where none has blown for long, and then is not what blew before", async () => {
    const page = setUp();
    page.set(SNOW);
    page.frame();
    await page.link();
    frames(page, 3000, () => {});
    page.set(CALM);
    frames(page, 3000, () => {});
    expect(page.air.blowing).toBe(false);
    page.wait(60_000);
    page.set(BREEZE);
    const seen = [{ white: 0, lean: 0 }, ...frames(page, 3000, () => ({ white: page.white(), lean: page.lean() }))];
    expect(Math.max(...seen.map(({ white }) => white)), "snow is long gone").toBe(0);
    expect(seen[1]!.lean).toBeLessThan(0.001);
    expect(seen.at(-1)!.lean).toBeGreaterThan(0.01);
  });

  it("takes snow off by and by in a calm, and leaves turn by and by to another wind", async () => {
    const page = setUp();
    page.set({ ...BREEZE, snow: 0.15 });
    page.frame();
    await page.link();
    frames(page, 3000, () => {});
    page.set(STORM);
    const seen = [[1, 1], ...frames(page, 3000, () => [page.white(), page.lee()])];
    expect(jump(seen.map(([white]) => white!))).toBeLessThan(SMALL);
    // From one side to nearly the other.
    expect(jump(seen.map(([, lee]) => lee!))).toBeLessThan(3 * SMALL);
    expect(seen.at(-1)![1]).toBeCloseTo(Math.cos((170 * Math.PI) / 180));
    page.set(SNOW);
    frames(page, 3000, () => {});
    expect(page.white()).toBe(1);
    page.set(CALM);
    expect(jump([1, ...frames(page, 1500, page.white)])).toBeLessThan(SMALL);
    expect(page.air.blowing).toBe(false);
  });

  it("is the same on a page that is opened while one wind takes over from another, as soon as it has risen there", async () => {
    const [first, late] = [setUp(), setUp()];
    first.set(BREEZE, first.time() - 60);
    first.frame();
    await first.link();
    frames(first, 3000, () => {});
    const told = first.time();
    first.set(STORM, told);
    frames(first, 600, () => {});
    late.wait(1000 * (first.time() - late.time()) - FRAME);
    late.set(STORM, told);
    late.frame();
    await late.link();
    expect(late.time()).toBeCloseTo(first.time(), 9);
    const apart = () => {
      const [a, b] = [first.places(), late.places()];
      return Math.max(...a.flatMap((place, row) => place.map((each, axis) => Math.abs(each - b[row]![axis]!))));
    };
    const gaps: number[] = [];
    for (let gone = 0; gone < 1500; gone += FRAME) {
      first.frame();
      late.frame();
      gaps.push(apart());
    }
    expect(gaps[0], "there it rises from none").toBeGreaterThan(0.1);
    expect(jump(gaps), "and nothing jumps").toBeLessThan(0.2);
    expect(gaps.at(-1)).toBe(0);
    frames(first, 1000, () => {});
    frames(late, 1000, () => {});
    expect(apart()).toBe(0);
  });

  it("goes on while finer shaders are made ready", async () => {
    const page = setUp();
    page.set(BREEZE);
    page.frame();
    await page.link();
    frames(page, 2000, () => {});
    const [mesh] = page.world.tree.group.children as [Mesh<BufferGeometry, RawShaderMaterial>];
    mesh.material.fragmentShader = `${branchFragment()}\n`;
    page.air.redress();
    const { wind } = page.drawn;
    expect(page.air.blowing).toBe(true);
    expect(page.frame()).toBe(true);
    expect(page.drawn.wind).toBe(wind + 1);
    await page.link();
    page.frame();
    expect(page.air.blowing).toBe(true);
  });

  it("goes on taking over where joints are made anew meanwhile", async () => {
    const page = setUp();
    page.set({ ...BREEZE, snow: 0.15 });
    page.frame();
    await page.link();
    frames(page, 3000, () => {});
    page.set(STORM);
    frames(page, 700, () => {});
    const before = page.white();
    expect(before).toBeGreaterThan(0.3);
    // Softer wood takes other joints.
    page.set({ ...STORM, suppleness: 2 });
    expect(jump([before, ...frames(page, 2000, page.white)])).toBeLessThan(SMALL);
    expect(page.white()).toBe(0);
  });
});
