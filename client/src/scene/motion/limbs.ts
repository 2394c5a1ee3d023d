/** In place of a row, limb or joint that is not there. */
export const NONE = -1;

/** Rows in birth order, as the table has them: what joints are made from. */
export interface MotionRows {
  /** -1 for a seed. */
  readonly parent: Int32Array;
  /** The row that goes on as the same limb, or -1. */
  readonly onward: Int32Array;
  /** Where each metamer ends, in steps of 1/256 internode: x y z. */
  readonly quantised: Int32Array;
  /** Radius codes; 0 for seeds and the dead. */
  readonly radiusCode: Uint16Array;
  /** How many leaves each bears. */
  readonly leaves: Uint8Array;
}

/** Which rows are one limb; those that bear stand before those that are borne. */
export interface Limbs {
  readonly count: number;
  /** The limb of each row; none for seeds and the dead. */
  readonly of: Int32Array;
  /** The lowest row of each. */
  readonly first: Int32Array;
  /** The row at whose node each begins. */
  readonly node: Int32Array;
  /** The limb that bears each; none for what grows from a seed. */
  readonly bearer: Int32Array;
  /** Where the rows of each begin in `rows`, and behind the last where they end. */
  readonly begin: Int32Array;
  /** The rows of all, base first. */
  readonly rows: Int32Array;
}

/** Whether a row is drawn: it lives and is no seed. */
export function isWood({ parent, radiusCode }: MotionRows, row: number): boolean {
  return radiusCode[row] !== 0 && parent[row]! >= 0;
}

/** O(rows). */
export function limbsOf(rows: MotionRows): Limbs {
  const { parent, onward } = rows;
  const count = parent.length;
  const of = new Int32Array(count).fill(NONE);
  const first: number[] = [];
  const node: number[] = [];
  const bearer: number[] = [];
  const length: number[] = [];
  for (let row = 0; row < count; row += 1) {
    if (!isWood(rows, row)) continue;
    const below = parent[row]!;
    const bears = of[below]!;
    // What grows from a seed is a limb of its own even where it goes on from the seed.
    if (bears !== NONE && onward[below] === row) {
      of[row] = bears;
      length[bears]! += 1;
      continue;
    }
    of[row] = first.length;
    first.push(row);
    node.push(below);
    bearer.push(bears);
    length.push(1);
  }
  const begin = new Int32Array(first.length + 1);
  for (const [limb, rows] of length.entries()) begin[limb + 1] = begin[limb]! + rows;
  const next = begin.slice();
  const ordered = new Int32Array(begin[first.length]!);
  for (let row = 0; row < count; row += 1) {
    const limb = of[row]!;
    if (limb === NONE) continue;
    ordered[next[limb]!] = row;
    next[limb]! += 1;
  }
  return {
    count: first.length,
    of,
    first: Int32Array.from(first),
    node: Int32Array.from(node),
    bearer: Int32Array.from(bearer),
    begin,
    rows: ordered,
  };
}
