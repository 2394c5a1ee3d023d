/** How long all the growth of one frame takes to ease in, in seconds. */
const CASCADE_SECONDS = 0.25;

/** The order in which the rows of one frame ease in. */
export class Cascade {
  /** The first row that was not there before the frame. */
  firstNew: number;

  constructor(rows: number) {
    this.firstNew = rows;
  }

  /** Rows that were cut off and come again are new. */
  shrinkTo(rows: number): void {
    this.firstNew = Math.min(this.firstNew, rows);
  }

  /** Writes birth times and durations of the rows from `first` to `end`; gives back when the last is done. */
  static schedule(
    parent: Int32Array,
    first: number,
    end: number,
    now: number,
    birth: Float32Array,
    growing: Float32Array,
  ): number {
    const depth = new Uint32Array(end - first);
    let deepest = 0;
    for (let row = first; row < end; row += 1) {
      const above = parent[row]!;
      const own = above >= first ? depth[above - first]! + 1 : 0;
      depth[row - first] = own;
      deepest = Math.max(deepest, own);
    }
    const each = CASCADE_SECONDS / (deepest + 1);
    for (let row = first; row < end; row += 1) {
      birth[row] = now + depth[row - first]! * each;
      growing[row] = each;
    }
    return now + CASCADE_SECONDS;
  }
}
