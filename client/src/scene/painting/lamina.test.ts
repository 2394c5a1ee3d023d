import { expect, it } from "vitest";
import type { LeafKind } from "../../wire/generated";
import { isSpray, type Lamina, laminaOf, laminaPath, type Outline } from "./lamina";
import { seeded } from "./leaf-painter";

const KINDS: LeafKind[] = ["ovate", "round", "lanceolate", "lobed", "palmate", "fan", "compound", "needle", "scale"];

/** The area inside a closed line. */
function area(outline: Outline): number {
  let sum = 0;
  let [lastX, lastY] = outline.at(-1)!;
  for (const [x, y] of outline) {
    sum += lastX * y - x * lastY;
    [lastX, lastY] = [x, y];
  }
  return Math.abs(sum) / 2;
}

function points({ blades, stalks, needles }: Lamina) {
  return [...blades.flat(), ...[...stalks, ...needles].flatMap(({ from, to }) => [from, to])];
}

it.each(KINDS)("every %s leaf lies within a unit square", (kind) => {
  for (let seed = 0; seed < 40; seed += 1) {
    const lamina = laminaOf(kind, seeded(seed));
    expect(lamina.reach).toBeLessThanOrEqual(0.6);
    const corners = points(lamina);
    expect(Math.max(...corners.map(([x]) => Math.abs(x)))).toBeLessThanOrEqual(lamina.reach);
    expect(Math.min(...corners.map(([, y]) => y))).toBeGreaterThanOrEqual(-0.001);
    expect(Math.max(...corners.map(([, y]) => y))).toBeLessThanOrEqual(1.001);
  }
});

it.each(KINDS)("a %s leaf reaches from its stalk to its tip", (kind) => {
  const heights = points(laminaOf(kind)).map(([, y]) => y);
  expect(Math.min(...heights)).toBeLessThan(0.02);
  expect(Math.max(...heights)).toBeGreaterThan(0.93);
});

it("blades are closed areas of the breadth that names them", () => {
  const areas = new Map(
    KINDS.filter((kind) => !isSpray(kind)).map((kind) => {
      const { blades } = laminaOf(kind);
      for (const blade of blades) expect(area(blade)).toBeGreaterThan(0.005);
      return [kind, blades.reduce((sum, blade) => sum + area(blade), 0)];
    }),
  );
  expect(areas.get("lanceolate")!).toBeLessThan(areas.get("ovate")! / 2);
  expect(areas.get("round")! / laminaOf("round").reach).toBeGreaterThan(1);
  expect(laminaOf("compound").blades).toHaveLength(13);
  expect(laminaOf("fan").reach).toBeGreaterThan(laminaOf("ovate").reach);
});

it("no two leaves of a kind are quite alike", () => {
  for (const kind of KINDS) {
    expect(points(laminaOf(kind, seeded(1)))).not.toEqual(points(laminaOf(kind, seeded(2))));
    expect(points(laminaOf(kind, seeded(1)))).toEqual(points(laminaOf(kind, seeded(1))));
  }
});

it("a panel's path stays within its box", () => {
  for (const kind of KINDS) {
    const path = laminaPath(kind, 24);
    expect(path).toMatch(/^M.*Z$/);
    expect(path.length).toBeLessThan(9000);
    for (const number of path.match(/-?\d+(\.\d+)?/g)!) {
      expect(Number(number)).toBeGreaterThanOrEqual(-0.5);
      expect(Number(number)).toBeLessThanOrEqual(24.5);
    }
  }
});
