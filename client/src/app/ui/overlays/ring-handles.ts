import type { Ring } from "./ring";

/** Room between a ring and its knobs. */
const KNOB_GAP = 26;
/** A finger needs so much for a knob, and as much for the dot between two. */
const TARGET = 44;

/** Where the dot in the middle of a ring and the knobs on either side stand on the screen, as custom properties. */
export function ringHandles({ ends, middle }: Pick<Ring, "ends" | "middle">): Readonly<Record<`--${string}`, string>> {
  const [[ax, ay], [bx, by]] = ends;
  const length = Math.hypot(bx - ax, by - ay) || 1;
  const [ux, uy] = [(bx - ax) / length, (by - ay) / length];
  const [x, y] = middle;
  const away = Math.max(length / 2 + KNOB_GAP, TARGET);
  const pixels = (value: number) => `${value.toFixed(1)}px`;
  return {
    "--x": pixels(x),
    "--y": pixels(y),
    "--left-x": pixels(x - away * ux),
    "--left-y": pixels(y - away * uy),
    "--right-x": pixels(x + away * ux),
    "--right-y": pixels(y + away * uy),
  };
}
