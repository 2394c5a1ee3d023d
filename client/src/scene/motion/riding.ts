import type { TreeTable } from "../table/tree-table";
import { NONE } from "./limbs";
import { type Moving, PHASE, PIVOT, ROW_NUMBERS } from "./moving";
import { FIRST, JOINT, SECOND, WEIGHT } from "./rides";

/** How rows ride on their joints, also those that have changed since joints were made: they go on as the rows below them. */
export class Riding {
  /** See `ROW_NUMBERS`. */
  rows: Float32Array;
  count: number;
  private parent: Int32Array;
  private quantised: Int32Array;

  constructor({ rows, rowCount }: Moving, parent: Int32Array, quantised: Int32Array) {
    this.rows = rows;
    this.count = rowCount;
    this.parent = parent;
    this.quantised = quantised;
  }

  /** Takes over what has changed in the table since; gives the first row that rides otherwise, or null where none does. */
  follow(table: TreeTable): number | null {
    const before = Math.min(this.count, table.rows);
    let first = this.count === table.rows ? Number.POSITIVE_INFINITY : before;
    this.reserve(table.rows);
    const changed = new Uint8Array(table.rows);
    for (let row = 0; row < table.rows; row += 1) {
      const parent = table.parent[row]!;
      const at = 3 * row;
      const same =
        row < before &&
        this.parent[row] === parent &&
        this.quantised[at] === table.quantised[at] &&
        this.quantised[at + 1] === table.quantised[at + 1] &&
        this.quantised[at + 2] === table.quantised[at + 2];
      if (same && (parent < 0 || changed[parent] === 0)) continue;
      changed[row] = 1;
      first = Math.min(first, row);
      this.write(table, row, parent, row < before && this.parent[row] === parent);
      this.parent[row] = parent;
      for (let a = at; a < at + 3; a += 1) this.quantised[a] = table.quantised[a]!;
    }
    this.count = table.rows;
    return Number.isFinite(first) ? first : null;
  }

  /** A row that is new goes on as its parent does; one that has only moved keeps its joint and its weight. */
  private write(table: TreeTable, row: number, parent: number, moved: boolean): void {
    const { rows } = this;
    const [to, from] = [ROW_NUMBERS * row, ROW_NUMBERS * parent];
    if (parent < 0) {
      rows.fill(0, to, to + ROW_NUMBERS);
      rows[to + JOINT] = NONE;
      rows[to + PHASE] = -1;
      return;
    }
    const [joint, weight] = moved
      ? [rows[to + JOINT]!, rows[to + WEIGHT]!]
      : [rows[from + JOINT]!, rows[from + WEIGHT]!];
    // A joint begins at rest; all others go on from the row below.
    const begins = moved && joint !== rows[from + JOINT];
    const below = begins ? 0 : rows[from + WEIGHT]!;
    const middle = 0.5 * (below + weight);
    for (let a = 0; a < 3; a += 1) {
      const way = table.position[3 * row + a]! - table.position[3 * parent + a]!;
      rows[to + FIRST + a] = (begins ? 0 : rows[from + FIRST + a]!) + middle * way;
      rows[to + SECOND + a] = (begins ? 0 : rows[from + SECOND + a]!) + middle * middle * way;
    }
    rows[to + JOINT] = joint;
    rows[to + WEIGHT] = weight;
    if (!moved) rows.copyWithin(to + PIVOT, from + PIVOT, from + PIVOT + 4);
  }

  private reserve(count: number): void {
    if (ROW_NUMBERS * count <= this.rows.length) return;
    const capacity = Math.max(count, Math.ceil(1.5 * this.count));
    const larger = <T extends Float32Array | Int32Array>(array: T, made: T): T => {
      made.set(array);
      return made;
    };
    this.rows = larger(this.rows, new Float32Array(ROW_NUMBERS * capacity));
    this.parent = larger(this.parent, new Int32Array(capacity));
    this.quantised = larger(this.quantised, new Int32Array(3 * capacity));
  }
}
