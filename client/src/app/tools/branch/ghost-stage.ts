import { signal } from "@preact/signals";
import { BendOverlay } from "../../../scene/overlay/bend-overlay";
import { CutOverlay } from "../../../scene/overlay/cut-overlay";
import type { GhostPlacement } from "../../../scene/overlay/ghost";
import { subtreeRows } from "../../../scene/table/branch-rows";
import type { TreeTable } from "../../../scene/table/tree-table";
import type { Vec3 } from "../../../scene/vector";
import type { Viewport } from "../../../scene/viewport";
import { minus, turned, UNTURNED } from "./branch-turn";
import type { TurnPreview } from "./held-branch";

/** Room between the tree and its ghost, as a share of the tree's width, and at least in internodes. */
const GAP = 0.12;
const LEAST_GAP = 2;
/** The share of the picture, at its foot, that the question whether to keep them lies over, and the tools after it. */
const COVERED = 0.16;
/** A copy under the finger need not have every twig. */
const MOST_COPIED = 20_000;

/** What is drawn that the rows do not have: a prediction beside the tree, a copy on its way, a branch being turned. */
export class GhostStage {
  /** How far from the tree the prediction stands; null while there is none. */
  readonly beside = signal<Vec3 | null>(null);
  #table: TreeTable;
  #view: Viewport | null = null;
  #turn: { readonly overlay: BendOverlay; readonly row: number; readonly rest: Vec3 } | null = null;
  #copied: number | null = null;
  #marked: CutOverlay | null = null;

  constructor(table: TreeTable) {
    this.#table = table;
  }

  attach(view: Viewport): void {
    this.#view = view;
  }

  detach(): void {
    this.#view = null;
    this.#turn = null;
    this.#copied = null;
    this.#marked = null;
    this.beside.value = null;
  }

  /** Marks the branches that begin with these rows as what is cut off, and no others. */
  mark(cuts: readonly number[]): void {
    if (this.#marked) {
      this.#view?.removeOverlay(this.#marked);
    }
    this.#marked = cuts.length > 0 ? new CutOverlay(cuts, "marked") : null;
    if (this.#marked) {
      this.#view?.addOverlay(this.#marked);
    }
  }

  /** Where a row is drawn. */
  placeOf(row: number): Vec3 {
    const { position } = this.#table;
    return this.#view?.placeOf(row) ?? [position[3 * row] ?? 0, position[3 * row + 1] ?? 0, position[3 * row + 2] ?? 0];
  }

  /** Shows other plants to the right of the tree on the screen. */
  showBeside(plants: TreeTable): void {
    const view = this.#view;
    if (!view) {
      return;
    }
    const first = this.beside.peek() === null;
    const to = this.beside.peek() ?? this.#roomBeside(view, plants);
    this.#copied = null;
    view.showGhost(plants);
    view.placeGhost({ turn: UNTURNED, from: [0, 0, 0], to });
    this.beside.value = to;
    if (first) {
      view.camera.fitTree(COVERED);
    }
  }

  /** Shows them no longer; the tree may be about to become what they are. */
  endBeside(becoming: TreeTable | null): void {
    this.beside.value = null;
    const view = this.#view;
    view?.showGhost(null);
    if (becoming) {
      view?.camera.fitBox(becoming.bounds(), COVERED);
    } else {
      view?.camera.restore();
    }
  }

  /** Shows a copy of the branch that begins with a row; null for none. */
  showCopy(row: number | null, placement: GhostPlacement | null): void {
    const view = this.#view;
    if (row !== this.#copied) {
      this.#copied = row;
      view?.showGhost(
        row === null ? null : this.#table,
        row === null ? null : subtreeRows(this.#table, row, MOST_COPIED),
      );
    }
    if (row !== null && placement) {
      view?.placeGhost(placement);
    }
  }

  /** Draws a branch turned about a place; null for as it is. */
  showTurn(turn: TurnPreview | null): void {
    const view = this.#view;
    if (this.#turn && this.#turn.row !== turn?.row) {
      view?.removeOverlay(this.#turn.overlay);
      this.#turn = null;
    }
    if (!turn || !view) {
      return;
    }
    const { row, rotation, about } = turn;
    if (!this.#turn) {
      const { position } = this.#table;
      const rest: Vec3 = [position[3 * row] ?? 0, position[3 * row + 1] ?? 0, position[3 * row + 2] ?? 0];
      this.#turn = { overlay: new BendOverlay(this.#table, [row]), row, rest };
      view.addOverlay(this.#turn.overlay);
    }
    const [x, y, z] = turned(rotation, minus(this.#turn.rest, about));
    this.#turn.overlay.move([{ row, rotation, to: [x + about[0], y + about[1], z + about[2]] }]);
    view.overlayChanged();
  }

  /** So far to the right that nothing of the two overlaps, as the camera stands now. */
  #roomBeside(view: Viewport, plants: TreeTable): Vec3 {
    const { right } = view.drawingPlane([0, 0, 0]);
    const across = Math.hypot(right[0], right[2]) || 1;
    const level: Vec3 = [right[0] / across, 0, right[2] / across];
    const edge = ({ min, max }: ReturnType<TreeTable["bounds"]>, side: 1 | -1) =>
      Math.max(side * min[0] * level[0], side * max[0] * level[0]) +
      Math.max(side * min[2] * level[2], side * max[2] * level[2]);
    const width = edge(this.#table.bounds(), 1) + edge(this.#table.bounds(), -1);
    const way = edge(this.#table.bounds(), 1) + edge(plants.bounds(), -1) + Math.max(LEAST_GAP, GAP * width);
    return [level[0] * way, 0, level[2] * way];
  }
}
