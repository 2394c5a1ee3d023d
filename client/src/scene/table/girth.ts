import { grown } from "./column";

/** What is asked of the table. */
export interface Wood {
  readonly rows: number;
  /** -1 for a seed. */
  readonly parent: Int32Array;
  /** Length along the limb from where it begins, in internodes. */
  readonly arc: Float32Array;
  readonly limbs: { readonly onward: Int32Array; readonly begins: Uint8Array };
  /** The radius that the server has for a row. */
  radiusOf(row: number): number;
}

/** Wood that has more girth than it should loses at most this much of its radius over an equal length. */
export const STEEPEST = 0.3;
/** Near what it should be it comes to it by and by, over so many of its own radii. */
export const EASES_OVER = 0.8;
/** Steps that a slope of one has in a byte. */
export const SLOPE_STEPS = 64;
export const NO_SLOPE = 128;
const WAITING = 1;
const DONE = 2;
/** A share of the radius that is too small to be seen. */
const UNSEEN = 0.01;

/**
 * Wood as thick as it is drawn. At a fork a limb may lose much of its girth at one node; what goes on takes over some
 * of that and loses it within a radius or two, so that no ledge shows. Twigs, whose internodes are long beside their
 * radii, are as the server has them.
 */
export class Girth {
  /** In internodes; 0 for the dead. */
  radius = new Float32Array(0);
  /** How fast it changes at a node, as a share of itself per internode. */
  slope = new Float32Array(0);
  private readonly stale: number[] = [];
  /** Whether a row is in that list. */
  private noted = new Uint8Array(0);

  reserve(rows: number): void {
    this.radius = grown(this.radius, rows);
    this.slope = grown(this.slope, rows);
    this.noted = grown(this.noted, rows);
  }

  /** A row's own radius has changed, or what it goes on from. */
  touch(row: number): void {
    if (this.noted[row] !== 0) return;
    this.noted[row] = WAITING;
    this.stale.push(row);
  }

  /** Brings radii and slopes up to date, up along the limbs as far as it shows; tells of each row drawn otherwise. */
  derive(table: Wood, changed: (row: number) => void): void {
    const { onward, begins } = table.limbs;
    const { stale, noted, radius } = this;
    const asked = stale.length;
    for (let i = 0; i < asked; i += 1) {
      let row = stale[i]!;
      noted[row] = DONE;
      // What a row does to those above it joins the end of the list, unless they wait in it.
      while (row >= 0 && row < table.rows) {
        const now = Math.fround(this.radiusAt(table, row));
        if (now === radius[row]) break;
        radius[row] = now;
        changed(row);
        if (noted[row] === 0) {
          noted[row] = DONE;
          stale.push(row);
        }
        row = onward[row]!;
        if (noted[row] === WAITING) break;
      }
    }
    const known = stale.length;
    for (let i = 0; i < known; i += 1) {
      const row = stale[i]!;
      if (row >= table.rows) continue;
      const below = table.parent[row]!;
      if (onward[row]! >= 0) this.touch(onward[row]!);
      if (below >= 0 && begins[row] === 0) this.touch(below);
    }
    for (const row of stale) {
      noted[row] = 0;
      if (row < table.rows) this.incline(table, row, changed);
    }
    stale.length = 0;
  }

  private radiusAt(table: Wood, row: number): number {
    const own = table.radiusOf(row);
    const below = table.parent[row]!;
    if (below < 0 || own === 0 || table.limbs.begins[row] === 1 || table.parent[below]! < 0) return own;
    const thick = this.radius[below]!;
    const left = excess(thick - own, table.arc[row]! - table.arc[below]!, thick);
    return left < UNSEEN * own ? own : own + left;
  }

  /** The slope that passes smoothly from the metamer below a node to the one above it, and never beyond either. */
  private incline(table: Wood, row: number, changed: (row: number) => void): void {
    const { arc, parent } = table;
    const { radius, slope } = this;
    const above = table.limbs.onward[row]!;
    const below = parent[row]!;
    let now = 0;
    // Wood begins as thick as its first node, and ends as its cone or its cut does.
    if (above >= 0 && below >= 0 && parent[below]! >= 0 && table.limbs.begins[row] === 0 && radius[row]! > 0) {
      const before = (radius[row]! - radius[below]!) / Math.max(arc[row]! - arc[below]!, 1e-3);
      const after = (radius[above]! - radius[row]!) / Math.max(arc[above]! - arc[row]!, 1e-3);
      if (before * after > 0) now = (2 * before * after) / (before + after) / radius[row]!;
    }
    if (Math.fround(now) === slope[row]) return;
    slope[row] = now;
    changed(row);
    if (above >= 0) changed(above);
  }
}

/** A slope as the shaders read it: a byte, `NO_SLOPE` for none. */
export function slopeCode(slope: number): number {
  return NO_SLOPE + Math.max(1 - NO_SLOPE, Math.min(NO_SLOPE - 1, Math.round(slope * SLOPE_STEPS)));
}

/** What is left of too much girth after a length of wood that began with it at such a radius. */
export function excess(much: number, length: number, radius: number): number {
  if (much <= 0 || length > 10 * radius) return 0;
  const knee = STEEPEST * EASES_OVER * radius;
  const straight = Math.min(length, Math.max(0, much - knee) / STEEPEST);
  const left = much - STEEPEST * straight;
  return left * Math.exp((straight - length) / (EASES_OVER * radius));
}
