import type { BranchShape } from "./branch-shape";
import { bearerOf, ROOT } from "./design-model";

/** How far beside an axis a finger may come down and still mean it, in pixels. */
const BESIDE = 26;

type Project = (point: readonly [number, number, number]) => readonly [number, number] | null;

/** Branches that a finger may mean, those first that are meant first: beside the chosen one, and then beside its bearers. */
export function pickable(
  chosen: string,
  shapes: ReadonlyMap<string, BranchShape>,
): readonly (readonly BranchShape[])[] {
  const levels: BranchShape[][] = [];
  for (let path: string | null = chosen === ROOT ? `${ROOT}0` : chosen; path !== null && path !== ROOT; ) {
    const bearer: string | null = bearerOf(path);
    levels.push([...shapes.values()].filter((shape) => shape.path !== ROOT && bearerOf(shape.path) === bearer));
    path = bearer;
  }
  return levels;
}

/** Branches that the chosen one bears. */
export function borneBy(path: string, shapes: ReadonlyMap<string, BranchShape>): readonly BranchShape[] {
  return [...shapes.values()].filter((shape) => shape.path !== ROOT && bearerOf(shape.path) === path);
}

/** The branch at a place on the canvas: of those whose shells the finger is on, or nearly, the one whose axis is nearest. */
export function pickBranch(
  levels: readonly (readonly BranchShape[])[],
  hits: readonly string[],
  project: Project,
  x: number,
  y: number,
): string | null {
  for (const level of levels) {
    let [found, least]: [string | null, number] = [null, Number.POSITIVE_INFINITY];
    for (const shape of level) {
      const far = distanceTo(shape, project, x, y);
      if (far < least && (far < BESIDE || hits.includes(shape.path))) {
        [found, least] = [shape.path, far];
      }
    }
    if (found !== null) {
      return found;
    }
  }
  return null;
}

/** How far a place is from an axis as it is seen, in pixels. */
function distanceTo(shape: BranchShape, project: Project, x: number, y: number): number {
  const places = shape.axis().map(project);
  let least = Number.POSITIVE_INFINITY;
  for (let at = 0; at + 1 < places.length; at += 1) {
    const [from, to] = [places[at], places[at + 1]];
    if (from && to) {
      const [ax, ay] = [to[0] - from[0], to[1] - from[1]];
      const share = ((x - from[0]) * ax + (y - from[1]) * ay) / Math.max(ax * ax + ay * ay, 1e-6);
      const within = Math.min(Math.max(share, 0), 1);
      least = Math.min(least, Math.hypot(from[0] + ax * within - x, from[1] + ay * within - y));
    }
  }
  return least;
}
