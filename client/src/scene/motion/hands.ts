import type { TreeTable } from "../table/tree-table";
import type { Vec3 } from "../vector";
import { Calm } from "./calm";
import type { Hand } from "./hand";
import { NONE } from "./limbs";
import { type Moving, ROW_NUMBERS } from "./moving";
import { JOINT } from "./rides";
import type { Riding } from "./riding";
import type { Pluck, Sway } from "./sway";

/** The furthest that a joint springs up when weight is cut off it, radians. */
const FURTHEST_RECOIL = 0.25;
/** Seconds between two looks that tell how fast a joint would move. */
const MOMENT = 1e-3;

type Table = Pick<TreeTable, "rows" | "parent"> & { readonly limbs: Pick<TreeTable["limbs"], "onward"> };
type Riders = Pick<Riding, "rows" | "count">;

/** The swaying tree that hands work at. */
export interface Swaying {
  readonly table: Table;
  readonly riding: Riders;
  readonly moving: Pick<Moving, "first" | "hinges">;
  readonly sway: Sway;
}

/** What hands do to a swaying tree: it comes to rest where they are, and swings on when they let go. */
export class Hands {
  private calm = new Calm();
  private hand: Hand | null = null;
  private moved = false;
  /** Rows that were let go, and joints that have lost weight with the turn that it held them down by. */
  private released: number[] = [];
  private lightened: { readonly joint: number; readonly turn: Vec3 }[] = [];
  /** Where branches were cut off, until joints are made without them. */
  private cuts: number[] = [];
  private changes = false;

  /** A hand is at the tree from now on, or none is. */
  touch(hand: Hand | null): void {
    this.hand = hand;
    this.moved = true;
  }

  /** Branches at these rows were held elsewhere: they start from rest once no hand is there any more. */
  release(rows: readonly number[]): void {
    this.released.push(...rows);
  }

  /** Branches were cut off at these rows: what bore them springs up. */
  cut(rows: readonly number[]): void {
    this.cuts.push(...rows);
  }

  /** Whether the whole tree stands still under a hand. */
  get holdsAll(): boolean {
    return this.hand?.elsewhere === 0 && !this.moved && !this.changes;
  }

  /** Whether joints are wanted soon, without what was cut off. */
  get waits(): boolean {
    return this.cuts.length > 0;
  }

  /** Other joints have taken the place of those of before, made from rows with these codes of radii. */
  adopt(
    after: Pick<Moving, "first" | "hinges" | "loads">,
    before: Pick<Moving, "first" | "loads"> | null,
    { table, riding }: Pick<Swaying, "table" | "riding">,
    codes: ArrayLike<number>,
  ): void {
    this.calm = this.calm.carried(after.first, after.hinges.parent);
    this.moved = true;
    this.lightened = [];
    const gone = this.cuts.filter((row) => codes[row] === 0);
    this.cuts = this.cuts.filter((row) => row < table.rows && codes[row] !== 0);
    if (!before || gone.length === 0) return;
    const known = new Map(Array.from(before.first, (row, joint) => [row, joint] as const));
    for (const joint of bearersOf(
      gone.map((row) => table.parent[row]!),
      riding,
      after.hinges.parent,
    )) {
      const same = known.get(after.first[joint]!);
      if (same === undefined) continue;
      const turn = [0, 1, 2].map((a) => before.loads.sag[3 * same + a]! - after.loads.sag[3 * joint + a]!);
      this.lightened.push({ joint, turn: turn as unknown as Vec3 });
    }
  }

  /** There is another tree, or none. */
  forget(): void {
    [this.released, this.lightened, this.cuts] = [[], [], []];
    this.moved = true;
  }

  /**
   * Takes what hands have done since into account, and has all joints show as much of their sway as they are to at `now` in
   * milliseconds, `time` in seconds being the wind's; `exposure` is how much of the wind each gets. Says whether that still changes.
   */
  apply(now: number, time: number, swaying: Swaying, bends: Float64Array, exposure: Float64Array): boolean {
    const { sway } = swaying;
    this.aim(now, swaying);
    if (this.hand === null && this.released.length > 0) this.letGo(now, time, swaying, bends);
    for (const { joint, turn } of this.lightened.splice(0)) sway.pluck(recoil(joint, turn, time, sway));
    const { calms, changes } = this.calm.look(now);
    this.changes = changes;
    if (!calms) return changes;
    for (let joint = 0; joint < exposure.length; joint += 1) {
      const share = this.calm.at(joint, now);
      exposure[joint]! *= share;
      for (let a = 3 * joint; a < 3 * joint + 3; a += 1) bends[a]! *= share;
    }
    return changes;
  }

