import type { Box } from "../camera/camera-view";

/** How far off a box begins, has its middle, and ends. */
export interface Reach {
  /** 0 inside it. */
  readonly nearest: number;
  readonly middle: number;
  readonly farthest: number;
}

/** How far a box is from a place. */
export function reachFrom(place: readonly number[], { min, max }: Box): Reach {
  const axes = [0, 1, 2] as const;
  const length = (off: (axis: 0 | 1 | 2) => number) => Math.hypot(...axes.map(off));
  return {
    nearest: length((axis) => Math.max(min[axis] - place[axis]!, 0, place[axis]! - max[axis])),
    middle: length((axis) => (min[axis] + max[axis]) / 2 - place[axis]!),
    farthest: length((axis) => Math.max(place[axis]! - min[axis], max[axis] - place[axis]!)),
  };
}
