import type { Schematic } from "../../../../wire/generated";
import { short } from "./place";

/** Lines of about the same girth, as the data of one path. */
export interface Stroke {
  /** In internodes. */
  readonly width: number;
  readonly path: string;
}

/** A schematic tree as lines in internodes, y upwards, with what it fills. */
export interface SchematicPicture {
  readonly wood: readonly Stroke[];
  /** A point, as a line without length, for each place with leaves. */
  readonly leaves: string;
  /** The farthest to either side. */
  readonly aside: number;
  readonly above: number;
  /** How far it hangs below the ground; 0 or more. */
  readonly below: number;
}

/** Girths that differ by less than this factor are drawn alike. */
const GRADE = Math.SQRT2;

export function pictureOf({ segments, radii, leaves }: Schematic): SchematicPicture {
  const paths = new Map<number, string>();
  let [aside, above, below, foliage] = [0, 0, 0, ""];
  radii.forEach((radius, i) => {
    const [x0 = 0, y0 = 0, x1 = 0, y1 = 0] = segments.slice(4 * i, 4 * i + 4);
    const grade = Math.round(Math.log(Math.max(1e-3, 2 * radius)) / Math.log(GRADE));
    const line = `M${short(x0)} ${short(y0)}L${short(x1)} ${short(y1)}`;
    paths.set(grade, (paths.get(grade) ?? "") + line);
    if ((leaves[i] ?? 0) > 0) {
      foliage += `M${short(x1)} ${short(y1)}h0`;
    }
    aside = Math.max(aside, Math.abs(x1));
    above = Math.max(above, y1);
    below = Math.max(below, -y1);
  });
  const wood = [...paths].sort(([a], [b]) => a - b).map(([grade, path]) => ({ width: GRADE ** grade, path }));
  return { wood, leaves: foliage, aside, above, below };
}

/** How a picture is laid into a box: pixels for an internode, and where the ground is, from the top. */
export interface Layout {
  readonly scale: number;
  readonly ground: number;
}

/** What is left free around the tree, in pixels. */
const MARGIN = { aside: 14, above: 16, below: 16 };
/** A seedling is drawn as small as it is beside a tree of this height. */
const LEAST_HEIGHT = 8;

/** The largest layout in which all of a tree is within a box, in pixels, its trunk in the middle. */
export function layoutOf({ aside, above, below }: SchematicPicture, width: number, height: number): Layout {
  const upright = (height - MARGIN.above - MARGIN.below) / Math.max(LEAST_HEIGHT, above + below);
  const level = (width / 2 - MARGIN.aside) / Math.max(1, aside);
  const scale = Math.max(0, Math.min(upright, level));
  return { scale, ground: height - MARGIN.below - below * scale };
}
