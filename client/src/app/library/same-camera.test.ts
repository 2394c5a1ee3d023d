import { describe, expect, it } from "vitest";
import { pictureOfVersion, STOPS, sameCamera } from "./same-camera";
import { measuresOf, shapeOfPoints } from "./version-shape";

const small = { min: [-1, 0, -1], max: [1, 2, 1] } as const;
const large = { min: [-2, -0.5, -3], max: [4, 8, 3] } as const;

/** Where a place is in a picture: −1 to 1 across and up, as the server has it. */
function seen(camera: URLSearchParams, place: readonly number[]): [number, number] {
  const number = (name: string) => (Number(camera.get(name)) * Math.PI) / 180;
  const [tx, ty, tz] = camera.get("target")!.split(",").map(Number) as [number, number, number];
  const [x, y, z] = [place[0]! - tx, place[1]! - ty, place[2]! - tz];
  const [turn, rise, distance] = [number("turn"), number("rise"), Number(camera.get("distance"))];
  const across = x * Math.cos(turn) - z * Math.sin(turn);
  const near = x * Math.sin(turn) + z * Math.cos(turn);
  const up = y * Math.cos(rise) - near * Math.sin(rise);
  const depth = distance - near * Math.cos(rise) - y * Math.sin(rise);
  const half = Math.tan(number("fov") / 2) * depth;
  return [across / half, up / half];
}

describe("the camera of two versions", () => {
  it("has both of them whole in the picture from everywhere, and the larger one large", () => {
    for (let stop = 0; stop < STOPS; stop += 1) {
      const camera = sameCamera([small, large], stop);
      const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((corner) =>
        [0, 1, 2].map((axis) => (corner & (1 << axis) ? large.max : large.min)[axis]!),
      );
      const reach = Math.max(...corners.flatMap((corner) => seen(camera, corner).map(Math.abs)));
      expect(reach).toBeLessThanOrEqual(1);
      expect(reach).toBeGreaterThan(0.6);
    }
  });

  it("differs from stop to stop in its turn alone", () => {
    const turns = Array.from({ length: STOPS }, (_, stop) => {
      const camera = sameCamera([small, large], stop);
      const turn = Number(camera.get("turn"));
      camera.delete("turn");
      expect(String(camera)).toBe(String(withoutTurn()));
      return turn;
    });
    expect(new Set(turns).size).toBe(STOPS);
    expect(Math.max(...turns.map(Math.abs))).toBeLessThanOrEqual(180);
  });

  it("asks for the picture of a version", () => {
    const path = pictureOfVersion("a b", 3, sameCamera([small], 0));
    expect(path).toMatch(/^\/api\/v1\/trees\/a%20b\/versions\/3\/tree\.png\?size=480x480&turn=0&/);
  });
});

function withoutTurn(): URLSearchParams {
  const camera = sameCamera([small, large], 0);
  camera.delete("turn");
  return camera;
}

describe("the size of a version", () => {
  const head = (count: number) =>
    `ply\nformat binary_little_endian 1.0\ncomment any\nelement vertex ${count}\nproperty float x\nproperty float y\nproperty float z\nproperty uchar label\nproperty uint metamer\nend_header\n`;
  const file = (count: number, points: readonly (readonly number[])[]) => {
    const text = new TextEncoder().encode(head(count));
    const bytes = new Uint8Array(text.length + 17 * points.length);
    bytes.set(text);
    const view = new DataView(bytes.buffer, text.length);
    for (const [i, point] of points.entries()) {
      for (const [axis, place] of point.entries()) view.setFloat32(17 * i + 4 * axis, place, true);
    }
    return bytes.buffer;
  };

  it("is read from points", () => {
    const shape = shapeOfPoints(
      file(2, [
        [-1, 0, 0.5],
        [2, 6, -0.5],
      ]),
    );
    expect(shape).toEqual({ min: [-1, 0, -0.5], max: [2, 6, 0.5] });
    expect(measuresOf(shape!)).toEqual({ height: 6, spread: 3 });
  });

  it("is not known of what has no points, ends early, or is no such file", () => {
    expect(shapeOfPoints(file(0, []))).toBe(null);
    expect(shapeOfPoints(file(3, [[0, 0, 0]]))).toBe(null);
    expect(shapeOfPoints(file(1, [[Number.NaN, 0, 0]]))).toBe(null);
    expect(shapeOfPoints(new TextEncoder().encode("<html>").buffer)).toBe(null);
  });
});
