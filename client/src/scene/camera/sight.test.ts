import { Vector3 } from "three";
import { describe, expect, it } from "vitest";
import type { Vec3 } from "../vector";
import { CameraRig } from "./camera-rig";
import { Sight } from "./sight";

/** A canvas of 800 by 600 that looks at (0, 10, 0) from 50 internodes off. */
function sightFrom(yaw: number, pitch: number) {
  const sight = new Sight();
  sight.width = 800;
  sight.height = 600;
  const view = { target: [0, 10, 0] as [number, number, number], yaw, pitch, distance: 50 };
  sight.aim(view, new CameraRig().eye(view));
  return sight;
}

const views = [
  [0, 0],
  [1, 0.4],
  [-2.5, 1.2],
  [0.3, -0.15],
] as const;

describe("sight", () => {
  it("a tile shows its part of the picture", () => {
    const view = { target: [0, 10, 0] as [number, number, number], yaw: 0.7, pitch: 0.2, distance: 50 };
    const eye = new CameraRig().eye(view);
    const sight = new Sight();
    const point: Vec3 = [3, 14, -5];
    const seen = () => new Vector3(...point).project(sight.camera);
    sight.aim(view, eye, 2);
    const whole = seen();
    // In pixels of a picture of 2000 by 1000, and in those of the tile that begins at 800, 200.
    const [x, y] = [1000 * (1 + whole.x), 500 * (1 - whole.y)];
    sight.aimAtTile(view, eye, { width: 2000, height: 1000 }, { x: 800, y: 200, width: 500, height: 400 });
    const part = seen();
    expect(250 * (1 + part.x)).toBeCloseTo(x - 800);
    expect(200 * (1 - part.y)).toBeCloseTo(y - 200);
    sight.aim(view, eye, 2);
    expect(seen().x, "and is forgotten with the next view").toBeCloseTo(whole.x);
  });

  it.each(views)("a drawing plane's coordinates are those of the places drawn (yaw %d, pitch %d)", (yaw, pitch) => {
    const sight = sightFrom(yaw, pitch);
    const through: Vec3 = [3, 4, -5];
    const { origin, right, up } = sight.drawingPlane(through);
    const dot = (a: Vec3, b: Vec3) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    expect([dot(right, right), dot(up, up), dot(right, up)].map((x) => Math.round(x * 1e9) / 1e9)).toEqual([1, 1, 0]);
    for (const [x, y] of [
      [0, 0],
      [400, 300],
      [790, 33],
    ] as const) {
      const place = sight.pointOnPlane(x, y, through)!;
      const offset: Vec3 = [place[0] - origin[0], place[1] - origin[1], place[2] - origin[2]];
      const [a, b] = [dot(offset, right), dot(offset, up)];
      const back = origin.map((from, axis) => from + a * right[axis]! + b * up[axis]!);
      for (const axis of [0, 1, 2] as const) expect(back[axis]).toBeCloseTo(place[axis], 6);
    }
    const [left, middle] = [sight.pointOnPlane(0, 300, through)!, sight.pointOnPlane(400, 300, through)!];
    expect(dot([middle[0] - left[0], middle[1] - left[1], middle[2] - left[2]], right)).toBeGreaterThan(0);
  });

  it.each(views)("projecting is the way back (yaw %d, pitch %d)", (yaw, pitch) => {
    const sight = sightFrom(yaw, pitch);
    const place = sight.pointOnPlane(123, 456, [3, 4, -5])!;
    const [x, y] = sight.projector()(place)!;
    expect(x).toBeCloseTo(123, 6);
    expect(y).toBeCloseTo(456, 6);
  });

  it("what is behind the eye has no place", () => {
    expect(sightFrom(0, 0).projector()([0, 10, 90])).toBeNull();
  });

  it("finds the ground below the horizon, as long as it is not far off", () => {
    const sight = sightFrom(0, 0.3);
    const place = sight.pointOnLevel(400, 500, [0, 0, 0])!;
    expect(place[1]).toBeCloseTo(0, 9);
    expect(sight.projector()(place)![1]).toBeCloseTo(500, 6);
    expect(sight.pointOnLevel(400, 5, [0, 0, 0]), "the sky").toBeNull();
    const flat = sightFrom(0, 0);
    expect(flat.pointOnLevel(400, 590, [0, 0, 0])).not.toBeNull();
    expect(flat.pointOnLevel(400, 305, [0, 0, 0]), "near the horizon").toBeNull();
  });

  it("knows when it looks from above", () => {
    expect([sightFrom(0, 0.2), sightFrom(0, 1)].map((sight) => sight.looksDown())).toEqual([false, true]);
  });
});
