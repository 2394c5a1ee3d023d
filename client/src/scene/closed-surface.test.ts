import { describe, expect, it } from "vitest";
import { facingOut } from "./closed-surface";

const CORNERS = Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1);
const TETRAHEDRON = Uint32Array.of(0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3);

describe("a closed surface", () => {
  it("that faces outwards stays as it is", () => {
    expect(facingOut(CORNERS, TETRAHEDRON)).toBe(TETRAHEDRON);
  });

  it("that faces inwards is turned", () => {
    const inwards = TETRAHEDRON.slice().reverse();
    const turned = facingOut(CORNERS, inwards);
    expect(turned).not.toBeNull();
    expect(facingOut(CORNERS, turned!)).toBe(turned);
    expect([...turned!].sort()).toEqual([...TETRAHEDRON].sort());
  });

  it("is none with a hole or a face that is turned about", () => {
    expect(facingOut(CORNERS, TETRAHEDRON.slice(3))).toBeNull();
    expect(facingOut(CORNERS, new Uint32Array(0))).toBeNull();
    const about = TETRAHEDRON.slice();
    [about[0], about[1]] = [about[1]!, about[0]!];
    expect(facingOut(CORNERS, about)).toBeNull();
  });
});
