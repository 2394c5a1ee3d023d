import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import type { Vec3 } from "../vector";
import { AxisCurve } from "./axis-curve";
import { type Envelope, surface } from "./envelope-surface";
import { shellGeometry } from "./shell-geometry";

interface Samples {
  readonly envelopes: readonly {
    readonly envelope: Envelope;
    readonly points: readonly {
      readonly upper: boolean;
      readonly angle: number;
      readonly share: number;
      readonly at: Vec3;
    }[];
  }[];
  readonly curves: readonly {
    readonly points: readonly Vec3[];
    readonly length: number;
    readonly at: readonly { readonly t: number; readonly at: Vec3 }[];
  }[];
}

const SAMPLES = JSON.parse(
  readFileSync(join(import.meta.dirname, "../../../../server/design/golden/shells.json"), "utf8"),
) as Samples;

function expectPlace(found: Vec3, wanted: Vec3) {
  for (const axis of [0, 1, 2] as const) {
    expect(found[axis]).toBeCloseTo(wanted[axis], 4);
  }
}

describe("shells and axes", () => {
  it("a shell is the surface that the wood reaches on the server", () => {
    expect(SAMPLES.envelopes.length).toBe(3);
    for (const { envelope, points } of SAMPLES.envelopes) {
      for (const { upper, angle, share, at } of points) {
        expectPlace(surface(envelope, angle, share, upper), at);
      }
    }
  });

  it("an axis goes where the server lays it", () => {
    expect(SAMPLES.curves.length).toBe(3);
    for (const { points, length, at } of SAMPLES.curves) {
      const curve = new AxisCurve(points);
      expect(curve.length).toBeCloseTo(length, 4);
      for (const { t, at: wanted } of at) {
        expectPlace(curve.at(t), wanted);
      }
    }
  });

  it("a shell is closed and faces out", () => {
    for (const { envelope } of SAMPLES.envelopes) {
      const { positions, triangles } = shellGeometry(envelope);
      const at = (corner: number): Vec3 =>
        [0, 1, 2].map((axis) => positions[3 * (triangles[corner] ?? 0) + axis] ?? 0) as unknown as Vec3;
      let volume = 0;
      for (let corner = 0; corner < triangles.length; corner += 3) {
        const [a, b, c] = [at(corner), at(corner + 1), at(corner + 2)];
        volume +=
          (a[0] * (b[1] * c[2] - b[2] * c[1]) +
            a[1] * (b[2] * c[0] - b[0] * c[2]) +
            a[2] * (b[0] * c[1] - b[1] * c[0])) /
          6;
      }
      expect(volume).toBeGreaterThan(0.05);
      const edges = new Map<string, number>();
      const key = (corner: number) =>
        at(corner)
          .map((part) => part.toFixed(4))
          .join();
      for (let corner = 0; corner < triangles.length; corner += 3) {
        for (const [from, to] of [
          [0, 1],
          [1, 2],
          [2, 0],
        ] as const) {
          const [a, b] = [key(corner + from), key(corner + to)];
          if (a !== b) {
            edges.set(`${a}/${b}`, (edges.get(`${a}/${b}`) ?? 0) + 1);
          }
        }
      }
      const open = [...edges].filter(([edge, count]) => edges.get(edge.split("/").reverse().join("/")) !== count);
      expect(open).toEqual([]);
    }
  });
});
