import { computed, effect, type ReadonlySignal, signal } from "@preact/signals";
import type { Envelope } from "../../../scene/structure/envelope-surface";
import type { Shell, Shells } from "../../../scene/structure/shells";
import type { Vec3 } from "../../../scene/vector";
import type { Command, DocumentState, LimbOutline } from "../../../wire/generated";
import type { Gesture } from "../../input/gesture";
import { type Dragged, type Handle, type HandleGroup, type HandleView, type Held, handlesOf } from "./branch-handles";
import { BranchShape } from "./branch-shape";
import type { DesignSignal } from "./design-signal";
import { type HandsOn, type HeldShape, type Hidden, holdHands } from "./hands-on";
import { TapOrTurn } from "./tap-or-turn";

/** What handles of a limb that grew are about. */
export const LIMB_GROUPS = ["outline", "way"] as const satisfies readonly HandleGroup[];
/** From the base to the tip, in internodes (`LM21`). */
const [SHORTEST, LONGEST] = [0.5, 400];
const STRAIGHT: readonly Vec3[] = [
  [0, 0, 0],
  [0, 1, 0],
];

/** A limb that grew, and the outline that it has or is to fill. */
export interface Limb {
  readonly told: LimbOutline;
  readonly shape: BranchShape;
}

export interface LimbShapingOptions {
  readonly design: DesignSignal;
  /** Whether a design is shaped by hand, which has the picture for itself. */
  readonly isDesigning: ReadonlySignal<boolean>;
  readonly document: ReadonlySignal<DocumentState | null>;
  /** The last command of which nothing is left to do. */
  readonly finished: ReadonlySignal<number>;
  readonly mayChange: ReadonlySignal<boolean>;
  readonly view: () => HandleView | null;
  /** The row of the wood at a place of the picture; null beside the tree. */
  readonly pick: (x: number, y: number) => number | null;
  readonly shells: () => Pick<Shells, "show"> | null;
  /** Asks the server for the limb that a row lies on; false while there is no connection. */
  readonly look: (row: number) => boolean;
  /** Sends a command and gives its number; 0 where no session is open. */
  readonly submit: (command: Command) => number;
  /** A finger shapes until what this returns was called. */
  readonly hold: () => () => void;
  /** Says that no limb is where somebody tapped. */
  readonly missed: () => void;
}

/** A limb that is filling an outline. */
interface Filling {
  readonly command: number;
  readonly limb: Limb;
  /** The step before it. */
  readonly from: number;
}

/**
 * Shaping limbs of a tree that grew: a tap shows the outline around a limb, and a handle that is let go makes the limb fill
 * what the outline is then (`DS12`).
 */
