import type { BufferGeometry, Mesh, Object3D } from "three";
import { beforeAll, describe, expect, it } from "vitest";
import { trianglesOf } from "../../test/items";
import { sampleTree } from "../../test/sample-tree";
import { BlockGeometry } from "./block-geometry";
import { makeMaterials, type Uniforms } from "./materials";
import { Painter } from "./painting/painter";
import { openingOf, QUALITIES, type Quality } from "./rendering/quality";
import { TreeTable } from "./table/tree-table";
import { TreeView } from "./tree-view";

/** What a graphics card is asked for in one of the passes of a picture. */
interface Work {
  readonly instances: number;
  readonly triangles: number;
}

describe("a tree of 100,000 metamers, seen as a whole", () => {
  const table = new TreeTable(() => 0);
  let view: TreeView;

  beforeAll(() => {
    table.apply(sampleTree({ seed: 5, height: 113, orders: 3 }));
    const uniforms: Uniforms = { uTime: { value: 0 }, uLeafSize: { value: 0.7 } };
    view = new TreeView(table, makeMaterials(uniforms), uniforms, new Painter());
  });

  const work = (quality: Quality) => {
    // As tall as the picture of a tablet on its side.
    const { max } = table.bounds();
    const fineness = { eye: [0, max[1] / 2, 1.3 * max[1]] as const, pixels: 1000 * quality.scale, ...quality };
    view.sync(fineness);
    view.detail(fineness, true);
    return { camera: workOf(view.group), shadow: workOf(view.casters) };
  };

  it("asks for little in the first picture without a graphics card", () => {
    expect(table.rows).toBeGreaterThan(100_000);
    const { camera, shadow } = work(openingOf(true));
    for (const { instances, triangles } of [camera, shadow]) {
      expect(triangles).toBeGreaterThan(20_000);
      expect(triangles).toBeLessThan(120_000);
      expect(instances).toBeLessThan(900);
    }
  });

  it("asks for no more in a coarser picture than in a finer one", () => {
    const all = QUALITIES.filter(({ detailed }) => !detailed).map((quality) => work(quality).camera.triangles);
    expect(all).toEqual([...all].sort((a, b) => b - a));
    expect(all[0]).toBeGreaterThan(2 * all.at(-1)!);
  });
});

function workOf(group: Object3D): Work {
  let [instances, triangles] = [0, 0];
  const visit = (object: Object3D, shown: boolean) => {
    const visible = shown && object.visible;
    const mesh = object as Mesh<BufferGeometry>;
    if (visible && mesh.isMesh && mesh.geometry instanceof BlockGeometry) {
      instances += mesh.geometry.instanceCount;
      triangles += trianglesOf([mesh]);
    }
    for (const child of object.children) visit(child, visible);
  };
  visit(group, true);
  return { instances, triangles };
}
