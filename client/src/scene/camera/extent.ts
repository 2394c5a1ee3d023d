import type { Box } from "./camera-view";

/** Obstacles this far beyond the tree, in internodes, still cast shadows; and further where the tree is larger. */
const REACH = 40;

/** The tree with what stands around it; what stands far off has no shadow worth the map's pixels, nor a look back. */
export function extent(tree: Box, around: Box | null): Box {
  if (!around) return tree;
  const reach = REACH + Math.max(...tree.max.map((high, axis) => high - tree.min[axis]!));
  const axes = [0, 1, 2] as const;
  const low = (axis: 0 | 1 | 2) => Math.min(tree.min[axis], Math.max(around.min[axis], tree.min[axis] - reach));
  const high = (axis: 0 | 1 | 2) => Math.max(tree.max[axis], Math.min(around.max[axis], tree.max[axis] + reach));
  return { min: axes.map(low) as [number, number, number], max: axes.map(high) as [number, number, number] };
}
