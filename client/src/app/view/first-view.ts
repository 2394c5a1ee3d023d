import { type View, viewIn, WHOLE } from "../../scene/camera/view";

/** The part of the stage and its rows that the first view needs. */
export interface FirstViewOptions {
  readonly stage: { look(view: View): void; fitTree(): void };
  readonly table: { readonly rows: number; readonly parent: { subarray(from: number, to: number): Int32Array } };
  /** The query of the page's address. */
  readonly query: () => string;
}

/** Where the eye goes when the rows of a session come in for the first time. */
export class FirstView {
  #options: FirstViewOptions;
  #chosen = false;
  /** The view is no longer that of a fresh page. */
  #moved = false;

  constructor(options: FirstViewOptions) {
    this.#options = options;
  }

  /** Another session is opened. */
  forget(): void {
    this.#moved ||= this.#chosen;
    this.#chosen = false;
  }

  /** Rows have changed. */
  follow(): void {
    const { stage, table, query } = this.#options;
    if (this.#chosen || table.rows === 0) {
      return;
    }
    this.#chosen = true;
    // A page opens with a view that suits a seed; a tree that is there already is shown as a whole.
    const grown = table.parent.subarray(0, table.rows).some((parent) => parent >= 0);
    const view = viewIn(query()) ?? (grown && !this.#moved ? WHOLE : null);
    if (view) {
      stage.look(view);
    } else if (this.#moved) {
      stage.fitTree();
    }
  }
}
