import { signal } from "@preact/signals";
import type { Vec3 } from "../../scene/vector";

/** What is asked of the rows. */
export interface Rows {
  readonly rows: number;
  readonly position: ArrayLike<number>;
  /** 0 for the dead. */
  readonly radiusCode: ArrayLike<number>;
}

/** The branch that alone may grow, if one is chosen (`SG1`). */
export class ChosenBud {
  /** The row of a metamer on it. */
  readonly row = signal<number | null>(null);
  #rows: Rows;
  #place: Vec3 = [0, 0, 0];

  constructor(rows: Rows) {
    this.#rows = rows;
  }

  choose(row: number): void {
    this.#place = this.#placeOf(row);
    this.row.value = row;
  }

  release(): void {
    this.row.value = null;
  }

  /** Releases a branch that is no longer there; false if it did. */
  keep(): boolean {
    const row = this.row.peek();
    if (row === null) {
      return true;
    }
    const { rows, radiusCode } = this.#rows;
    // After going back in time, another metamer may get the same row.
    const same = row < rows && radiusCode[row] !== 0 && this.#placeOf(row).every((x, axis) => x === this.#place[axis]);
    if (!same) {
      this.release();
    }
    return same;
  }

  #placeOf(row: number): Vec3 {
    const { position } = this.#rows;
    return [position[3 * row] ?? 0, position[3 * row + 1] ?? 0, position[3 * row + 2] ?? 0];
  }
}
