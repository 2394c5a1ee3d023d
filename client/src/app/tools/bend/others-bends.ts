import { BendOverlay } from "../../../scene/overlay/bend-overlay";
import type { TreeTable } from "../../../scene/table/tree-table";
import type { BendFrame, RowMotion } from "../../../wire/bend-frame";
import type { ShapingView } from "../shaping-view";

/** The bend that this page has in progress. */
export interface OwnBends {
  owns(path: readonly number[]): boolean;
  over(path: readonly number[]): void;
}

/** Draws the branches that others are bending (`BE5`); those of this page are drawn by its own tool. */
export class OthersBends {
  #table: TreeTable;
  #view: ShapingView;
  #own: OwnBends;
  #shown = new Map<number, BendOverlay>();
  /** Paths of bends of one's own, by the server's numbers. */
  #mine = new Map<number, readonly number[]>();

  constructor(table: TreeTable, view: ShapingView, own: OwnBends) {
    this.#table = table;
    this.#view = view;
    this.#own = own;
  }

  receive({ bend, motions }: BendFrame): void {
    if (motions.length === 0) {
      this.#end(bend);
      return;
    }
    const path = motions.map(({ row }) => row);
    if (this.#mine.has(bend) || this.#own.owns(path)) {
      this.#mine.set(bend, path);
      return;
    }
    this.#show(bend, path, motions);
  }

  /** Forgets all of them, for another session or another connection, which sends them again. */
  clear(): void {
    for (const bent of this.#shown.values()) {
      this.#view.removeOverlay(bent);
    }
    this.#shown.clear();
    this.#mine.clear();
  }

  #show(bend: number, path: readonly number[], motions: readonly RowMotion[]): void {
    let bent = this.#shown.get(bend);
    if (!bent || !this.#view.hasOverlay(bent)) {
      if (!isPath(this.#table, path)) {
        return;
      }
      bent = new BendOverlay(this.#table, path);
      this.#shown.set(bend, bent);
      this.#view.addOverlay(bent);
    }
    bent.move(motions);
    this.#view.overlayChanged();
  }

  /** The change of the table has come right before, if the pose was kept. */
  #end(bend: number): void {
    const bent = this.#shown.get(bend);
    const mine = this.#mine.get(bend);
    this.#shown.delete(bend);
    this.#mine.delete(bend);
    if (bent) {
      this.#view.removeOverlay(bent);
    }
    if (mine) {
      this.#own.over(mine);
    }
  }
}

function isPath(table: TreeTable, path: readonly number[]): boolean {
  return path.every(
    (row, i) => row < table.rows && table.radiusCode[row] !== 0 && (i === 0 || table.parent[row] === path[i - 1]),
  );
}
