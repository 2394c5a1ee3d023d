import { describe, expect, it } from "vitest";
import { SMALL, tableOf } from "../../../test/small-tree";
import { NodeTexture } from "./node-texture";
import { radiusOf, type TreeTable } from "./tree-table";

/** The radius a row has on the graphics card. */
function radiusIn(nodes: NodeTexture, row: number): number {
  return (nodes.uniform.value.image.data as Float32Array)[12 * row + 3]!;
}

function written(table: TreeTable, rows: readonly number[]): NodeTexture {
  const nodes = new NodeTexture();
  nodes.reserve(table.rows);
  for (const row of rows) nodes.write(table, row);
  return nodes;
}

describe("the node texture", () => {
  const table = tableOf(SMALL);
  const trunk = radiusOf(table.radiusCode[1]!);

  it("has each row's radius", () => {
    expect(radiusIn(written(table, [6]), 6)).toBeCloseTo(radiusOf(table.radiusCode[6]!), 5);
  });

  it("has a seed as thick as its trunk, whichever is written first", () => {
    expect(radiusIn(written(table, [0, 1]), 0)).toBeCloseTo(trunk, 5);
    expect(radiusIn(written(table, [1, 0]), 0)).toBeCloseTo(trunk, 5);
  });

  it("has a seed without a trunk as thin as nothing", () => {
    const bare = tableOf(SMALL.map((twig, row) => (row === 0 ? twig : { ...twig, dead: true })));
    expect(radiusIn(written(bare, [0, 1]), 0)).toBe(0);
  });

  it("that is not yet on the graphics card is uploaded whole, whatever changes meanwhile", () => {
    const nodes = written(table, [0, 1, 2]);
    const texture = nodes.uniform.value;
    nodes.upload();
    nodes.write(table, 3);
    nodes.upload();
    expect(texture.updateRanges).toEqual([]);
    // As three.js does once it has uploaded it.
    texture.onUpdate?.(texture);
    nodes.write(table, 4);
    nodes.upload();
    expect(texture.updateRanges.length).toBe(1);
  });
});
