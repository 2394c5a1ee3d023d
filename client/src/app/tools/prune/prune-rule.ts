import type { Key } from "../../words/say";

/** The text for a user where nothing can be cut off (`PR1`). */
export const TRUNK_STAYS: Key = "tools.trunk-stays";

/** What is asked of the rows. */
export interface Wood {
  readonly rows: number;
  readonly parent: ArrayLike<number>;
  readonly startsAxis: ArrayLike<number>;
  readonly radiusCode: ArrayLike<number>;
  readonly light: ArrayLike<number>;
}

/** Says where branches come off (`PR1`), as the server will; for the rows as they are when it is made. */
export class PruneRule {
  #wood: Wood;
  #limits: ReadonlySet<number>;
  /** How many living branches each row bears. */
  #borne: Uint16Array;

  /** `limits` are the rows whose width is set: a stub stays there. */
  constructor(wood: Wood, limits: ReadonlySet<number>) {
    this.#wood = wood;
    this.#limits = limits;
    this.#borne = new Uint16Array(wood.rows);
    for (let row = 0; row < wood.rows; row += 1) {
      const parent = wood.parent[row] ?? -1;
      if (parent >= 0 && this.#alive(row)) this.#borne[parent]! += 1;
    }
  }

  /** The rows that what is cut off at a row begins with; none for the trunk, which cannot be cut. */
  cutsAt(row: number): number[] {
    const { parent, startsAxis } = this.#wood;
    if (!this.#alive(row)) return [];
    if (this.#limits.has(row)) return this.#above(row);
    for (let at = row; ; ) {
      const below = parent[at] ?? -1;
      // A plant's first metamer begins its trunk.
      if (below < 0 || (parent[below] ?? -1) < 0) return [];
      if (startsAxis[at] === 1 || this.#borne[below]! > 1) return [at];
      if (this.#limits.has(below)) return [at];
      at = below;
    }
  }

  /** The same for many rows; what is above another cut is left out. */
  cutsAtAll(rows: Iterable<number>): number[] {
    const cuts = new Set<number>();
    for (const row of rows) for (const cut of this.cutsAt(row)) cuts.add(cut);
    return [...cuts].filter((cut) => !this.#isAbove(cut, cuts)).sort((a, b) => a - b);
  }

  /** The lateral branches none of whose metamers gets more light than `exposure`, 0 to 1 (`PR3`). */
  dim(exposure: number): number[] {
    const { rows, parent, startsAxis, light } = this.#wood;
    const brightest = new Uint8Array(rows);
    for (let row = rows - 1; row >= 0; row -= 1) {
      if (!this.#alive(row)) continue;
      const own = Math.max(brightest[row]!, light[row] ?? 0);
      brightest[row] = own;
      const below = parent[row] ?? -1;
      if (below >= 0) brightest[below] = Math.max(brightest[below]!, own);
    }
    const limit = 255 * exposure;
    const cuts = new Set<number>();
    const gone = new Uint8Array(rows);
    for (let row = 0; row < rows; row += 1) {
      const below = parent[row] ?? -1;
      if (below < 0 || !this.#alive(row)) continue;
      const lateral = startsAxis[row] === 1 && (parent[below] ?? -1) >= 0;
      if (gone[below] === 1) gone[row] = 1;
      else if (lateral && brightest[row]! <= limit) {
        gone[row] = 1;
        cuts.add(row);
      }
    }
    return [...cuts];
  }

  #above(row: number): number[] {
    const { rows, parent } = this.#wood;
    const found: number[] = [];
    for (let next = row + 1; next < rows && found.length < this.#borne[row]!; next += 1) {
      if (parent[next] === row && this.#alive(next)) found.push(next);
    }
    return found;
  }

  #isAbove(cut: number, cuts: ReadonlySet<number>): boolean {
    const { parent } = this.#wood;
    for (let at = parent[cut] ?? -1; at >= 0; at = parent[at] ?? -1) if (cuts.has(at)) return true;
    return false;
  }

  #alive(row: number): boolean {
    return this.#wood.radiusCode[row] !== 0 && (this.#wood.parent[row] ?? -1) >= 0;
  }
}
