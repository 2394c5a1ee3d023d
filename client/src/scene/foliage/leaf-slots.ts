import { grown } from "../table/column";

const NONE = -1;

/**
 * Gives each row a run of consecutive slots for its leaves; runs given back are used again for as many leaves, so
 * that a leaf moves only when all are moved together.
 */
export class LeafSlots {
  /** Slots in use or to be used again: instances to draw. */
  end = 0;
  /** Slots in use. */
  filled = 0;
  private first = new Int32Array(0);
  private count = new Uint8Array(0);
  private rows = 0;
  private readonly free: number[][] = Array.from({ length: 16 }, () => []);

  /** Where the row's run begins, or -1. */
  firstOf(row: number): number {
    return row < this.rows && this.count[row]! > 0 ? this.first[row]! : NONE;
  }

  /** How many leaves the row has. */
  countOf(row: number): number {
    return row < this.rows ? this.count[row]! : 0;
  }

  /** Gives the row `count` slots in place of what it had; the slots it loses go to `cleared`. */
  assign(row: number, count: number, cleared: (first: number, count: number) => void): void {
    if (row >= this.rows) {
      this.first = grown(this.first, Math.max(1024, 2 ** Math.ceil(Math.log2(row + 1))));
      this.count = grown(this.count, this.first.length);
      this.count.fill(0, this.rows, row + 1);
      this.rows = row + 1;
    }
    const before = this.count[row]!;
    if (before === count) return;
    if (before > 0) {
      this.free[before]!.push(this.first[row]!);
      cleared(this.first[row]!, before);
    }
    this.count[row] = count;
    this.filled += count - before;
    if (count === 0) return;
    const again = this.free[count]!.pop();
    if (again === undefined) {
      this.first[row] = this.end;
      this.end += count;
    } else {
      this.first[row] = again;
    }
  }

  /** Takes the slots of every row from `rows` on. */
  truncate(rows: number, cleared: (first: number, count: number) => void): void {
    for (let row = rows; row < this.rows; row += 1) this.assign(row, 0, cleared);
    this.rows = Math.min(this.rows, rows);
    if (this.rows > 0) return;
    this.end = 0;
    for (const runs of this.free) runs.length = 0;
  }

  /** Leaves no slot unused between those in use; what was in a run goes along by `move`, from the first on. */
  compact(move: (to: number, from: number, count: number) => void): void {
    const holder = new Int32Array(this.end).fill(NONE);
    for (let row = 0; row < this.rows; row += 1) if (this.count[row]! > 0) holder[this.first[row]!] = row;
    let end = 0;
    for (const [from, row] of holder.entries()) {
      if (row === NONE) continue;
      const count = this.count[row]!;
      if (from !== end) move(end, from, count);
      this.first[row] = end;
      end += count;
    }
    this.end = end;
    for (const runs of this.free) runs.length = 0;
  }
}
