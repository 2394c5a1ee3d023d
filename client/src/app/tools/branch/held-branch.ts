import { signal } from "@preact/signals";
import type { GhostPlacement } from "../../../scene/overlay/ghost";
import { axisStart } from "../../../scene/table/branch-rows";
import type { Vec3 } from "../../../scene/vector";
import type { Command } from "../../../wire/generated";
import {
  about,
  after,
  angleOf,
  between,
  cross,
  dot,
  length,
  minus,
  type Rotation,
  type ScreenAxes,
  turned,
  UNTURNED,
} from "./branch-turn";

/** Turns smaller than this, in radians, are the finger's trembling. */
const SMALLEST_TURN = 0.004;
/** Rows that show whether the table has a branch's new place. */
const MOST_WITNESSES = 40;
/** What one press of a key turns by, in radians. */
const STEP = (5 * Math.PI) / 180;
/** Keys that follow each other within so many milliseconds are one turn. */
const STEPS_WITHIN = 1500;
/** How long a preview waits for the server's rows before it gives up, in milliseconds. */
const PATIENCE = 4000;

/** What is asked of the rows. */
export interface BranchRows {
  readonly rows: number;
  readonly position: ArrayLike<number>;
  readonly parent: ArrayLike<number>;
  readonly startsAxis: ArrayLike<number>;
  readonly radiusCode: ArrayLike<number>;
}

/** A branch turned about its base. */
export interface TurnPreview {
  readonly row: number;
  readonly rotation: Rotation;
  /** The place that stays where it is. */
  readonly about: Vec3;
}

export interface BranchHandOptions {
  readonly rows: BranchRows;
  readonly submit: (command: Command) => void;
  /** Whether the server still has something to grow before it comes to what was asked for. */
  readonly busy: () => boolean;
  /** A number that no other operation of this client has. */
  readonly newGesture: () => number;
  /** The living rows of the branch that begins with a row, parents first; at most `most`. */
  readonly branchAbove: (row: number, most: number) => readonly number[];
  /** Draws a branch turned, until the rows say the same; null for as it is. */
  readonly showTurn: (turn: TurnPreview | null) => void;
  /** Draws a copy of the branch that begins with a row; null for none. */
  readonly showCopy: (row: number | null, placement: GhostPlacement | null) => void;
}

