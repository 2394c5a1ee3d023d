import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import type { Vec3 } from "../vector";
import { Bend } from "./bend";

type Target = [internode: number, place: Vec3];
type Motion = [internode: number, to: Vec3, rotation: [number, number, number, number]];

/** A bend as the server computes it. */
interface Sample {
  name: string;
  stretch: number;
  nodes: Vec3[];
  radii: number[];
  events: { targets: Target[]; motions: Motion[] }[];
  relaxed: Motion[];
}

const file = new URL("../../../../server/plant/golden/bend.json", import.meta.url);
const samples: Sample[] = JSON.parse(readFileSync(file, "utf8"));

function distance(a: Vec3, b: Vec3): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

function lengthOf(nodes: readonly Vec3[]): number {
  return nodes.slice(2).reduce((sum, node, i) => sum + distance(nodes[i + 1]!, node), 0);
}

function straight(internodes: number): Vec3[] {
  return Array.from({ length: internodes + 1 }, (_, i): Vec3 => [0, i, 0]);
}

function bendOf(nodes: readonly Vec3[], stretch: number): Bend {
  return new Bend(nodes, new Float32Array(nodes.length - 1).fill(0.2), stretch);
}

function expectMotions(bend: Bend, expected: readonly Motion[], length: number): void {
  const motions = bend.motions();
  for (const [internode, to, rotation] of expected) {
    const motion = motions[internode]!;
    expect(distance(motion.to, to) / length).toBeLessThan(1e-6);
    const cosine = rotation.reduce((sum, number, i) => sum + number * motion.rotation[i]!, 0);
    expect(1 - Math.abs(cosine)).toBeLessThan(1e-6);
  }
}

describe("a bend", () => {
  it.each(samples)("of $name goes as the server has it", ({ nodes, radii, stretch, events, relaxed }) => {
    const bend = new Bend(nodes, radii, stretch);
    for (const { targets, motions } of events) {
      bend.drag(targets);
      expectMotions(bend, motions, lengthOf(nodes));
    }
    bend.relax();
    expectMotions(bend, relaxed, lengthOf(nodes));
  });

  it("comes back when its touches are brought back", () => {
    for (const internodes of [2, 40, 300, 1000]) {
      const nodes = straight(internodes);
      const [end, middle] = [internodes - 1, internodes >> 1];
      const bend = bendOf(nodes, 0.2);
      for (let event = 1; event <= 60; event += 1) {
        const [sine, cosine] = [Math.sin((Math.PI * event) / 30), Math.cos((Math.PI * event) / 30) - 1];
        const way = event === 60 ? [0, 0] : [0.4 * end * sine, 0.3 * end * cosine];
        const led = (internode: number, share: number): Target => {
          const [x, y, z] = nodes[internode + 1]!;
          return [internode, [x + share * way[0]!, y + share * way[1]!, z + share * way[0]!]];
        };
        bend.drag(internodes > 2 ? [led(end, 1), led(middle, 0.4)] : [led(end, 1)]);
      }
      bend.relax();
      for (const [i, { to }] of bend.motions().entries()) {
        expect(distance(to, nodes[i + 1]!) / end).toBeLessThan(internodes > 300 ? 1e-4 : 1e-6);
      }
    }
  });

  it("takes no notice of places that are no numbers", () => {
    const nodes = straight(20);
    const [asked, broken] = [bendOf(nodes, 0.3), bendOf(nodes, 0.3)];
    const target: Target = [19, [5, 15, 3]];
    broken.drag([[19, [Number.NaN, 0, 0]]]);
    expect(broken.motions().every(({ rotation }) => rotation[3] === 1)).toBe(true);
    for (const bend of [asked, broken]) bend.drag([target]);
    asked.drag([target]);
    broken.drag([
      [19, [Number.POSITIVE_INFINITY, 0, 0]],
      [25, [0, 0, 0]],
      [0, [0, 0, 0]],
      [3, [0, Number.NaN, 0]],
    ]);
    expect(broken.motions()).toEqual(asked.motions());
  });

  it("stays finite however far it is pulled, and whatever its path", () => {
    const paths = [straight(1), straight(2), straight(30), Array.from({ length: 9 }, (): Vec3 => [1, 1, 1])];
    for (const nodes of paths) {
      for (const stretch of [0, 1]) {
        const bend = bendOf(nodes, stretch);
        for (const far of [1e3, -1e12, 3e38]) {
          bend.drag([[nodes.length - 2, [far, -far, far]]]);
          bend.relax();
          for (const { rotation, to } of bend.motions()) expect([...rotation, ...to].every(Number.isFinite)).toBe(true);
        }
      }
    }
  });
});
