import { type ReadonlySignal, type Signal, signal } from "@preact/signals";
import { type Girth, WidthOverlay } from "../../../scene/overlay/width-overlay";
import { axisRows, pathUp } from "../../../scene/table/branch-rows";
import { radiusOf, type TreeTable } from "../../../scene/table/tree-table";
import { type Command, MAX_DIAMETER, MIN_DIAMETER, type WidthConstraint } from "../../../wire/generated";
import type { Grip } from "../../input/gesture-recogniser";
import type { ShapingView } from "../shaping-view";
import { type GripTool, PICK_TOLERANCE } from "../tool";
import type { WidthList } from "./width-list";

/** Two fingers this far apart, in pixels, are around a limb; further apart they zoom. */
const WIDEST_PINCH = 320;
/** How near to the middle between two fingers a limb has to be. */
const PINCH_TOLERANCE = 16;
/** Changes that may be in progress; beyond it the newest waits for its turn. */
const MAX_UNSETTLED = 4;
/** Widths that differ by less than this share are the same to the eye, and to the radius codes. */
const SAME = 0.015;
/** How long after its answer a width may take to show in the rows, in milliseconds. */
const LINGERS = 1200;

export interface WidthOptions {
  readonly table: TreeTable;
  readonly view: ShapingView;
  readonly submit: (command: Command) => void;
  /** A number no other gesture of this client has. */
  readonly newGesture: () => number;
  readonly widths: WidthList;
  /** How many `set_width` the server has not yet answered. */
  readonly unsettled: () => number;
  readonly girth: () => Girth;
  /** How many pixels an internode is long where a row is. */
  readonly scaleAt: (row: number) => number;
  /** Where a row is on the screen. */
  readonly placeOnGlass: (row: number) => readonly [number, number] | null;
}

interface Setting {
  readonly row: number;
  readonly gesture: number;
  /** How thick the limb was when it was taken, and how far the fingers were then apart or from its middle, in pixels. */
  readonly from: { readonly diameter: number; readonly spread: number };
  /** The least diameter that may be set: no less than that of any limb above it whose width is set. */
  readonly least: number;
  /** The width that was set there before. */
  readonly before: number | null;
  unsent: boolean;
  /** Whether the server has heard of it. */
  sent: boolean;
}

interface Finger {
  readonly from: { readonly x: number; readonly y: number };
  readonly row: number | null;
  readonly slop: number;
  x: number;
  y: number;
  moved: boolean;
}

/** Sets how thick a limb is: two fingers pinch around it, or one pulls the ring around the place it has tapped. */
export class WidthTool implements GripTool {
  /** All widths that are set, as the server has them. */
  readonly widths: Signal<readonly WidthConstraint[]>;
  /** The rows whose width is set. */
  readonly limits: ReadonlySignal<ReadonlySet<number>>;
  /** The place that has the ring. */
  readonly chosen = signal<number | null>(null);
  /** How thick the user wants it, until the server's rows have it. */
  readonly wanted = signal<number | null>(null);

  #options: WidthOptions;
  #fingers = new Map<number, Finger>();
  #setting: Setting | null = null;
  #overlay: WidthOverlay | null = null;
  #most = 0;
  #lingering: ReturnType<typeof setTimeout> | undefined;

  constructor(options: WidthOptions) {
    this.#options = options;
    this.widths = options.widths.all;
    this.limits = options.widths.rows;
  }

