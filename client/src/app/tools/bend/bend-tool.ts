import { signal } from "@preact/signals";
import type { Bend } from "../../../scene/bend/bend";
import { BendOverlay } from "../../../scene/overlay/bend-overlay";
import type { TreeTable } from "../../../scene/table/tree-table";
import { radiusOf } from "../../../scene/table/tree-table";
import type { Vec3 } from "../../../scene/vector";
import { type Command, MAX_BEND_TOUCHES } from "../../../wire/generated";
import type { Grip } from "../../input/gesture-recogniser";
import type { Key } from "../../words/say";
import type { ShapingView } from "../shaping-view";
import { type GripTool, PICK_TOLERANCE, withinReach } from "../tool";
import { type Hold, holdAt, naturalBase, related } from "./bend-hold";
import { SettlingBends } from "./settling-bends";

/** Rounds that are played again for a finger that rests, so that the branch comes up to it. */
const ROUNDS_AT_REST = 8;
/** Moves that may be in progress; beyond it the newest waits for its turn. */
const MAX_UNSETTLED = 6;

/** Bends a path as the server will, before it answers. */
export type BendSolver = Pick<Bend, "drag" | "relax" | "motions">;

export interface BendOptions {
  readonly table: TreeTable;
  readonly view: ShapingView;
  readonly submit: (command: Command) => void;
  /** A number no other bend of this client has. */
  readonly newBend: () => number;
  /** A number that all commands of one gesture share. */
  readonly newGesture: () => number;
  /** How many commands of a kind the server has not yet answered. */
  readonly unsettled: (kind: Command["kind"]) => number;
  /** 0, stiff in length, to 1, stretchy. */
  readonly stretch: () => number;
  /** `nodes` are where the base begins and the end of each internode of the path. */
  readonly solver: (nodes: Vec3[], radii: number[], stretch: number) => BendSolver;
  readonly say: (text: Key) => void;
}

interface Finger {
  readonly row: number | null;
  /** Where it took hold, in the world as it is seen. */
  readonly point: Vec3;
  readonly from: { readonly x: number; readonly y: number };
  readonly slop: number;
  x: number;
  y: number;
  moved: boolean;
  /** It drags what an earlier bend has moved: from where it is now, not from where it came down. */
  regrips: boolean;
}

interface Touch {
  readonly row: number;
  /** Where the metamer's end was when it was taken, and where the finger was then. */
  readonly rest: Vec3;
  readonly anchor: Vec3;
  /** The finger that drags it; a handle that was set stays put. */
  readonly finger: number | null;
  target: Vec3;
}

interface Bending {
  readonly number: number;
  readonly hold: Hold;
  readonly touches: readonly Touch[];
  readonly overlay: BendOverlay;
  readonly solver: BendSolver;
  /** Fingers that have lifted: what they held stays where they left it. */
  readonly lifted: Set<number>;
  unsent: boolean;
  rounds: number;
}

/**
 * Bends branches: the first finger holds the base, the second the end, further ones places between. With one pointer
 * the base is marked by a tap and the branch dragged by any place above it; further taps set places that stay put.
 */
export class BendTool implements GripTool {
  /** The marked base. */
  readonly base = signal<number | null>(null);
  /** Places that stay put. */
  readonly handles = signal<readonly number[]>([]);
  /** Rows that fingers hold now, the base first. */
  readonly held = signal<readonly number[]>([]);

  #options: BendOptions;
  #fingers = new Map<number, Finger>();
  #bending: Bending | null = null;
  #settling: SettlingBends;
  /** Bends made without letting go are one operation. */
  #gesture: number | null = null;
  /** The most fingers since the last was lifted: only a lone one taps. */
  #most = 0;

  constructor(options: BendOptions) {
    this.#options = options;
    this.#settling = new SettlingBends(options);
  }