  private aim(now: number, { table, riding, moving }: Swaying): void {
    if (!this.moved) return;
    this.moved = false;
    const { hand } = this;
    const under = hand && jointsUnder(hand.rows, table, riding, moving);
    this.calm.aim((joint) => (under === null ? 1 : under[joint] === 1 ? 0 : hand!.elsewhere), now);
  }

  /** Limbs that were let go start where they are, without speed, and swing freely from there on, with what bears them. */
  private letGo(now: number, time: number, { sway, riding, moving }: Swaying, bends: Float64Array): void {
    const joints = bearersOf(this.released.splice(0), riding, moving.hinges.parent);
    const later = new Float64Array(bends.length);
    sway.bends(time + MOMENT, later);
    for (const joint of joints) {
      const kept = this.calm.at(joint, now) - 1;
      const at = (a: number) => 3 * joint + a;
      const bend = (a: number) => kept * bends[at(a)]!;
      const speed = (a: number) => (kept * (later[at(a)]! - bends[at(a)]!)) / MOMENT;
      sway.pluck({
        joint,
        at: time,
        bend: [bend(0), bend(1), bend(2)],
        speed: [speed(0), speed(1), speed(2)],
      });
      this.calm.free(joint);
    }
    // What they show from here on has the plucks in it.
    sway.bends(time, bends);
  }
}

/** The joints that some rows ride on, and those that bear these; each once. */
function bearersOf(rows: readonly number[], { rows: riders, count }: Riders, parent: Int32Array): number[] {
  const joints = new Set<number>();
  for (const row of rows) {
    if (row < 0 || row >= count) continue;
    for (let joint = riders[ROW_NUMBERS * row + JOINT]!; joint !== NONE && !joints.has(joint); joint = parent[joint]!) {
      joints.add(joint);
    }
  }
  return [...joints];
}

/** Marks by 1 the joints that move the limbs at some rows: those that they ride on, what bears these, and all that the limbs bear. */
export function jointsUnder(
  rows: readonly number[],
  { rows: count, parent, limbs }: Table,
  riding: Riders,
  { first, hinges }: Pick<Moving, "first" | "hinges">,
): Uint8Array {
  const under = new Uint8Array(first.length);
  for (const joint of bearersOf(rows, riding, hinges.parent)) under[joint] = 1;
  const borne = new Uint8Array(count);
  for (const row of rows) {
    let base = row;
    if (base < 0 || base >= count) continue;
    // What grows from a seed is a limb of its own even where it goes on from the seed.
    for (let below = parent[base]!; below >= 0 && parent[below]! >= 0; below = parent[base]!) {
      if (limbs.onward[below] !== base) break;
      base = below;
    }
    borne[base] = 1;
  }
  for (let row = 0; row < count; row += 1) if (parent[row]! >= 0 && borne[parent[row]!] === 1) borne[row] = 1;
  for (const [joint, row] of first.entries()) if (row < count && borne[row] === 1) under[joint] = 1;
  return under;
}

/** A joint that has lost weight springs up from where it is about as far as the weight had held it down. */
function recoil(joint: number, turn: Vec3, time: number, sway: Sway): Pluck {
  const size = Math.hypot(...turn);
  const by = size > 0 ? -sway.rateOf(joint) * Math.min(1, FURTHEST_RECOIL / size) : 0;
  return { joint, at: time, bend: [0, 0, 0], speed: [by * turn[0], by * turn[1], by * turn[2]] };
}

/** The same plucks for other joints, which are known by their lowest rows. */
export function pluckedAnew(plucks: readonly Pluck[], before: Int32Array, after: Int32Array): Pluck[] {
  const known = new Map(Array.from(after, (row, joint) => [row, joint] as const));
  return plucks.flatMap((pluck) => {
    const joint = known.get(before[pluck.joint]!);
    return joint === undefined ? [] : [{ ...pluck, joint }];
  });
}
