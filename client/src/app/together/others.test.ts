import { describe, expect, it } from "vitest";
import type { Vec3 } from "../../scene/vector";
import { Others } from "./others";
import { besideWood, onWood } from "./wood-place";

/** A metamer from its parent's end to its own, which a hand may move. */
function wood() {
  const places: (Vec3 | null)[] = [
    [0, 0, 0],
    [0, 2, 0],
  ];
  return { places, placeOf: (row: number) => places[row] ?? null, parentOf: (row: number) => row - 1 };
}

describe("places on wood", () => {
  it("PS1: come back as they were, whichever way the metamer points", () => {
    const ends: Vec3[] = [
      [0, 2, 0],
      [1, -0.5, 3],
      [0.01, 1, 0],
      [-2, 0, 0],
    ];
    for (const end of ends) {
      const point: Vec3 = [0.4, 1.5, -0.7];
      const back = onWood(besideWood(point, [0.1, 0, 0], end), [0.1, 0, 0], end);
      for (const [axis, value] of back.entries()) expect(value).toBeCloseTo(point[axis]!, 6);
    }
  });
});

describe("others", () => {
  it("PS1: a pointer on wood rides with it", () => {
    const tree = wood();
    const others = new Others(tree);
    const place = { kind: "wood", row: 1, along: 0.5, offset: [0, 0, 0] } as const;
    others.take([{ device: 2, pointer: { place, radius: 0 } }], 0);
    expect(others.pointer(2, 1000)?.at).toEqual([0, 1, 0]);
    tree.places[1] = [2, 2, 0];
    expect(others.pointer(2, 1000)?.at).toEqual([1, 1, 0]);
    tree.places[1] = null;
    expect(others.pointer(2, 1000)).toBeNull();
  });

  it("PS2: what is not new stays as it was", () => {
    const others = new Others(wood());
    const place = { kind: "space", position: [1, 2, 3] } as const;
    others.take([{ device: 2, pointer: { place, radius: 4 }, sketch: [[0, 0, 0]], camera: [0, 1, 0, 2, 3, 4] }], 0);
    others.take([{ device: 2, camera: [0, 1, 0, 9, 3, 4] }], 50);
    expect(others.pointer(2, 1000)).toEqual({ at: [1, 2, 3], radius: 4 });
    expect(others.sketch(2)).toHaveLength(1);
    expect(others.camera(2)?.[3]).toBe(9);
    others.take([{ device: 2, pointer: { place: { kind: "nowhere" }, radius: 0 }, sketch: [] }], 100);
    expect([others.pointer(2, 1000), others.sketch(2)]).toEqual([null, []]);
  });

  it("a pointer goes to its next place without a jump, and is soon there", () => {
    const others = new Others(wood());
    const point = (x: number, now: number) =>
      others.take([{ device: 2, pointer: { place: { kind: "space", position: [x, 0, 0] }, radius: 0 } }], now);
    point(0, 0);
    point(8, 1000);
    const at = (now: number) => others.pointer(2, now)!.at[0];
    expect(at(1000)).toBe(0);
    expect(at(1030)).toBeCloseTo(4);
    expect(at(1300)).toBeCloseTo(8, 1);
    point(0, 1030);
    expect(at(1030)).toBeCloseTo(4);
    expect(others.still(2, 4030)).toBe(3000);
  });

  it("who has left is forgotten", () => {
    const others = new Others(wood());
    others.take([{ device: 2, camera: [0, 1, 0, 2, 3, 4] }], 0);
    others.take([{ device: 3, camera: [0, 1, 0, 2, 3, 4] }], 0);
    others.keep(new Set([3]));
    expect([others.camera(2), others.camera(3)?.length]).toEqual([null, 6]);
  });
});
