import type { BendOverlay } from "../../../scene/overlay/bend-overlay";
import type { TreeTable } from "../../../scene/table/tree-table";
import type { ShapingView } from "../shaping-view";

/** How long after its answer a bend may take to show in the rows, in milliseconds. */
const LINGERS = 1500;

export interface SettlingOptions {
  readonly table: TreeTable;
  readonly view: Pick<ShapingView, "hasOverlay" | "removeOverlay">;
}

/** Bends that were let go and are not yet in the table: they stay shown until they are, or come to nothing. */
export class SettlingBends {
  #options: SettlingOptions;
  /** Their numbers. */
  #bends = new Map<BendOverlay, number>();

  constructor(options: SettlingOptions) {
    this.#options = options;
  }

  add(overlay: BendOverlay, number: number): void {
    this.#bends.set(overlay, number);
  }

  /** Whether a pose is on its way; what takes hold of the branch before it comes would make it jump. */
  get pending(): boolean {
    const { table, view } = this.#options;
    return [...this.#bends.keys()].some((overlay) => view.hasOverlay(overlay) && !overlay.over(table));
  }

  /** Whether one of them bends along this path. */
  owns(path: readonly number[]): boolean {
    return [...this.#bends.keys()].some((own) => own.follows(path));
  }

  /** The server would not have one. */
  refused(number: number): void {
    this.#take((_, bend) => bend === number);
  }

  /** The server says that a bend along this path is over: what is not in the table by now never will be. */
  over(path: readonly number[]): void {
    this.#take((overlay) => overlay.follows(path));
  }

  /** The rows have changed; `answered` if the server has answered the end of every bend. */
  changed(answered: boolean): void {
    const { table, view } = this.#options;
    for (const overlay of [...this.#bends.keys()]) {
      if (!view.hasOverlay(overlay) || overlay.over(table)) {
        this.#bends.delete(overlay);
      } else if (answered) {
        this.#linger(overlay);
      }
    }
  }

  /** A bend that was answered is in the table with the next rows; if not, it came to nothing. */
  #linger(overlay: BendOverlay): void {
    setTimeout(() => this.#take((other) => other === overlay), LINGERS);
  }

  #take(which: (overlay: BendOverlay, number: number) => boolean): void {
    for (const [overlay, number] of [...this.#bends]) {
      if (which(overlay, number)) {
        this.#bends.delete(overlay);
        this.#options.view.removeOverlay(overlay);
      }
    }
  }
}