  takes(x: number, y: number): Grip {
    if (this.#fingers.size === 0) {
      return "take";
    }
    const row = this.#pick(x, y)?.row ?? null;
    if (this.#bending) {
      const { path } = this.#bending.hold;
      const [base = 0, end = 0] = [path[0], path[path.length - 1]];
      const { table } = this.#options;
      const joins = row !== null && row > base && holdAt(table, base, [row]) && related(table, end, row);
      return joins && this.#fingers.size <= MAX_BEND_TOUCHES ? "take" : "ignore";
    }
    const others = [...this.#fingers.values()].map((finger) => finger.row);
    const joins = row !== null && others.every((other) => other !== null && related(this.#options.table, other, row));
    return joins && others.length <= MAX_BEND_TOUCHES ? "take" : "leave";
  }

  gripBegin(id: number, x: number, y: number, slop: number): void {
    const picked = this.#pick(x, y);
    // What is seen under the finger is what it holds: how far the wind has carried it there is no part of the bend.
    const point = picked?.seen ?? picked?.point ?? [0, 0, 0];
    if (this.#bending) {
      // One more finger makes another bend of it, as soon as this one is in the table.
      this.#finish();
      for (const finger of this.#fingers.values()) {
        finger.regrips = true;
      }
    }
    const [row, from] = [picked?.row ?? null, { x, y }];
    this.#fingers.set(id, { row, point, from, slop, x, y, moved: false, regrips: false });
    this.#most = Math.max(this.#most, this.#fingers.size);
    this.#show();
  }

  gripMove(id: number, x: number, y: number): void {
    const finger = this.#fingers.get(id);
    if (!finger) {
      return;
    }
    finger.x = x;
    finger.y = y;
    finger.moved ||= Math.hypot(x - finger.from.x, y - finger.from.y) > finger.slop;
    if (!this.#bending && finger.moved) {
      this.#begin();
    }
    this.#follow();
  }

  gripEnd(id: number): void {
    const finger = this.#fingers.get(id);
    this.#fingers.delete(id);
    const bending = this.#bending;
    if (bending) {
      bending.lifted.add(id);
      if (bending.touches.every((touch) => touch.finger === null || bending.lifted.has(touch.finger))) {
        this.#finish();
      }
    } else if (finger && !finger.moved && this.#most === 1) {
      this.#tap(finger.row);
    }
    if (this.#fingers.size === 0) {
      this.#most = 0;
      this.#gesture = null;
    }
    this.#show();
  }

  gripDrop(): void {
    if (this.#bending) {
      // The bend is kept: a bend without an end would block this branch for others.
      this.#finish();
    }
    this.#fingers.clear();
    this.#most = 0;
    this.#gesture = null;
    this.#show();
  }

  /** Sends where the fingers are; while they rest the branch still comes up to them. */
  tick(): void {
    const bending = this.#bending;
    if (!bending && [...this.#fingers.values()].some((finger) => finger.moved)) {
      this.#begin();
    }
    if (!bending || this.#options.unsettled("bend_move") >= MAX_UNSETTLED) {
      return;
    }
    if (bending.unsent) {
      this.#send(bending);
    } else if (bending.rounds < ROUNDS_AT_REST) {
      bending.rounds += 1;
      this.#drag(bending);
      this.#send(bending);
    }
  }

  end(): void {
    if (this.#bending) {
      this.#finish();
    }
    this.gripDrop();
  }

  /** The branch goes back to where it was. */
  cancel(): void {
    const bending = this.#bending;
    if (bending) {
      this.#options.submit({ kind: "bend_cancel", bend: bending.number });
    }
    this.abandon();
  }

  abandon(): void {
    const bending = this.#bending;
    this.#bending = null;
    if (bending) {
      this.#options.view.removeOverlay(bending.overlay);
    }
    this.gripDrop();
  }

  /** Lets go of the marked base and what stays put. */
  release(): boolean {
    const any = this.base.peek() !== null;
    this.base.value = null;
    this.handles.value = [];
    return any;
  }

  /** The server would not have a bend. */
  refused(command: Command): void {
    if (!("bend" in command)) {
      return;
    }
    const number = command.bend;
    if (this.#bending?.number === number) {
      this.abandon();
    }
    this.#settling.refused(number);
  }

  /** Whether a bend along this path is this tool's own, and so shown already. */
  owns(path: readonly number[]): boolean {
    return this.#bending?.overlay.follows(path) === true || this.#settling.owns(path);
  }

  /** The server says that a bend is over. */
  over(path: readonly number[]): void {
    this.#settling.over(path);
    if (this.#bending?.overlay.follows(path)) {
      this.abandon();
    }
  }

  changed(): void {
    const { table, unsettled } = this.#options;
    this.#settling.changed(unsettled("bend_end") === 0);
    if (this.#bending?.overlay.over(table)) {
      this.#options.say("tools.bend-ended");
      this.abandon();
    }
    const gone = (row: number) => row >= table.rows || table.radiusCode[row] === 0;
    const base = this.base.peek();
    if (base !== null && gone(base)) {
      this.release();
    } else if (this.handles.peek().some(gone)) {
      this.handles.value = this.handles.peek().filter((row) => !gone(row));
    }
  }

  /** One finger marks a base, then places above it that stay put; the same place again lets go of it. */
  #tap(row: number | null): void {
    const { table } = this.#options;
    const base = this.base.peek();
    if (row === null || (base !== null && near(table, base, row))) {
      this.release();
      return;
    }
    if (base === null || !holdAt(table, base, [row])) {
      this.base.value = row;
      this.handles.value = [];
      return;
    }
    const handles = this.handles.peek();
    const kept = handles.filter((other) => !near(table, other, row));
    this.handles.value = kept.length < handles.length ? kept : [...handles, row].slice(1 - MAX_BEND_TOUCHES);
  }

  #begin(): void {
    const { table, view, submit, newBend, newGesture, stretch, solver, say } = this.#options;
    if (this.#settling.pending) {
      return;
    }
    const grips = this.#grips();
    if (!grips) {
      return;
    }
    const handles = this.handles.peek();
    const hold = holdAt(table, grips.base, [...grips.fingers.map(([, finger]) => finger.row), ...handles]);
    const dragged = hold && grips.fingers.filter(([, finger]) => hold.touches.includes(finger.row));
    if (!hold || !dragged || dragged.length === 0) {
      say("tools.bend-base");
      this.gripDrop();
      return;
    }
    const fingerOf = new Map(dragged.map(([id, { row }]) => [row, id]));
    const touches = hold.touches.slice(0, MAX_BEND_TOUCHES).map((row): Touch => {
      const rest = nodeOf(table, row);
      const id = fingerOf.get(row);
      const finger = id === undefined ? undefined : this.#fingers.get(id);
      const now = finger?.regrips ? view.pointOnPlane(finger.x, finger.y, finger.point) : null;
      return { row, rest, anchor: now ?? finger?.point ?? rest, finger: id ?? null, target: rest };
    });
    const { path } = hold;
    const overlay = new BendOverlay(table, path);
    const nodes = [table.parent[path[0] ?? 0] ?? 0, ...path].map((row) => nodeOf(table, row));
    const radii = path.map((row) => radiusOf(table.radiusCode[row] ?? 0));
    const number = newBend();
    this.#bending = {
      number,
      hold,
      touches,
      overlay,
      solver: solver(nodes, radii, stretch()),
      lifted: new Set(),
      unsent: false,
      rounds: ROUNDS_AT_REST,
    };
    this.base.value = grips.base;
    view.addOverlay(overlay);
    const rows = touches.map(({ row }) => row);
    this.#gesture ??= newGesture();
    const gesture = this.#gesture;
    submit({ kind: "bend_begin", bend: number, base: grips.base, touches: rows, stretch: stretch(), gesture });
    this.#show();
  }

  /** Which finger holds the base, and which drag: the lowest of several, unless all are above the marked one. */
  #grips(): { base: number; fingers: [id: number, finger: { row: number }][] } | null {
    const { table } = this.#options;
    const on: [number, { row: number }][] = [];
    for (const [id, { row }] of this.#fingers) {
      if (row !== null) {
        on.push([id, { row }]);
      }
    }
    const lowest = Math.min(...on.map(([, { row }]) => row));
    if (on.length === 0) {
      return null;
    }
    const marked = this.base.peek();
    if (marked !== null && holdAt(table, marked, [lowest])) {
      return { base: marked, fingers: on };
    }
    if (on.length > 1) {
      return { base: lowest, fingers: on.filter(([, { row }]) => row !== lowest) };
    }
    return { base: naturalBase(table, lowest), fingers: on };
  }

