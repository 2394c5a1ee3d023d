import { ShaderMaterial, Vector3, Vector4 } from "three";
import { beforeEach, describe, expect, it } from "vitest";
import { countOf } from "../../../test/items";
import { PlainTable } from "../../../test/plain-table";
import { sampleTree } from "../../../test/sample-tree";
import type { LeafKind } from "../../wire/generated";
import type { Uniforms } from "../materials";
import { ATLAS_TILES, coverageOf, type Levels } from "../painting/leaf-atlas";
import { leafLevels, reachOf } from "../painting/leaf-pictures";
import { SPRIG_LEAVES, SPRIG_REACH, TILE_MARGIN } from "../painting/measures";
import { QUALITIES } from "../rendering/quality";
import type { TreeTable } from "../table/tree-table";
import { LeafRows } from "./leaf-rows";
import { bandFor, Sprigs, sprigsOf } from "./sprigs";

const material = () => new ShaderMaterial();

/** Of a card as long as one leaf and half as wide as `reach`: how much of it is inside. */
function areaOf({ colour }: Levels, reach: number): number {
  const side = Math.sqrt(colour[0]!.length / 4);
  const tiles = Array.from({ length: ATLAS_TILES ** 2 }, (_, tile) => coverageOf(colour[0]!, side, tile));
  return (2 * reach * (1 + 2 * TILE_MARGIN) ** 2 * tiles.reduce((sum, share) => sum + share, 0)) / tiles.length;
}

describe.each(["ovate", "lanceolate", "compound", "needle"] as LeafKind[])("a sprig of %s leaves", (kind) => {
  const [single, sprig] = leafLevels(kind, 64) as [Levels, Levels];

  it("covers as much as the leaves it stands for", () => {
    const leaves = SPRIG_LEAVES * areaOf(single, reachOf(kind));
    expect(areaOf(sprig, SPRIG_REACH) * sprig.span! ** 2).toBeCloseTo(leaves, 1);
  });

  it("is about as large as what bears those leaves", () => {
    expect(sprig.span).toBeGreaterThan(1);
    expect(sprig.span).toBeLessThan(4);
  });

  it("is as bright as they are", () => {
    const bright = ({ colour: [texels] }: Levels) => {
      let [sum, inside] = [0, 0];
      for (let at = 0; at < texels!.length; at += 4) {
        if (texels![at + 3]! < 128) continue;
        sum += texels![at]!;
        inside += 1;
      }
      return sum / inside;
    };
    expect(bright(sprig) / bright(single)).toBeGreaterThan(0.92);
    expect(bright(sprig) / bright(single)).toBeLessThan(1.08);
  });
});

describe("sprigs", () => {
  let table: TreeTable;
  let uniforms: Uniforms;
  let leaves: LeafRows;
  let sprigs: Sprigs;
  const box = { min: [-10, 0, -10], max: [10, 40, 10] } as const;
  const see = (distance: number) => {
    const fineness = { eye: [0, 20, 10 + distance] as const, pixels: 1000, ...QUALITIES[0] };
    const seen = { min: [...box.min], max: [...box.max] } as Parameters<LeafRows["detail"]>[1];
    leaves.detail(fineness, seen);
    sprigs.detail(fineness, seen, leaves);
  };

  beforeEach(() => {
    table = new PlainTable(() => 0);
    table.apply(sampleTree({ seed: 5, height: 60, orders: 3 }));
    uniforms = {
      uLeafSize: { value: 0.7 },
      uLeafForm: { value: new Vector4() },
      uLeafLevel: { value: new Vector3() },
      uLeafBlades: { value: 1 },
      uLeafTwig: { value: 0 },
      uLeafBand: { value: new Vector3() },
    };
    leaves = new LeafRows({ leaf: material(), leafDepth: material() }, uniforms);
    sprigs = new Sprigs({ sprig: material(), sprigDepth: material() }, uniforms);
    table.drain(
      () => {},
      (row) => {
        leaves.update(table, row);
        sprigs.update(table, row);
      },
    );
    leaves.upload();
    sprigs.upload();
  });

  it("are one for every sixth leaf of a shoot", () => {
    for (const each of [1, 2, 3, 4, 5, 7, 15]) {
      let sum = 0;
      for (let place = 1000; place < 1000 + 6 * SPRIG_LEAVES; place += 1) {
        const here = sprigsOf(place, each);
        expect(here).toBeLessThanOrEqual(Math.ceil(each / SPRIG_LEAVES));
        sum += here;
      }
      expect(sum).toBe(6 * each);
    }
    expect(sprigsOf(12, 0)).toBe(0);
  });

  it("stand for all leaves of a tree together", () => {
    expect(leaves.filled).toBeGreaterThan(3000);
    expect((sprigs.count * SPRIG_LEAVES) / leaves.filled).toBeGreaterThan(0.9);
    expect((sprigs.count * SPRIG_LEAVES) / leaves.filled).toBeLessThan(1.1);
  });

  it("go with the leaves that go", () => {
    sprigs.truncate(0);
    sprigs.upload();
    expect(sprigs.count).toBe(0);
    expect(countOf(sprigs.mesh)).toBe(0);
  });

  it("and leaves of a tree that is small again are as few as its own", () => {
    let [left, kept] = [0, 0];
    for (; left < 1500; kept += 1) left += leaves.countOf(kept);
    for (const part of [leaves, sprigs]) {
      part.truncate(kept);
      part.upload();
    }
    expect(leaves.filled).toBe(left);
    expect(countOf(leaves.mesh)).toBeLessThan(1.3 * left + 300);
    see(700);
    expect([leaves.mesh.visible, sprigs.mesh.visible], "and none give way").toEqual([true, false]);
  });

  it("are drawn from afar, leaves from near, both between", () => {
    const drawn = () => [leaves.mesh.visible, sprigs.mesh.visible];
    see(60);
    expect(drawn()).toEqual([true, false]);
    expect(sprigs.share).toBe(0);
    see(700);
    expect(drawn()).toEqual([false, true]);
    expect(sprigs.share).toBe(1);
    const [low, high] = bandFor(leaves.filled, 1);
    see(700 / ((low + high) / 2));
    expect(drawn()).toEqual([true, true]);
    expect(leaves.caster.visible).toBe(true);
    expect(sprigs.caster.visible).toBe(true);
  });

  it("come on by small steps as the eye goes back slowly", () => {
    let before = 0;
    for (let distance = 60; distance < 700; distance *= 1.01) {
      see(distance);
      expect(sprigs.share).toBeGreaterThanOrEqual(before);
      expect(sprigs.share - before).toBeLessThan(0.05);
      before = sprigs.share;
    }
    expect(before).toBe(1);
  });

  it("are of no use to a young tree", () => {
    expect(bandFor(500, 1)).toEqual([0, 0]);
    expect(bandFor(250_000, 1)[0]).toBeGreaterThan(bandFor(30_000, 1)[0]);
    expect(bandFor(4_000_000, 1)).toEqual(bandFor(250_000, 1));
  });

  it("come sooner in haste", () => {
    expect(bandFor(30_000, 1.6)[0]).toBeGreaterThan(bandFor(30_000, 1)[0]);
    expect(bandFor(500, 1.6), "but never to a young tree").toEqual([0, 0]);
  });
});
