/** Meshes with more triangles count as open: checking every edge would be slow. */
const MOST_TRIANGLES = 100_000;

/** The triangles of a mesh, all facing outwards; null if the mesh is not closed. */
export function facingOut(positions: Float32Array, triangles: Uint32Array): Uint32Array | null {
  if (!isClosed(triangles, positions.length / 3)) return null;
  if (volume(positions, triangles) >= 0) return triangles;
  const turned = triangles.slice();
  for (let i = 0; i < turned.length; i += 3) [turned[i], turned[i + 1]] = [turned[i + 1]!, turned[i]!];
  return turned;
}

/** Whether each edge is passed once in each direction. */
function isClosed(triangles: Uint32Array, vertices: number): boolean {
  if (triangles.length === 0 || triangles.length > 3 * MOST_TRIANGLES) return false;
  const single = new Set<number>();
  for (let i = 0; i < triangles.length; i += 3) {
    for (let side = 0; side < 3; side += 1) {
      const [a, b] = [triangles[i + side]!, triangles[i + ((side + 1) % 3)]!];
      if (single.delete(b * vertices + a)) continue;
      const edge = a * vertices + b;
      if (single.has(edge)) return false;
      single.add(edge);
    }
  }
  return single.size === 0;
}

/** Six times the volume inside; below 0 where triangles face inwards. */
export function volume(positions: Float32Array, triangles: Uint32Array): number {
  let sum = 0;
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [3 * triangles[i]!, 3 * triangles[i + 1]!, 3 * triangles[i + 2]!];
    const [ax, ay, az] = [positions[a]!, positions[a + 1]!, positions[a + 2]!];
    const [bx, by, bz] = [positions[b]!, positions[b + 1]!, positions[b + 2]!];
    const [cx, cy, cz] = [positions[c]!, positions[c + 1]!, positions[c + 2]!];
    sum += ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
  }
  return sum;
}
