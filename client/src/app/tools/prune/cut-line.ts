import type { Vec3 } from "../../../scene/vector";

/** What is asked of the rows. */
interface Rows {
  readonly rows: number;
  readonly parent: ArrayLike<number>;
  readonly radiusCode: ArrayLike<number>;
}

/** Which metamers a line on the screen crosses, as they were seen last. */
export class CutLine {
  #rows: Rows;
  #see: (row: number) => readonly [number, number] | null;
  /** x and y of each row's end on the screen; not a number behind the eye. */
  #places: Float32Array;
  #last: readonly [number, number] | null = null;

  /** `project` tells where a row's end lies on the screen. */
  constructor(rows: Rows, placeOf: (row: number) => Vec3, project: (point: Vec3) => readonly [number, number] | null) {
    this.#rows = rows;
    this.#see = (row) => project(placeOf(row));
    this.#places = new Float32Array(2 * rows.rows);
    this.look();
  }

  /** Sees anew where rows are, which may have moved. */
  look(): void {
    for (let row = 0; 2 * row < this.#places.length; row += 1) {
      const [x, y] = this.#see(row) ?? [Number.NaN, Number.NaN];
      this.#places[2 * row] = x;
      this.#places[2 * row + 1] = y;
    }
  }

  /** Draws the line on to a place, and gives the rows of the living metamers that this piece crosses. */
  to(x: number, y: number): number[] {
    const from = this.#last;
    this.#last = [x, y];
    return from ? this.#crossed(from[0], from[1], x, y) : [];
  }

  #crossed(ax: number, ay: number, bx: number, by: number): number[] {
    const { rows, parent, radiusCode } = this.#rows;
    const places = this.#places;
    const [left, right, top, bottom] = [Math.min(ax, bx), Math.max(ax, bx), Math.min(ay, by), Math.max(ay, by)];
    const found: number[] = [];
    for (let row = 0; row < rows; row += 1) {
      const below = parent[row]!;
      if (below < 0 || radiusCode[row] === 0) continue;
      const [cx, cy] = [places[2 * below]!, places[2 * below + 1]!];
      const [dx, dy] = [places[2 * row]!, places[2 * row + 1]!];
      if ((cx < left && dx < left) || (cx > right && dx > right)) continue;
      if ((cy < top && dy < top) || (cy > bottom && dy > bottom)) continue;
      const c = side(ax, ay, bx, by, cx, cy);
      const d = side(ax, ay, bx, by, dx, dy);
      const a = side(cx, cy, dx, dy, ax, ay);
      const b = side(cx, cy, dx, dy, bx, by);
      // An end that lies on the line counts once, with the metamer that goes on from it.
      if (c >= 0 !== d >= 0 && a >= 0 !== b >= 0) found.push(row);
    }
    return found;
  }
}

/** On which side of the line from a to b a place lies. */
function side(ax: number, ay: number, bx: number, by: number, x: number, y: number): number {
  return (bx - ax) * (y - ay) - (by - ay) * (x - ax);
}
