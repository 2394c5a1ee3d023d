import type { TreeTable } from "../table/tree-table";
import { css, RAMPS, type Ramp } from "./ramps";

/** Ways to draw the tree, in the order of a menu. */
export const DRAW_MODES = ["lit", "skeleton", "wireframe", "exposure", "vigor", "age", "order"] as const;
export type DrawMode = (typeof DRAW_MODES)[number];

/** The mode that stands after one in the menu (1), or before it (−1). */
export function nextDrawMode(mode: DrawMode, direction: -1 | 1): DrawMode {
  const place = DRAW_MODES.indexOf(mode) + direction + DRAW_MODES.length;
  return DRAW_MODES[place % DRAW_MODES.length] ?? mode;
}

/** What the colours of a draw mode mean. */
export interface Legend {
  readonly mode: DrawMode;
  /** CSS colours from the low end of the range to the high one, evenly spaced. */
  readonly colours: readonly string[];
  /** What the ends stand for. */
  readonly range: readonly [low: number, high: number];
  /** Share of the most there can be; steps of growth; how often the axis branched off the trunk. */
  readonly unit: "share" | "steps" | "order";
}

/** A number each row has that a draw mode shows as a colour. */
export interface Trait {
  readonly ramp: Ramp;
  readonly unit: Legend["unit"];
  /** The number as the graphics card keeps it. */
  of(table: TreeTable, row: number, orders: Uint16Array): number;
  /** Which of those numbers has the ramp's first colour, and which its last. */
  ends(extremes: Extremes): readonly [first: number, last: number];
  /** What the two ends mean to a person. */
  range(extremes: Extremes): readonly [low: number, high: number];
}

/** The least and the greatest number among the rows. */
export interface Extremes {
  readonly least: number;
  readonly most: number;
}

const share = () => [0, 1] as const;

/** The modes that show one number of each row. */
export const TRAITS: Partial<Record<DrawMode, Trait>> = {
  exposure: {
    ramp: RAMPS.magma,
    unit: "share",
    of: (table, row) => table.light[row]! / 255,
    ends: share,
    range: share,
  },
  vigor: {
    ramp: RAMPS.viridis,
    unit: "share",
    of: (table, row) => (table.foliage[row]! >> 4) / 15,
    ends: share,
    range: share,
  },
  age: {
    ramp: RAMPS.cividis,
    unit: "steps",
    of: (table, row) => table.born[row]!,
    // Rows keep the step in which they were born, so that a step of growth rewrites none of them.
    ends: ({ least, most }) => [most, Math.min(least, most - 1)],
    range: ({ least, most }) => [0, Math.max(1, most - least)],
  },
  order: {
    ramp: RAMPS.plasma,
    unit: "order",
    of: (_, row, orders) => orders[row]!,
    ends: ({ most }) => [0, Math.max(1, most)],
    range: ({ most }) => [0, Math.max(1, most)],
  },
};

/** What a mode's colours mean where the rows' numbers reach so far; null for modes that show no number. */
export function legendOf(mode: DrawMode, extremes: Extremes): Legend | null {
  const trait = TRAITS[mode];
  return trait ? { mode, colours: trait.ramp.map(css), range: trait.range(extremes), unit: trait.unit } : null;
}
