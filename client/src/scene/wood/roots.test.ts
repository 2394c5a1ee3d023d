import { expect, it } from "vitest";
import { itemsOf, trianglesOf } from "../../../test/items";
import { SMALL, type Twig, tableOf } from "../../../test/small-tree";
import { MOST_ROOTS } from "../glsl/roots";
import { makeMaterials } from "../materials";
import { Branches } from "./branches";

/** Rows of the metamers and of the seeds that roots are drawn for, and which roots, once a table has been taken over. */
function rootsOf(twigs: readonly Twig[], branches = new Branches(makeMaterials({}))) {
  const table = tableOf(twigs);
  table.drain(
    (rows) => branches.truncate(rows),
    (row) => branches.update(table, row),
  );
  branches.upload(table);
  return itemsOf(branches.roots, 4).map(([row, seed, , flags]) => [row, seed, flags! >>> 24]);
}

it("a trunk spreads all its roots over the ground it stands on", () => {
  expect(rootsOf(SMALL)).toEqual(Array.from({ length: MOST_ROOTS }, (_, root) => [1, 0, root]));
});

it("one that leaves a cliff has none, and none is left of one that is gone", () => {
  const high = SMALL.map((twig) => ({ ...twig, at: [twig.at[0], twig.at[1] + 5, twig.at[2]] as const }));
  expect(rootsOf(high)).toEqual([]);
  const branches = new Branches(makeMaterials({}));
  expect(rootsOf(SMALL, branches)).toHaveLength(MOST_ROOTS);
  branches.truncate(0);
  branches.upload();
  expect(itemsOf(branches.roots, 4)).toEqual([]);
});

it("of two trunks on one seed the roots are the first one's", () => {
  const beside: Twig = { parent: 0, at: [1, 1, 0], begins: true, radius: 0.4 };
  expect(new Set(rootsOf([...SMALL, beside]).map(([row]) => row))).toEqual(new Set([1]));
});

it("roots are drawn with few triangles while frames must be quick", () => {
  const branches = new Branches(makeMaterials({}));
  rootsOf(SMALL, branches);
  const fine = trianglesOf([branches.roots]);
  branches.detail(false);
  expect(trianglesOf([branches.roots])).toBeLessThan(fine / 3);
});

it("roots cast shadows as long as they are drawn", () => {
  const branches = new Branches(makeMaterials({}));
  rootsOf(SMALL, branches);
  const cast = () => branches.casters.filter(({ visible }) => visible).map((mesh) => itemsOf(mesh, 4));
  expect(cast()).toContainEqual(itemsOf(branches.roots, 4));
  branches.truncate(0);
  branches.upload();
  expect(cast()).toEqual([]);
});
