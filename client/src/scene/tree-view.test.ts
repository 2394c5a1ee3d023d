import { type BufferGeometry, type Mesh, type Object3D, type RawShaderMaterial, Texture } from "three";
import { beforeAll, describe, expect, it } from "vitest";
import { idlePainter } from "../../test/idle-painter";
import { trianglesOf } from "../../test/items";
import { PlainTable } from "../../test/plain-table";
import { sampleTree } from "../../test/sample-tree";
import { DEFAULT_APPEARANCE } from "../wire/generated";
import { BlockGeometry } from "./block-geometry";
import { makeMaterials, type Uniforms } from "./materials";
import { openingOf, QUALITIES, type Quality } from "./rendering/quality";
import { TreeView } from "./tree-view";

/** Calls of a pass at most: a few levels of wood, leaves, sprigs. */
const CALLS = 8;
/** Bytes of textures and vertices at most, for each row. */
const BYTES = 128;

/** What a graphics card is asked for in one of the passes of a picture. */
interface Work {
  readonly calls: number;
  readonly instances: number;
  readonly triangles: number;
}

describe("a tree of 100,000 metamers, seen as a whole", () => {
  const table = new PlainTable(() => 0);
  let view: TreeView;

  beforeAll(() => {
    table.apply(sampleTree({ seed: 5, height: 113, orders: 3 }));
    const uniforms: Uniforms = { uTime: { value: 0 }, uLeafSize: { value: 0.7 } };
    view = new TreeView(table, makeMaterials(uniforms), uniforms, idlePainter());
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
    for (const { calls, instances, triangles } of [camera, shadow]) {
      expect(calls).toBeGreaterThan(1);
      expect(calls).toBeLessThanOrEqual(CALLS);
      expect(triangles).toBeGreaterThan(20_000);
      expect(triangles).toBeLessThan(120_000);
      expect(instances).toBeLessThan(900);
    }
  });

  it("holds no more than its rows take, and what is drawn of them", () => {
    work(openingOf(true));
    const bytes = bytesOf(view.group, view.casters);
    // A row takes 48 bytes in the table of nodes, which has room for up to twice as many.
    expect(bytes).toBeGreaterThan(48 * table.rows);
    expect(bytes).toBeLessThan(BYTES * table.rows);
  });

  it("in flower and in fruit asks for little as well", () => {
    const { flowers, fruits } = DEFAULT_APPEARANCE;
    const look = { share: 1, place: "twigs" } as const;
    view.setAppearance({
      ...DEFAULT_APPEARANCE,
      flowers: { ...flowers, ...look, kind: "rosette" },
      fruits: { ...fruits, ...look, kind: "round" },
    });
    const { camera } = work(openingOf(true));
    expect(work(QUALITIES[0]).camera.triangles).toBeGreaterThan(2 * camera.triangles);
    expect(camera.triangles).toBeLessThan(140_000);
    expect(camera.calls).toBeLessThanOrEqual(CALLS + 2);
  });

  it("is sketched by one call, and drawn as ever after that", () => {
    const sketched: Work[] = [];
    view.sketch((lines) => sketched.push(workOf(lines)));
    expect(sketched).toHaveLength(1);
    expect(sketched[0]!.calls).toBe(1);
    expect(sketched[0]!.triangles).toBeGreaterThan(table.rows);
    expect(sketched[0]!.triangles).toBeLessThan(2 * 120_000);
    expect(work(openingOf(true)).camera.calls, "its lines are gone").toBeGreaterThan(1);
  });

  it("asks for no more in a coarser picture than in a finer one", () => {
    const all = QUALITIES.filter(({ detailed }) => !detailed).map((quality) => work(quality).camera.triangles);
    expect(all).toEqual([...all].sort((a, b) => b - a));
    expect(all[0]).toBeGreaterThan(2 * all.at(-1)!);
  });
});

function workOf(group: Object3D): Work {
  let [calls, instances, triangles] = [0, 0, 0];
  const visit = (object: Object3D, shown: boolean) => {
    const visible = shown && object.visible;
    const mesh = object as Mesh<BufferGeometry>;
    if (visible && mesh.isMesh && mesh.geometry instanceof BlockGeometry) {
      calls += 1;
      instances += mesh.geometry.instanceCount;
      triangles += trianglesOf([mesh]);
    }
    for (const child of object.children) visit(child, visible);
  };
  visit(group, true);
  return { calls, instances, triangles };
}

/** Bytes of all that these draw with: what their vertices are, and the textures that their shaders read. */
function bytesOf(...groups: readonly Object3D[]): number {
  const held = new Set<ArrayBufferLike>();
  const hold = (data: unknown) => void (ArrayBuffer.isView(data) && held.add(data.buffer));
  const holdTexture = (value: unknown) => {
    for (const part of Array.isArray(value) ? value : [value]) {
      if (part instanceof Texture) hold((part.image as { data?: unknown } | null)?.data);
    }
  };
  for (const group of groups) {
    group.traverseVisible((object) => {
      const { geometry, material, isMesh } = object as Mesh<BufferGeometry, RawShaderMaterial>;
      if (!isMesh) return;
      for (const attribute of Object.values(geometry.attributes)) hold(attribute.array);
      hold(geometry.index?.array);
      for (const name in material.uniforms) holdTexture(material.uniforms[name]?.value);
    });
  }
  return [...held].reduce((sum, { byteLength }) => sum + byteLength, 0);
}
