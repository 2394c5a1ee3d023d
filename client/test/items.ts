import type { DataTexture, Mesh, ShaderMaterial } from "three";
import { BlockGeometry } from "../src/scene/block-geometry";

/** The texture that a mesh reads its things from. */
export function textureOf({ material }: Mesh): DataTexture {
  return (material as ShaderMaterial).uniforms.uItems!.value;
}

/** How many things a mesh draws, those included that show nothing. */
export function countOf({ geometry, material }: Mesh): number {
  const [count, step] = (material as ShaderMaterial).uniforms.uItemsDrawn!.value as [number, number];
  const capacity = geometry instanceof BlockGeometry ? geometry.instanceCount * geometry.block : 0;
  if (capacity * step < count) throw new Error(`${count} things, but a capacity of ${capacity * step}`);
  return Math.ceil(count / step);
}

/** Triangles that meshes draw. */
export function trianglesOf(meshes: readonly Mesh[]): number {
  return meshes.reduce((sum, mesh) => sum + countOf(mesh) * (mesh.geometry as BlockGeometry).triangles, 0);
}

/** The numbers of each thing that a mesh draws, so many each. */
export function itemsOf(mesh: Mesh, numbers: number): number[][] {
  const { data } = textureOf(mesh).image as { data: ArrayLike<number> };
  return Array.from({ length: countOf(mesh) }, (_, i) =>
    Array.from({ length: numbers }, (_, at) => data[i * numbers + at]!),
  );
}

/** How many leaves, flowers or fruits of each row a mesh draws. */
export function borneOf(mesh: Mesh): Map<number, number> {
  const counts = new Map<number, number>();
  for (const [row, , , , tint] of itemsOf(mesh, 8)) if (tint! >= 0) counts.set(row!, (counts.get(row!) ?? 0) + 1);
  return new Map([...counts].sort((a, b) => a[0] - b[0]));
}
