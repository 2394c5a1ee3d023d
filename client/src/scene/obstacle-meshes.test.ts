import { type Mesh, RawShaderMaterial } from "three";
import { describe, expect, it } from "vitest";
import type { Materials } from "./materials";
import { type DrawnObstacle, ObstacleMeshes } from "./obstacle-meshes";

const materials = Object.fromEntries(
  ["clay", "clayChosen", "clayClosed", "clayClosedChosen", "clayPlane", "clayPlaneChosen", "clayDepth"].map((name) => [
    name,
    new RawShaderMaterial(),
  ]),
) as unknown as Materials;

const box: DrawnObstacle = {
  id: 1,
  shape: { kind: "box", size: [2, 4, 6] },
  pose: { position: [10, 2, 0] },
};
const ball: DrawnObstacle = { id: 2, shape: { kind: "sphere", radius: 3 }, pose: { position: [0, 3, -20] } };
const plane: DrawnObstacle = { id: 3, shape: { kind: "plane" }, pose: { position: [0, 0, 0] } };

function disposals(meshes: ObstacleMeshes): number[] {
  const gone: number[] = [];
  for (const body of meshes.bodies.children as Mesh[]) {
    body.geometry.addEventListener("dispose", () => gone.push(Number(body.name)));
  }
  return gone;
}

describe("obstacle meshes", () => {
  it("show what is on the list and let go of the rest", () => {
    const meshes = new ObstacleMeshes(materials);
    meshes.show([box, ball, plane], null);
    expect([meshes.bodies.children.length, meshes.casters.children.length]).toEqual([3, 2]);
    const gone = disposals(meshes);
    meshes.show([ball], null);
    expect(gone.sort()).toEqual([1, 3]);
    expect(meshes.bodies.children.map(({ name }) => name)).toEqual(["2"]);
    meshes.dispose();
    expect(gone.sort()).toEqual([1, 2, 3]);
    expect([meshes.bodies.children.length, meshes.casters.children.length]).toEqual([0, 0]);
  });

  it("what only moved keeps its geometry", () => {
    const meshes = new ObstacleMeshes(materials);
    meshes.show([box], null);
    const gone = disposals(meshes);
    meshes.show([{ ...box, pose: { position: [0, 9, 0] } }], 1);
    expect(gone).toEqual([]);
    expect(meshes.bounds()).toEqual({ min: [-1, 7, -3], max: [1, 11, 3] });
    const [body] = meshes.bodies.children as Mesh[];
    expect(body?.material).toBe(materials.clayClosedChosen);
  });

  it("a ray meets the nearest", () => {
    const meshes = new ObstacleMeshes(materials);
    meshes.show([box, { ...ball, pose: { position: [10, 2, -20] } }], null);
    const hit = meshes.pick({ origin: [10, 2, 50], direction: [0, 0, -1] });
    expect(hit?.id).toBe(1);
    expect(hit?.point[2]).toBeCloseTo(3);
    expect(meshes.pick({ origin: [0, 100, 50], direction: [0, 0, -1] })).toBeNull();
  });

  it("know how far below its origin a thing reaches as it is turned", () => {
    const meshes = new ObstacleMeshes(materials);
    const half = Math.SQRT1_2;
    meshes.show([{ ...box, pose: { position: [0, 0, 0], rotation: [0, 0, half, half] } }, plane], null);
    expect(meshes.depthBelow(1), "on its side it is 2 high").toBeCloseTo(1);
    expect(meshes.depthBelow(3)).toBeNull();
  });

  it("a mesh is drawn once it is here, scaled", () => {
    const meshes = new ObstacleMeshes(materials);
    const shape = { kind: "mesh", vertices: 3, triangles: 1, scale: 10 } as const;
    const wedge = { id: 7, shape, pose: { position: [0, 0, 0] as [number, number, number] } };
    meshes.show([wedge], null);
    expect(meshes.bounds()).toBeNull();
    const mesh = { positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 2, 0]), triangles: new Uint32Array([0, 1, 2]) };
    meshes.show([{ ...wedge, mesh }], null);
    expect((meshes.bodies.children as Mesh[])[0]?.material, "it may be seen from behind").toBe(materials.clay);
    expect(meshes.bounds()).toEqual({ min: [0, 0, 0], max: [10, 20, 0] });
    expect([...mesh.positions], "what was fetched stays as it is").toEqual([0, 0, 0, 1, 0, 0, 0, 2, 0]);
  });
});
