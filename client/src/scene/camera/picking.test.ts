import { Line3, Matrix4, PerspectiveCamera, Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { PlainTable } from "../../../test/plain-table";
import { randoms } from "../../../test/randoms";
import { sampleTree } from "../../../test/sample-tree";
import { type Twig, tableOf } from "../../../test/small-tree";
import { radiusOf } from "../table/tree-table";
import { type Projection, pickBranch } from "./picking";

function view(): Projection & { camera: PerspectiveCamera } {
  const camera = new PerspectiveCamera(32, 1200 / 800, 0.1, 1000);
  camera.position.set(3, 12, 60);
  camera.lookAt(0, 12, 0);
  camera.updateMatrixWorld();
  return {
    camera,
    clipFromWorld: new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements,
    width: 1200,
    height: 800,
    pixelsPerInternode: 800 / (2 * Math.tan((16 * Math.PI) / 180)),
  };
}

function onScreen(v: Projection, p: ArrayLike<number>): [number, number, number] {
  const m = v.clipFromWorld;
  const at = (r: number) => m[r]! * p[0]! + m[r + 4]! * p[1]! + m[r + 8]! * p[2]! + m[r + 12]!;
  const w = at(3);
  return [(v.width / 2) * (1 + at(0) / w), (v.height / 2) * (1 - at(1) / w), w];
}

describe("a pick", () => {
  const table = new PlainTable();
  table.apply(sampleTree({ seed: 3, height: 24, orders: 3 }));

  it("lies on a branch under the finger, within its radius and the tolerance", () => {
    const v = view();
    const random = randoms(6);
    let met = 0;
    for (let i = 0; i < 300; i += 1) {
      const [x, y] = [300 + 600 * random(), 100 + 600 * random()];
      const pick = pickBranch(table, v, x, y, 10);
      if (!pick) continue;
      met += 1;
      const [px, py, w] = onScreen(v, pick.point);
      const radius = (radiusOf(table.radiusCode[pick.row]!) * v.pixelsPerInternode) / w;
      expect(Math.hypot(px - x, py - y)).toBeLessThan(10.1 + radius);
    }
    expect(met).toBeGreaterThan(30);
  });

  it("meets the trunk where the trunk is", () => {
    const v = view();
    const [x, y] = onScreen(v, [table.position[9]!, table.position[10]!, table.position[11]!]);
    const pick = pickBranch(table, v, x, y, 4);
    expect([3, 4]).toContain(pick?.row);
  });

  it("meets thick wood where it is drawn, beside its nodes", () => {
    const corner = (i: number): Twig => ({ parent: i, at: [(i % 3) * 0.7, i + 1, 0], radius: 1.2 });
    const crooked = tableOf([{ parent: -1, at: [0, 0, 0] }, ...Array.from({ length: 20 }, (_, i) => corner(i))]);
    const v = view();
    const { placed } = crooked.course;
    const at = (of: Float32Array, row: number) => new Vector3().fromArray(of, 3 * row);
    const offLine = (of: Float32Array, row: number, point: Vector3) =>
      new Line3(at(of, crooked.parent[row]!), at(of, row))
        .closestPointToPoint(point, true, new Vector3())
        .distanceTo(point);
    let aside = 0;
    for (let row = 1; row < crooked.rows; row += 1) {
      const pick = pickBranch(
        crooked,
        v,
        ...(onScreen(v, at(placed, row).toArray()).slice(0, 2) as [number, number]),
        1,
      )!;
      expect(Math.abs(pick.row - row), `row ${row}`).toBeLessThan(4);
      const point = new Vector3(...pick.point);
      expect(offLine(placed, pick.row, point), `row ${row}`).toBeLessThan(1e-3);
      aside += offLine(crooked.position, pick.row, point);
    }
    expect(aside).toBeGreaterThan(1);
  });

  it("prefers the branch in front where two cross", () => {
    const crossing = new PlainTable();
    crossing.apply({
      epoch: 1,
      sequence: 1,
      catchUp: true,
      changes: [
        {
          change: "replace",
          chunk: 0,
          generation: 1,
          rows: {
            parent: Uint32Array.of(0, 2, 0, 2),
            position: Int32Array.of(-2560, 3072, 0, 5120, 0, 0, 0, 512, 5120, 0, 5120, 0),
            radius: Uint16Array.of(0, 500, 0, 500),
            foliage: new Uint8Array(4),
            light: new Uint8Array(4),
            born: new Uint32Array(4),
          },
        },
      ],
    });
    const v = view();
    const [x, y] = onScreen(v, [0, 12, 20]);
    expect(pickBranch(crossing, v, x, y, 60)?.row).toBe(3);
  });

  it("meets nothing in the empty sky", () => {
    expect(pickBranch(table, view(), 20, 20, 12)).toBeNull();
  });
});
