import { BoxGeometry, Matrix4, Mesh, PerspectiveCamera } from "three";
import { describe, expect, it } from "vitest";
import { cellOf, coveredCells, isBare } from "./covered";
import { MOST_TUFTS, tuftsAt } from "./tufts";

/** What an eye sees that looks at the origin from so far, turned around it. */
function seenFrom(turn: number, distance = 40): { eye: [number, number, number]; sight: Matrix4 } {
  const camera = new PerspectiveCamera(35, 1.4, 0.1, 2000);
  const eye: [number, number, number] = [distance * Math.sin(turn), 8, distance * Math.cos(turn)];
  camera.position.set(...eye);
  camera.lookAt(0, 6, 0);
  camera.updateMatrixWorld();
  camera.updateProjectionMatrix();
  return { eye, sight: new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse) };
}

const places = (tufts: Float32Array) => {
  const found = new Map<string, number>();
  for (let at = 0; at < tufts.length; at += 4) found.set(`${tufts[at]} ${tufts[at + 1]}`, tufts[at + 3]!);
  return found;
};

describe("tufts of grass", () => {
  const { eye, sight } = seenFrom(0);
  const tufts = tuftsAt(eye, sight, 250);

  it("are many and never too many", () => {
    expect(tufts.length / 4).toBeGreaterThan(4000);
    expect(tufts.length / 4).toBeLessThanOrEqual(MOST_TUFTS);
  });

  it("are the same ones whenever they are seen, and grow into the picture", () => {
    const before = places(tufts);
    const turned = seenFrom(0.02);
    const after = places(tuftsAt(turned.eye, turned.sight, 250));
    const kept = [...before].filter(([place]) => after.has(place));
    expect(kept.length).toBeGreaterThan(0.9 * before.size);
    const changes = kept.map(([place, tall]) => Math.abs(after.get(place)! - tall));
    expect(Math.max(...changes)).toBeLessThan(0.35);
  });

  it("stand nowhere but before the eye, and no further than they are seen", () => {
    for (let at = 0; at < tufts.length; at += 4) {
      expect(Math.hypot(tufts[at]! - eye[0], eye[1], tufts[at + 1]! - eye[2])).toBeLessThanOrEqual(340);
      expect(tufts[at + 3]).toBeGreaterThanOrEqual(0);
      expect(tufts[at + 3]).toBeLessThanOrEqual(1);
    }
  });

  it("stand in few bunches on sand, the same ones from everywhere", () => {
    const few = tuftsAt(eye, sight, 250, undefined, true);
    expect(few.length / 4).toBeGreaterThan(30);
    expect(few.length).toBeLessThan(tufts.length / 5);
    const turned = seenFrom(0.02);
    const after = places(tuftsAt(turned.eye, turned.sight, 250, undefined, true));
    const kept = [...places(few).keys()].filter((place) => after.has(place));
    expect(kept.length).toBeGreaterThan(0.8 * (few.length / 4));
  });

  it("are none from too high above", () => {
    expect(tuftsAt([0, 350, 1], seenFrom(0).sight, 250)).toHaveLength(0);
  });
});

describe("what lies on the ground", () => {
  const path = new Mesh(new BoxGeometry(4, 0.2, 40));
  path.position.set(3, 0.05, 0);
  path.updateMatrixWorld();
  const covered = coveredCells([path], 0.5);

  it("covers the squares under it and hardly any beside it", () => {
    expect(covered.has(cellOf(6, 0))).toBe(true);
    expect(covered.has(cellOf(2, -30))).toBe(true);
    expect(covered.has(cellOf(-1, 0))).toBe(false);
    expect(covered.has(cellOf(12, 0))).toBe(false);
    expect(covered.size).toBeGreaterThan(8 * 80);
    expect(covered.size).toBeLessThan(10.5 * 83);
  });

  it("has no grass grow through it", () => {
    const { eye, sight } = seenFrom(0);
    const tufts = tuftsAt(eye, sight, 250, coveredCells([path], 0.42));
    let inside = 0;
    for (let at = 0; at < tufts.length; at += 4) {
      if (tufts[at]! > 2 && tufts[at]! < 4 && Math.abs(tufts[at + 1]!) < 19) inside += 1;
    }
    expect(inside).toBe(0);
  });

  it("frays at its rim alone", () => {
    const bare = [...covered].filter((cell) => isBare(covered, cell));
    expect(bare.length).toBeGreaterThan(0.6 * covered.size);
    expect(bare.length).toBeLessThan(0.9 * covered.size);
    for (let column = 4; column <= 7; column += 1) {
      for (let line = -30; line <= 30; line += 1) expect(isBare(covered, cellOf(column, line))).toBe(true);
    }
    expect(isBare(covered, cellOf(20, 0))).toBe(false);
  });

  it("covers nothing from high above it", () => {
    const roof = new Mesh(new BoxGeometry(4, 0.2, 40));
    roof.position.set(0, 6, 0);
    roof.updateMatrixWorld();
    expect(coveredCells([roof], 0.5).size).toBe(0);
  });
});
