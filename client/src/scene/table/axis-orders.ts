import { grown } from "./column";

interface Axes {
  readonly rows: number;
  readonly parent: Int32Array;
  readonly startsAxis: Uint8Array;
}

/** How often the axis of each row branched off: 0 for the trunk. Kept as rows come, move and go. */
export class AxisOrders {
  values = new Uint16Array(0);
  private known = 0;

  /** Rows from `row` on may be other ones. */
  forget(row: number): void {
    this.known = Math.min(this.known, row);
  }

  /** Brings the orders up to date; a row's is one pass away, for parents come before their children. */
  update({ rows, parent, startsAxis }: Axes): void {
    this.values = grown(this.values, parent.length);
    const { values } = this;
    for (let row = this.known; row < rows; row += 1) {
      const above = parent[row]!;
      // What grows first from a seed is its trunk, whatever its flag says.
      const lateral = above >= 0 && startsAxis[row] === 1 && parent[above]! >= 0;
      values[row] = above < 0 ? 0 : values[above]! + (lateral ? 1 : 0);
    }
    this.known = rows;
  }
}