  /** Brings the targets to where the fingers are. */
  #follow(): void {
    const bending = this.#bending;
    if (!bending) {
      return;
    }
    for (const touch of bending.touches) {
      const finger = touch.finger === null ? undefined : this.#fingers.get(touch.finger);
      const place = finger && this.#options.view.pointOnPlane(finger.x, finger.y, finger.point);
      if (finger && place) {
        const way = (axis: 0 | 1 | 2) => touch.rest[axis] + place[axis] - touch.anchor[axis];
        touch.target = withinReach([way(0), way(1), way(2)]);
      }
    }
    bending.rounds = 0;
    bending.unsent = true;
    this.#drag(bending);
  }

  #drag({ solver, hold, touches, overlay }: Bending): void {
    solver.drag(touches.map(({ row, target }) => [hold.path.indexOf(row), target] as const));
    this.#pose(overlay, solver);
  }

  #pose(overlay: BendOverlay, solver: BendSolver): void {
    const motions = solver.motions();
    overlay.move(overlay.path.flatMap((row, i) => (motions[i] ? [{ row, ...motions[i] }] : [])));
    this.#options.view.overlayChanged();
  }

  #send(bending: Bending): void {
    bending.unsent = false;
    const targets = bending.touches.map(({ target: [x, y, z] }): [number, number, number] => [x, y, z]);
    this.#options.submit({ kind: "bend_move", bend: bending.number, targets });
  }

  #finish(): void {
    const bending = this.#bending;
    if (!bending) {
      return;
    }
    if (bending.unsent) {
      this.#send(bending);
    }
    this.#bending = null;
    this.#options.submit({ kind: "bend_end", bend: bending.number });
    bending.solver.relax();
    this.#pose(bending.overlay, bending.solver);
    this.#settling.add(bending.overlay, bending.number);
    this.#options.view.air?.release(bending.hold.path);
  }

  #pick(x: number, y: number) {
    return this.#options.view.pick(x, y, PICK_TOLERANCE);
  }

  #show(): void {
    const rows = this.#bending
      ? [...this.#bending.hold.path.slice(0, 1), ...this.#bending.touches.map(({ row }) => row)]
      : [...this.#fingers.values()].flatMap(({ row }) => (row === null ? [] : [row]));
    this.held.value = rows;
  }
}

/** Whether two rows are the same place to a finger. */
function near(table: TreeTable, a: number, b: number): boolean {
  return a === b || table.parent[a] === b || table.parent[b] === a;
}

/** Where a row's metamer ends: what bends is its nodes, which thick wood is drawn beside. */
function nodeOf({ position }: TreeTable, row: number): Vec3 {
  return [position[3 * row] ?? 0, position[3 * row + 1] ?? 0, position[3 * row + 2] ?? 0];
}
