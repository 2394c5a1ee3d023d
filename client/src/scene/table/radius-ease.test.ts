import { describe, expect, it } from "vitest";
import { SMALL, tableOf } from "../../../test/small-tree";
import { NodeTexture } from "./node-texture";
import { EASE_SECONDS, eased, RadiusEase } from "./radius-ease";

describe("radii that glide", () => {
  it("what is visibly otherwise glides, the rest does not", () => {
    const ease = new RadiusEase();
    ease.note(3, 1);
    ease.note(4, 1);
    ease.note(5, 0);
    ease.note(6, 1);
    ease.note(4, 7);
    const gliding: [number, number][] = [];
    ease.begin(
      10,
      (row) => [1.005, 2, 0][row % 3] ?? 0,
      (row, from) => gliding.push([row, from]),
    );
    expect(gliding, "one is the same, one was nowhere, one has gone").toEqual([[4, 1]]);
    expect(ease.until).toBe(10 + EASE_SECONDS);
    ease.begin(
      20,
      () => 9,
      () => expect.unreachable("nothing is noted any more"),
    );
  });

  it("holds as many as change at once", () => {
    const ease = new RadiusEase();
    for (let row = 0; row < 1000; row += 1) ease.note(row, 1);
    let count = 0;
    ease.begin(
      0,
      () => 2,
      () => {
        count += 1;
      },
    );
    expect(count).toBe(1000);
  });

  it("a radius on its way is shown where it is, and goes on from there", () => {
    const table = tableOf(SMALL);
    const nodes = new NodeTexture();
    nodes.reserve(table.rows);
    const plain = (radius: number) => radius;
    expect(nodes.shownRadius(5, 0, plain), "nothing was shown before the first writing").toBe(0);
    nodes.write(table, 5);
    const still = nodes.shownRadius(5, 100, plain);
    expect(still).toBeGreaterThan(0);
    expect(nodes.shownRadius(5, 100, (radius) => 3 * radius)).toBeCloseTo(3 * still);
    nodes.ease(5, 2 * still, 100);
    expect(nodes.shownRadius(5, 100, plain)).toBeCloseTo(2 * still);
    const half = nodes.shownRadius(5, 100 + EASE_SECONDS / 2, plain);
    expect(half).toBeCloseTo(still + still * (1 - eased(0.5, 1)));
    expect(nodes.shownRadius(5, 100 + EASE_SECONDS, plain)).toBeCloseTo(still);
    nodes.truncate(5);
    expect(nodes.shownRadius(5, 100, plain), "another row comes here").toBe(0);
  });

  it("wood that is still growing out is left alone", () => {
    const table = tableOf(SMALL);
    const nodes = new NodeTexture();
    nodes.reserve(table.rows);
    table.birth[5] = 99.9;
    table.growing[5] = 0.5;
    nodes.write(table, 5);
    expect(nodes.shownRadius(5, 100, (radius) => radius)).toBe(0);
    expect(nodes.shownRadius(5, 101, (radius) => radius)).toBeGreaterThan(0);
  });
});
