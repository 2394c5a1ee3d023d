import { describe, expect, it } from "vitest";
import { CROWN_SIDE, crownField } from "./crown-field";

/** A ball of leaves in the middle of the box. */
function ball(radius: number): Float32Array<ArrayBuffer> {
  const area = new Float32Array(CROWN_SIDE ** 3);
  const middle = (CROWN_SIDE - 1) / 2;
  for (let at = 0; at < area.length; at += 1) {
    const [x, y, z] = placeOf(at);
    if (Math.hypot(x - middle, y - middle, z - middle) < radius) area[at] = 0.4;
  }
  return area;
}

function placeOf(at: number): [number, number, number] {
  return [at % CROWN_SIDE, Math.floor(at / CROWN_SIDE) % CROWN_SIDE, Math.floor(at / CROWN_SIDE ** 2)];
}

const cell = [1, 1, 1] as const;
const field = crownField({ area: ball(9), cell });
const at = (x: number, y: number, z: number) => {
  const first = 4 * ((z * CROWN_SIDE + y) * CROWN_SIDE + x);
  return [...field.subarray(first, first + 4)] as [number, number, number, number];
};

describe("a ball of leaves", () => {
  it("is the same whenever it is looked at", () => {
    expect(crownField({ area: ball(9), cell })).toEqual(field);
  });

  it("has its way out away from its middle, and the surer the further out", () => {
    expect(at(24, 16, 16)[0]).toBeGreaterThan(215);
    expect(at(7, 16, 16)[0]).toBeLessThan(40);
    expect(at(16, 24, 16)[1]).toBeGreaterThan(215);
    expect(at(16, 16, 7)[2]).toBeLessThan(40);
    expect(Math.abs(at(16, 16, 16)[0] - 127.5)).toBeLessThan(60);
  });

  it("is alike on opposite sides", () => {
    for (let y = 0; y < CROWN_SIDE; y += 5) {
      for (let x = 0; x < CROWN_SIDE; x += 3) {
        expect(Math.abs(at(x, y, 16)[0] + at(CROWN_SIDE - 1 - x, y, 16)[0] - 255)).toBeLessThanOrEqual(2);
      }
    }
  });

  it("sees the sky at its top, little of it inside, and some of it below", () => {
    expect(at(16, 26, 16)[3]).toBeGreaterThan(210);
    expect(at(16, 12, 16)[3]).toBeLessThan(90);
    expect(at(16, 2, 16)[3]).toBeGreaterThan(at(16, 8, 16)[3]);
    expect(at(1, 30, 1)[3]).toBe(255);
  });
});

it("where nothing stands there is all of the sky and no way out", () => {
  const nothing = crownField({ area: new Float32Array(CROWN_SIDE ** 3), cell });
  for (let each = 0; each < nothing.length; each += 4) {
    expect(nothing[each + 3]).toBe(255);
    expect(Math.abs(nothing[each]! - 127.5)).toBeLessThan(1);
  }
});
