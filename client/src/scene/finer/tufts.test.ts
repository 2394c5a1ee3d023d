import { BoxGeometry, Matrix4, Mesh, PerspectiveCamera } from "three";
import { describe, expect, it } from "vitest";
import { Covered } from "./covered";
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
  const covered = Covered.under([path], 0.5);

  it("covers the squares under it and hardly any beside it", () => {
    expect(covered.has(6, 0)).toBe(true);
    expect(covered.has(2, -30)).toBe(true);
    expect(covered.has(-1, 0)).toBe(false);
    expect(covered.has(12, 0)).toBe(false);
    expect(covered.size).toBeGreaterThan(8 * 80);
    expect(covered.size).toBeLessThan(10.5 * 83);
  });

  it("has no grass grow through it", () => {
    const { eye, sight } = seenFrom(0);
    const tufts = tuftsAt(eye, sight, 250, Covered.under([path], 0.42));
    let inside = 0;
    for (let at = 0; at < tufts.length; at += 4) {
      if (tufts[at]! > 2 && tufts[at]! < 4 && Math.abs(tufts[at + 1]!) < 19) inside += 1;
    }
    expect(inside).toBe(0);
  });

  it("frays at its rim alone", () => {
    let bare = 0;
    for (let column = 0; column < 12; column += 1) {
      for (let line = -45; line <= 45; line += 1) bare += covered.isBare(column, line) ? 1 : 0;
    }
    expect(bare).toBeGreaterThan(0.6 * covered.size);
    expect(bare).toBeLessThan(0.9 * covered.size);
    for (let column = 4; column <= 7; column += 1) {
      for (let line = -30; line <= 30; line += 1) expect(covered.isBare(column, line)).toBe(true);
    }
    expect(covered.isBare(20, 0)).toBe(false);
  });

  it("covers the same whichever way it is turned, as far as squares let it", () => {
    const turned = new Mesh(new BoxGeometry(4, 0.2, 40));
    turned.rotation.y = 0.4;
    turned.updateMatrixWorld();
    const found = Covered.under([turned], 0.5);
    expect(found.size).toBeGreaterThan(8 * 80);
    expect(found.size).toBeLessThan(10.5 * 83);
    const [along, across] = [Math.cos(0.4), Math.sin(0.4)];
    for (let column = -40; column < 40; column += 1) {
      for (let line = -50; line < 50; line += 1) {
        const [x, z] = [(column + 0.5) / 2, (line + 0.5) / 2];
        const beside = Math.abs(along * x - across * z) - 2;
        const behind = Math.abs(across * x + along * z) - 20;
        if (Math.max(beside, behind) < 0.29) expect(found.has(column, line)).toBe(true);
        if (beside > 0.5 && behind < -2) expect(found.has(column, line)).toBe(false);
      }
    }
  });

  it("may be a floor of a thousand internodes and more", () => {
    const floor = new Mesh(new BoxGeometry(4000, 0.2, 4000));
    floor.updateMatrixWorld();
    const found = Covered.under([floor], 0.42);
    expect(found.size).toBeGreaterThan(90_000_000);
    expect(found.isBare(4000, -4000)).toBe(true);
    expect(found.has(4800, 0)).toBe(false);
  });

  it("covers nothing from high above it", () => {
    const roof = new Mesh(new BoxGeometry(4, 0.2, 40));
    roof.position.set(0, 6, 0);
    roof.updateMatrixWorld();
    expect(Covered.under([roof], 0.5).size).toBe(0);
  });
});
