import { describe, expect, it } from "vitest";
import type { Vec3 } from "../../../scene/vector";
import { about, after, angleOf, Ball, between, type Rotation, turned, UNTURNED } from "./branch-turn";

const near = (actual: readonly number[], wanted: readonly number[]) => {
  for (const [i, value] of wanted.entries()) {
    expect(actual[i]).toBeCloseTo(value, 6);
  }
};

const axes = { right: [1, 0, 0], up: [0, 1, 0] } as const;

describe("rotations", () => {
  it("turn one direction to another", () => {
    near(turned(between([2, 0, 0], [0, 0, 3]), [1, 0, 0]), [0, 0, 1]);
    near(turned(between([0, 1, 0], [0, -1, 0]), [0, 5, 0]), [0, -5, 0]);
  });

  it("leave what has no direction as it is", () => {
    expect(between([0, 0, 0], [1, 0, 0])).toEqual(UNTURNED);
    expect(about([0, 0, 0], 1)).toEqual(UNTURNED);
  });

  it("follow each other in their order", () => {
    const [first, second] = [about([0, 1, 0], 1.1), about([1, 0, 0], -0.4)];
    const v: Vec3 = [0.3, -2, 1];
    near(turned(after(second, first), v), turned(second, turned(first, v)));
  });

  it("know how far they turn", () => {
    expect(angleOf(about([3, 1, 2], 0.7))).toBeCloseTo(0.7, 9);
    const negated = about([3, 1, 2], 0.7).map((value) => -value) as unknown as Rotation;
    expect(angleOf(negated)).toBeCloseTo(0.7, 9);
  });
});

describe("a ball around a branch's base", () => {
  const grips: readonly Vec3[] = [
    [4, 0, 0],
    [1, 3, 2],
    [-1, 2, -2.5],
  ];

  it("keeps what is held under the finger", () => {
    for (const grip of grips) {
      const ball = new Ball(grip, 0.5, axes);
      for (const [right, up] of [
        [1, 1],
        [-2, 0.5],
        [0, -2.4],
      ] as const) {
        near(turned(ball.to(right, up), grip).slice(0, 2), [right, up]);
      }
    }
  });

  it("turns back when the finger comes back", () => {
    for (const grip of grips) {
      const ball = new Ball(grip, 0.5, axes);
      expect(angleOf(ball.to(grip[0], grip[1]))).toBeCloseTo(0, 6);
    }
  });

  it("turns in the plane of the screen along its edge", () => {
    const ball = new Ball([4, 0, 0], 0.5, axes);
    near(turned(ball.to(0, 9), [4, 0, 0]), [0, 4, 0]);
    near(turned(ball.to(-3, -3), [4, 0, 0]), [-4 / Math.SQRT2, -4 / Math.SQRT2, 0]);
  });

  it("is never so small that a finger trembles it round", () => {
    const ball = new Ball([0.01, 0, 0], 2, axes);
    expect(angleOf(ball.to(0.21, 0))).toBeLessThan(0.11);
  });
});