export class LimbShaping implements HandsOn {
  /** Whether somebody asked for it. */
  readonly wanted = signal(false);
  readonly group = signal<HandleGroup>("outline");
  /** Whether the limb grows anew from its first fork, and not only where it does not fill the outline. */
  readonly anew = signal(false);
  readonly sketching = signal(false);
  readonly trace = signal<readonly (readonly [number, number])[]>([]);
  readonly draws = signal<"axis" | "outline">("outline");
  readonly hidden = signal<Hidden>({ near: 0, along: 0 });
  readonly held = signal<HeldShape | null>(null);
  readonly limb = signal<Limb | null>(null);
  /** Whether a limb is growing into its outline. */
  readonly isFilling = computed(() => this.#filling.value !== null);
  readonly isOn = computed(() => {
    const { design, isDesigning, mayChange } = this.#options;
    const told = design.inForce.value;
    const isOpen = told !== null && told.steps_on_top === 0;
    return this.wanted.value && !isOpen && !isDesigning.value && mayChange.value;
  });
  readonly chosen = computed(() => this.held.value?.shape ?? this.limb.value?.shape ?? null);
  readonly handles = computed(() => {
    const [shape, group] = [this.limb.value?.shape, this.group.value];
    if (this.held.value !== null && this.#grip !== null) {
      return [this.#grip.handle];
    }
    const isOf = (handle: Handle) => handle.group === group && (group === "outline" || handle.id === "tip");
    return shape && this.#filling.value === null ? handlesOf(shape).filter(isOf) : [];
  });
  readonly shown = computed<readonly Shell[]>(() => {
    const chosen = this.chosen.value;
    return this.isOn.value && chosen ? [chosen.shell("chosen")] : [];
  });

  #options: LimbShapingOptions;
  #filling = signal<Filling | null>(null);
  #grip: { readonly handle: Handle; readonly from: Held; readonly letGo: () => void; dragged: Dragged | null } | null =
    null;
  /** The row that somebody asked for by a tap, until it is answered. */
  #asked: number | null = null;
  /** Outlines of the chosen limb by the steps of the tree at which they were its own. */
  #known = new Map<number, Limb>();
  #taps: TapOrTurn;
  #stop: () => void;

  constructor(options: LimbShapingOptions) {
    this.#options = options;
    this.#taps = new TapOrTurn((x, y) => this.tap(x, y));
    const { design, document, finished } = options;
    const stops = [
      effect(() => {
        if (!this.isOn.value) {
          this.cancel();
          this.limb.value = null;
          this.#filling.value = null;
        }
      }),
      holdHands(options, this.isOn, this.shown, (gesture) => this.gesture(gesture)),
      effect(() => this.#told(design.limb.value)),
      effect(() => {
        const filling = this.#filling.value;
        if (filling && finished.value >= filling.command) {
          this.#filled(filling);
        }
      }),
      effect(() => {
        const state = document.value;
        if (!state) {
          // Rows of another session are others.
          this.limb.value = null;
          this.#filling.value = null;
        } else if (state.pending_steps === 0 && this.#filling.value === null) {
          this.#follow(state.step);
        }
      }),
    ];
    this.#stop = () => {
      for (const stop of stops) {
        stop();
      }
    };
  }

  /** What a gesture on the canvas still means to the view. */
  gesture(gesture: Gesture): Gesture | null {
    return this.#taps.gesture(gesture);
  }

  /** Shows the limb at a place; none beside the tree. */
  tap(x: number, y: number): void {
    const row = this.#options.pick(x, y);
    if (this.#filling.peek() !== null) {
      return;
    }
    if (row === null) {
      this.limb.value = null;
    } else {
      this.#ask(row);
    }
  }

  /** Shows the limb that bears the chosen one. */
  up(): void {
    const bearer = this.limb.peek()?.told.bearer;
    if (bearer !== undefined && this.#filling.peek() === null) {
      this.#ask(bearer);
    }
  }

  grip(handle: Handle): void {
    this.cancel();
    const shape = this.limb.peek()?.shape;
    if (shape) {
      const from: Held = { shape, bearer: null, roll: 0, height: 0 };
      this.#grip = { handle, from, letGo: this.#options.hold(), dragged: null };
    }
  }

  drag(x: number, y: number): void {
    const [grip, view] = [this.#grip, this.#options.view()];
    const dragged = grip && view && grip.handle.drag(grip.from, view, x, y);
    if (grip && dragged && dragged.shape.placed.length <= LONGEST) {
      grip.dragged = dragged;
      this.held.value = { handle: grip.handle.id, shape: dragged.shape, readout: dragged.readout };
    }
  }

  /** The handle is let go: the limb fills what its outline is now. */
  release(): void {
    const [grip, limb] = [this.#grip, this.limb.peek()];
    this.#grip = null;
    grip?.letGo();
    if (grip?.dragged && limb) {
      this.#fill(limb, grip.dragged.shape);
    }
    this.held.value = null;
  }

  cancel(): boolean {
    const grip = this.#grip;
    this.#grip = null;
    this.held.value = null;
    grip?.letGo();
    return grip !== null;
  }

  /** Nothing that a handle of a limb does is undone by a double tap. */
  without(): void {
    this.cancel();
  }

  dispose(): void {
    this.#stop();
  }

  #ask(row: number): void {
    this.#asked = this.#options.look(row) ? row : null;
  }

  /** The server has told a limb. */
  #told(answer: DesignSignal["limb"]["value"]): void {
    if (!answer || !this.isOn.peek()) {
      return;
    }
    const isTapped = this.#asked === answer.of;
    if (!isTapped && answer.of !== this.limb.peek()?.told.row) {
      return;
    }
    this.#asked = null;
    if (!answer.limb) {
      this.limb.value = null;
      if (isTapped) {
        this.#options.missed();
      }
      return;
    }
    if (answer.limb.row !== this.limb.peek()?.told.row) {
      this.#known.clear();
    }
    const limb = { told: answer.limb, shape: shapeOf(answer.limb) };
    this.#know(limb);
    this.limb.value = limb;
  }

  #fill({ told }: Limb, shape: BranchShape): void {
    const { submit, document } = this.#options;
    const limb = { told, shape };
    const { envelope, placed } = shape;
    const command = submit({
      kind: "refill",
      row: told.row,
      envelope,
      rotation: placed.outline,
      length: Math.max(placed.length, SHORTEST),
      ...(this.anew.peek() ? { anew: true } : {}),
    });
    if (command > 0) {
      this.#filling.value = { command, limb, from: document.peek()?.step ?? 0 };
      this.limb.value = limb;
    }
  }

  /** Nothing is left to do of it: the limb has this outline, unless it was refused. */
  #filled({ limb, from }: Filling): void {
    const step = this.#options.document.peek()?.step ?? from;
    if (step !== from) {
      // What was known of later steps was of another line.
      for (const known of [...this.#known.keys()]) {
        if (known > from) {
          this.#known.delete(known);
        }
      }
      this.#know(limb);
    }
    this.limb.value = this.#known.get(step) ?? null;
    this.#filling.value = null;
  }

  #know(limb: Limb): void {
    const step = this.#options.document.peek()?.step;
    if (step !== undefined) {
      this.#known.set(step, limb);
    }
  }

  /** The tree stands at a step: the outline is the one that it had there, or is asked for. */
  #follow(step: number): void {
    const limb = this.limb.peek();
    if (!limb) {
      return;
    }
    const known = this.#known.get(step);
    if (known) {
      this.limb.value = known;
    } else {
      this.cancel();
      this.#options.look(limb.told.row);
    }
  }
}

/** The outline of a limb as handles take hold of it. */
function shapeOf(limb: LimbOutline): BranchShape {
  const { base, frame, length, radius, heading, bears } = limb;
  const placed = { path: "limb", base, frame, outline: frame, length, radius, at: 0, heading, outside: false, bears };
  return new BranchShape(placed, limb.envelope as Envelope, STRAIGHT);
}