/** The branch that is held, to be turned about its base or to be carried to another limb. */
export class HeldBranch {
  /** The row the branch begins with. */
  readonly row = signal<number | null>(null);
  readonly turning = signal(false);
  /** What a tap on a limb does with the branch. */
  readonly placing = signal<"move" | "copy" | null>(null);
  #options: BranchHandOptions;
  #bearer = -1;
  #rotation: Rotation = UNTURNED;
  #gesture = 0;
  /** A turn or a graft that is sent and not yet in the rows. */
  #awaited: { readonly rows: number; readonly onto: number | null; readonly before: readonly Witness[] } | null = null;
  #stepped: {
    readonly row: number;
    readonly rotation: Rotation;
    readonly gesture: number;
    readonly at: number;
  } | null = null;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #copy: { readonly onto: number; readonly rotation: Rotation } | null = null;
  #copied: number | null = null;

  constructor(options: BranchHandOptions) {
    this.#options = options;
  }

  /**
   * Takes the branch a metamer is on: its whole axis; of an axis that is held already, or a trunk, what is above the
   * metamer. False if that is the whole plant, which stands where it stands.
   */
  take(picked: number): boolean {
    const { rows } = this.#options;
    const fromSeed = (row: number) => (rows.parent[rows.parent[row] ?? -1] ?? -1) < 0;
    const start = axisStart(rows, picked);
    const held = this.row.peek();
    const whole = held !== null && held !== picked && axisStart(rows, held) === start;
    const row = whole || fromSeed(start) ? picked : start;
    if (fromSeed(row)) {
      return false;
    }
    this.#hold(row);
    return true;
  }

  release(): void {
    this.cancelPlacing();
    this.#settle();
    this.row.value = null;
  }

  /** Rows have changed: previews end that have come true. False if the branch is no longer there. */
  keep(): boolean {
    const awaited = this.#awaited;
    const { rows } = this.#options;
    if (awaited?.onto != null && rows.rows > awaited.rows) {
      const grafted = this.#firstBorneBy(awaited.onto, awaited.rows);
      if (grafted !== null) {
        this.#settle();
        this.#hold(grafted);
        return true;
      }
    } else if (awaited?.onto === null && awaited.before.some((witness) => hasMoved(rows, witness))) {
      this.#settle();
    }
    const row = this.row.peek();
    if (row === null || awaited?.onto != null) {
      return true;
    }
    const same = row < rows.rows && rows.radiusCode[row] !== 0 && rows.parent[row] === this.#bearer;
    if (!same) {
      this.release();
    }
    return same;
  }

  /** The place the branch is borne at, and turns about; null while none is held. */
  base(): Vec3 | null {
    const row = this.row.peek();
    return row === null ? null : placeOf(this.#options.rows, this.#options.rows.parent[row] ?? row);
  }

  /** Whether a row is part of the branch. */
  holds(row: number): boolean {
    const first = this.row.peek();
    const { parent } = this.#options.rows;
    for (let at = row; first !== null && at >= first; at = parent[at] ?? -1) {
      if (at === first) {
        return true;
      }
    }
    return false;
  }

  /** The direction of the branch as it leaves its base, and turns about when twisted. */
  heading(): Vec3 {
    const [row, base] = [this.row.peek(), this.base()];
    return row === null || !base ? [0, 1, 0] : minus(placeOf(this.#options.rows, row), base);
  }

  /** The user begins to turn it. */
  beginTurn(): void {
    this.#settle();
    this.turning.value = true;
    this.#rotation = UNTURNED;
    this.#gesture = this.#options.newGesture();
  }

  /** It is turned so far, counted from where it was when the user began. */
  turn(rotation: Rotation): void {
    const [row, base] = [this.row.peek(), this.base()];
    if (row !== null && base && this.turning.peek()) {
      this.#rotation = rotation;
      this.#options.showTurn({ row, rotation, about: base });
    }
  }

  /** The user lets go: the branch stays as it is shown. */
  endTurn(): void {
    const row = this.row.peek();
    if (!this.turning.peek()) {
      return;
    }
    this.turning.value = false;
    if (row === null || angleOf(this.#rotation) < SMALLEST_TURN) {
      this.#options.showTurn(null);
      return;
    }
    this.#await(null);
    const [x, y, z, w] = this.#rotation;
    this.#options.submit({ kind: "turn_branch", row, rotation: [x, y, z, w], gesture: this.#gesture });
  }

  /** The branch goes back to where it was before the user began. */
  cancelTurn(): void {
    if (this.turning.peek()) {
      this.turning.value = false;
      this.#options.showTurn(null);
    }
  }

  /**
   * Turns it by a little at once, as a key does: sideways in the plane of the screen, up and down out of it, or about
   * itself. Steps that follow each other soon are one operation. False if there is nothing to turn.
   */
  step(right: number, up: number, twist: number, screen: ScreenAxes, now: number): boolean {
    const row = this.row.peek();
    if (row === null || this.turning.peek() || this.placing.peek() !== null) {
      return false;
    }
    const out = cross(screen.right, screen.up);
    const rolled = after(about(out, -right * STEP), about(screen.right, -up * STEP));
    const rotation = after(rolled, about(this.heading(), twist * STEP));
    const last = this.#stepped;
    const goesOn = last !== null && last.row === row && now - last.at < STEPS_WITHIN;
    // With the same gesture a turn counts from before the first of them (`BR1`).
    const whole = goesOn ? after(rotation, last.rotation) : rotation;
    const gesture = goesOn ? last.gesture : this.#options.newGesture();
    this.#stepped = { row, rotation: whole, gesture, at: now };
    const [x, y, z, w] = whole;
    this.#options.submit({ kind: "turn_branch", row, rotation: [x, y, z, w], gesture });
    return true;
  }

  /** The next limb that is tapped takes the branch, or a copy of it. */
  beginPlacing(mode: "move" | "copy"): void {
    this.cancelTurn();
    this.placing.value = mode;
  }

  cancelPlacing(): void {
    this.placing.value = null;
    this.hide();
  }

  /** Shows no copy on its way, except one that is sent and not yet there. */
  hide(): void {
    this.#copy = null;
    if (this.#awaited?.onto == null) {
      this.#show(null, null);
    }
  }

  /** Whether a metamer may bear the branch, or a copy of it: it cannot be one of its own (`BR2`). */
  mayBear(row: number): boolean {
    return !this.holds(row);
  }

  /** Shows the branch on a limb, pointing towards a place or as it stood on its own limb. */
  showOn(onto: number, towards: Vec3 | null): void {
    const [row, from] = [this.row.peek(), this.base()];
    if (row === null || !from) {
      return;
    }
    const to = placeOf(this.#options.rows, onto);
    const rotation = this.#aimed(row, from, onto, towards && minus(towards, to));
    this.#copy = { onto, rotation };
    this.#show(row, { turn: rotation, from, to });
  }

  /** Shows the branch at a place where nothing bears it. */
  showAt(place: Vec3): void {
    const [row, from] = [this.row.peek(), this.base()];
    this.#copy = null;
    if (row !== null && from) {
      this.#show(row, { turn: UNTURNED, from, to: place });
    }
  }

  /** Grafts the branch where it is shown; false if nothing bears it there. */
  graft(): boolean {
    const [row, copy, mode] = [this.row.peek(), this.#copy, this.placing.peek()];
    if (row === null || !copy || mode === null) {
      return false;
    }
    const [x, y, z, w] = copy.rotation;
    this.placing.value = null;
    this.#copy = null;
    this.#await(copy.onto);
    this.#options.submit({
      kind: "graft",
      row,
      onto: copy.onto,
      rotation: [x, y, z, w],
      keep: mode === "copy",
    });
    return true;
  }

  /** The server has refused what was previewed. */
  refused(): void {
    this.#settle();
  }

  #hold(row: number): void {
    this.#settle();
    this.#bearer = this.#options.rows.parent[row] ?? -1;
    this.row.value = row;
  }

  /** As it stood to the wood that bears it, and then, if that is wanted, turned towards something. */
  #aimed(row: number, from: Vec3, onto: number, towards: Vec3 | null): Rotation {
    const { rows } = this.#options;
    const bearing = (at: number): Vec3 => {
      const below = rows.parent[at] ?? -1;
      return below < 0 ? [0, 1, 0] : minus(placeOf(rows, at), placeOf(rows, below));
    };
    const rotation = between(bearing(rows.parent[row] ?? row), bearing(onto));
    if (!towards || length(towards) === 0) {
      return rotation;
    }
    const branch = this.#options.branchAbove(row, MOST_WITNESSES);
    const far = branch.map((at) => minus(placeOf(rows, at), from));
    const furthest = far.reduce((best, one) => (dot(one, one) > dot(best, best) ? one : best), far[0] ?? [0, 1, 0]);
    return after(between(turned(rotation, furthest), towards), rotation);
  }

  #show(row: number | null, placement: GhostPlacement | null): void {
    if (row !== null || this.#copied !== null) {
      this.#copied = row;
      this.#options.showCopy(row, placement);
    }
  }

  #await(onto: number | null): void {
    const { rows, branchAbove } = this.#options;
    const row = this.row.peek() ?? 0;
    const before =
      onto === null ? branchAbove(row, MOST_WITNESSES).map((at) => ({ row: at, place: placeOf(rows, at) })) : [];
    this.#awaited = { rows: rows.rows, onto, before };
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#lookAgain(), PATIENCE);
  }

  /** What waits behind long growth is still to come; what has not come by now otherwise never will. */
  #lookAgain(): void {
    if (this.#options.busy()) {
      this.#timer = setTimeout(() => this.#lookAgain(), PATIENCE);
    } else {
      this.#settle();
    }
  }

  /** Nothing is awaited any more, and nothing shown that is not in the rows. */
  #settle(): void {
    clearTimeout(this.#timer);
    this.#awaited = null;
    this.#options.showTurn(null);
    this.#show(null, null);
  }

  #firstBorneBy(onto: number, from: number): number | null {
    const { rows, parent } = this.#options.rows;
    for (let row = from; row < rows; row += 1) {
      if (parent[row] === onto) {
        return row;
      }
    }
    return null;
  }
}

interface Witness {
  readonly row: number;
  readonly place: Vec3;
}

function hasMoved(rows: BranchRows, { row, place }: Witness): boolean {
  return row >= rows.rows || rows.radiusCode[row] === 0 || placeOf(rows, row).some((x, axis) => x !== place[axis]);
}

function placeOf({ position }: BranchRows, row: number): Vec3 {
  return [position[3 * row] ?? 0, position[3 * row + 1] ?? 0, position[3 * row + 2] ?? 0];
}