  /** The diameter a row has in the table, in internodes. */
  diameterOf(row: number): number {
    return 2 * radiusOf(this.#options.table.radiusCode[row] ?? 0);
  }

  takes(x: number, y: number): Grip {
    const [first, ...more] = this.#fingers.values();
    if (!first) {
      return "take";
    }
    if (this.#setting || more.length > 0) {
      return "ignore";
    }
    const near = Math.hypot(x - first.x, y - first.y) <= WIDEST_PINCH;
    return near && this.#between(first, { x, y }) !== null ? "take" : "leave";
  }

  gripBegin(id: number, x: number, y: number, slop: number): void {
    const row = this.#fingers.size === 0 ? this.#pick(x, y, PICK_TOLERANCE) : null;
    this.#fingers.set(id, { from: { x, y }, row, slop, x, y, moved: false });
    this.#most = Math.max(this.#most, this.#fingers.size);
    const [a, b] = this.#fingers.values();
    if (a && b && !this.#setting) {
      const limb = this.#between(a, b);
      if (limb !== null) {
        this.take(limb, spread(a, b));
      }
    }
  }

  gripMove(id: number, x: number, y: number): void {
    const finger = this.#fingers.get(id);
    if (!finger) {
      return;
    }
    finger.x = x;
    finger.y = y;
    finger.moved ||= Math.hypot(x - finger.from.x, y - finger.from.y) > finger.slop;
    const [a, b] = this.#fingers.values();
    const setting = this.#setting;
    if (setting && a && b) {
      // A pinch scales: what the fingers are around keeps its share of what is between them.
      this.#want((setting.from.diameter * spread(a, b)) / Math.max(1, setting.from.spread));
    } else if (finger.moved && finger.row !== null && this.#most === 1) {
      if (!setting) {
        this.take(finger.row, this.#away(finger.row, finger.from.x, finger.from.y));
      }
      this.pull(x, y);
    }
  }

  gripEnd(id: number): void {
    const finger = this.#fingers.get(id);
    this.#fingers.delete(id);
    if (this.#setting) {
      this.letGo();
    } else if (finger && !finger.moved && this.#most === 1) {
      this.choose(finger.row);
    }
    if (this.#fingers.size === 0) {
      this.#most = 0;
    }
  }

  gripDrop(): void {
    this.#fingers.clear();
    this.#most = 0;
    this.letGo();
  }

  /** Puts the ring around a limb, or takes it away. */
  choose(row: number | null): void {
    this.letGo();
    if (row !== this.chosen.peek()) {
      this.#forget();
      this.chosen.value = row;
    }
  }

  /** Takes hold of the ring; `spread` is how far from the limb's middle that is, in pixels. */
  take(row: number, spread: number): void {
    this.choose(row);
    this.#setting = {
      row,
      gesture: this.#options.newGesture(),
      from: { diameter: this.#present(row), spread },
      least: this.#leastAt(row),
      before: this.#heldAt(row),
      unsent: false,
      sent: false,
    };
  }

  /** Pulls the ring away from the limb's middle, or pushes it in. */
  pull(x: number, y: number): void {
    const setting = this.#setting;
    if (setting) {
      const pixels = this.#away(setting.row, x, y) - setting.from.spread;
      this.#want(setting.from.diameter + (2 * pixels) / Math.max(1e-3, this.#options.scaleAt(setting.row)));
    }
  }

  /** The ring stays as wide as it is. */
  letGo(): void {
    const setting = this.#setting;
    this.#setting = null;
    if (setting?.unsent) {
      this.#send(setting);
    }
    this.changed();
  }

  /** A width that was typed. */
  type(diameter: number): void {
    const row = this.chosen.peek();
    if (row !== null && Number.isFinite(diameter)) {
      this.take(row, 0);
      this.#want(diameter);
      this.letGo();
    }
  }

  /** Takes the chosen width away: the limb is as thick as what it bears makes it. */
  remove(): void {
    const row = this.chosen.peek();
    if (row !== null) {
      this.choose(null);
      if (this.limits.peek().has(row)) {
        this.#options.submit({ kind: "set_width", row, diameter: null });
      }
    }
  }

  /** Moves the chosen width along the limb. */
  shift(to: number): void {
    const row = this.chosen.peek();
    if (row === null || row === to) {
      return;
    }
    const { submit, newGesture } = this.#options;
    const diameter = this.#heldAt(row);
    this.choose(to);
    if (diameter !== null) {
      // One gesture, so that one undo puts it back.
      const gesture = newGesture();
      submit({ kind: "set_width", row, diameter: null, gesture });
      submit({ kind: "set_width", row: to, diameter, gesture });
      // Until the server sends all widths, this one is already at its new place.
      this.widths.value = this.widths
        .peek()
        .filter((width) => width.row !== to)
        .map((width) => (width.row === row ? { ...width, row: to } : width));
    }
  }

  /** Where the chosen place is on its limb: a number of metamers from the base, itself included, of so many. */
  place(): { readonly along: number; readonly of: number } | null {
    const row = this.chosen.peek();
    const limb = row === null ? [] : axisRows(this.#options.table, row);
    return row === null ? null : { along: limb.indexOf(row) + 1, of: limb.length };
  }

  /** Moves the chosen width by so many metamers along its limb, as keys do; one move at a time. */
  step(metamers: number): void {
    const row = this.chosen.peek();
    if (row === null || this.#options.unsettled() > 0) {
      return;
    }
    const limb = axisRows(this.#options.table, row);
    const to = limb[Math.min(limb.length - 1, Math.max(0, limb.indexOf(row) + metamers))];
    if (to !== undefined) {
      this.shift(to);
    }
  }

  tick(): void {
    if (this.#setting?.unsent && this.#options.unsettled() < MAX_UNSETTLED) {
      this.#send(this.#setting);
    }
  }

  end(): void {
    this.gripDrop();
  }

  abandon(): void {
    this.#setting = null;
    this.#fingers.clear();
    this.#most = 0;
    this.#forget();
  }

  /** The limb is as thick as before it was taken hold of. */
  cancel(): void {
    const setting = this.#setting;
    if (setting?.sent) {
      const { row, gesture, before } = setting;
      this.#options.submit({ kind: "set_width", row, diameter: before, gesture });
    }
    this.abandon();
  }

  release(): boolean {
    if (this.#setting) {
      // A ring is held: the first thing to undo is how far it was pulled.
      this.cancel();
      return true;
    }
    const any = this.chosen.peek() !== null;
    this.choose(null);
    return any;
  }

  /** The server would not have a width: the limb is as it was. */
  refused({ kind }: Command): void {
    if (kind === "set_width") {
      this.abandon();
    }
  }

  /** Has the limb drawn as the server has it, once it has what was wanted. */
  changed(): void {
    const { table, unsettled } = this.#options;
    const row = this.chosen.peek();
    if (row !== null && (row >= table.rows || table.radiusCode[row] === 0)) {
      this.abandon();
      this.chosen.value = null;
      return;
    }
    const wanted = this.wanted.peek();
    clearTimeout(this.#lingering);
    if (this.#setting || wanted === null || row === null || unsettled() > 0) {
      return;
    }
    if (Math.abs(this.diameterOf(row) / wanted - 1) < SAME) {
      this.#forget();
    } else {
      // The solver may have had to give way: then the rows never come to what was wanted.
      this.#lingering = setTimeout(() => {
        if (!this.#setting) {
          this.#forget();
        }
      }, LINGERS);
    }
  }

  #want(diameter: number): void {
    const { table, view, girth } = this.#options;
    const setting = this.#setting;
    if (!setting) {
      return;
    }
    clearTimeout(this.#lingering);
    const wanted = tidied(Math.min(MAX_DIAMETER, Math.max(setting.least, diameter)));
    this.wanted.value = wanted;
    setting.unsent = true;
    if (this.#overlay && view.hasOverlay(this.#overlay)) {
      this.#overlay.diameter = wanted;
      view.overlayChanged();
      return;
    }
    const others = new Set([...this.limits.peek()].filter((row) => row !== setting.row));
    this.#overlay = new WidthOverlay(table, setting.row, others, girth(), wanted);
    view.addOverlay(this.#overlay);
  }

  #forget(): void {
    clearTimeout(this.#lingering);
    this.wanted.value = null;
    if (this.#overlay) {
      this.#options.view.removeOverlay(this.#overlay);
      this.#overlay = null;
    }
  }

  #send(setting: Setting): void {
    const diameter = this.wanted.peek();
    setting.unsent = false;
    if (diameter !== null) {
      setting.sent = true;
      this.#options.submit({ kind: "set_width", row: setting.row, diameter, gesture: setting.gesture });
    }
  }

  #leastAt(row: number): number {
    const { table } = this.#options;
    const above = this.widths.peek().filter((width) => width.row > row && pathUp(table, row, width.row) !== null);
    return Math.max(MIN_DIAMETER, ...above.map(({ effective }) => effective));
  }

  /** The width that is set at a row. */
  #heldAt(row: number): number | null {
    return this.widths.peek().find((width) => width.row === row)?.diameter ?? null;
  }

  #present(row: number): number {
    const wanted = row === this.chosen.peek() ? this.wanted.peek() : null;
    return wanted ?? this.diameterOf(row);
  }

  /** The limb in the middle between two fingers. */
  #between(a: { x: number; y: number }, b: { x: number; y: number }): number | null {
    return this.#pick((a.x + b.x) / 2, (a.y + b.y) / 2, PINCH_TOLERANCE);
  }

  /** How far a place on the screen is from where a row is, in pixels. */
  #away(row: number, x: number, y: number): number {
    const place = this.#options.placeOnGlass(row);
    return place ? Math.hypot(x - place[0], y - place[1]) : 0;
  }

  #pick(x: number, y: number, tolerance: number): number | null {
    return this.#options.view.pick(x, y, tolerance)?.row ?? null;
  }
}

function spread(a: Finger, b: Finger): number {
  return Math.hypot(a.x - b.x, a.y - b.y);
}

/** Three digits are more than anyone can see. */
function tidied(diameter: number): number {
  return Number(diameter.toPrecision(3));
}
