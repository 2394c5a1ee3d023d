import type { ReadonlySignal } from "@preact/signals";
import type { TreeTable } from "../../../scene/table/tree-table";
import type { Vec3 } from "../../../scene/vector";
import type { DrawingPlane } from "../../../wire/generated";
import { type Copy, copiesOf, OFF, type Symmetry, type SymmetryCentre } from "./symmetry";

/** What a centre is found with. */
export interface CentreFinder {
  readonly table: Pick<TreeTable, "parent" | "position">;
  readonly view: { drawingPlane(through: Vec3): DrawingPlane };
  /** The foot of the plant nearest to a place on the canvas. */
  readonly base: (x: number, y: number) => Vec3;
}

/** The centre of a stroke that begins at a place on the canvas: on the branch of a row, or beside every branch. */
export function centreAt(
  { table, view, base }: CentreFinder,
  row: number | null,
  x: number,
  y: number,
): SymmetryCentre {
  const foot = row === null ? base(x, y) : footOf(table, row);
  return { foot, mirrorNormal: view.drawingPlane(foot).right };
}

/** The symmetry in force: none while one branch alone grows, for its like on the other side would not. */
export function symmetryNow(settings: { readonly symmetry: ReadonlySignal<Symmetry> }, bud: number | null): Symmetry {
  return bud === null ? settings.symmetry.value : OFF;
}

/** Finds the copies of strokes, and shows what they are repeated about. */
export function strokeCopies(
  finder: CentreFinder,
  symmetry: () => Symmetry,
  show: (centre: SymmetryCentre) => void,
): (row: number | null, x: number, y: number) => readonly Copy[] {
  return (row, x, y) => {
    const centre = centreAt(finder, row, x, y);
    show(centre);
    return copiesOf(symmetry(), centre);
  };
}

/** Where the plant of a row stands. */
function footOf({ parent, position }: CentreFinder["table"], row: number): Vec3 {
  let seed = row;
  for (let bearer = parent[seed] ?? -1; bearer >= 0; bearer = parent[seed] ?? -1) {
    seed = bearer;
  }
  return [position[3 * seed] ?? 0, position[3 * seed + 1] ?? 0, position[3 * seed + 2] ?? 0];
}
