import { computed, effect, type ReadonlySignal, signal } from "@preact/signals";
import type { Command, GrammarInForce } from "../../../wire/generated";
import type { Clock } from "../../page/clock";

/** How long after its answer a move may take to show, in milliseconds; then it has led nowhere. */
const PATIENCE = 1500;

/** What of a grammar says where its depths lie on the line of time. */
export type Depths = Pick<GrammarInForce, "depth" | "earlier" | "later">;

/** The next thing to do on the way to a depth. */
export type DepthMove =
  | { readonly travel: number }
  | { readonly derive: number }
  | { readonly set: number }
  | { readonly rest: true };

/**
 * How to come nearer to a depth: through time, where the line has it; derived further, at its end; else the plant is
 * made anew at that depth. `stepsAhead` are those that the line of time has after the present one.
 */
export function moveTo({ depth, earlier, later }: Depths, wanted: number, stepsAhead: number): DepthMove {
  const by = wanted - depth;
  if (by === 0) {
    return { rest: true };
  }
  if (by < 0) {
    return -by <= earlier ? { travel: by } : set(wanted);
  }
  if (later > 0) {
    return { travel: Math.min(by, later) };
  }
  // What comes after the present step on this line is something else, which deriving would leave as another future.
  return stepsAhead > 0 ? set(wanted) : { derive: by };
}

/** Only time leads to the axiom alone. */
function set(wanted: number): DepthMove {
  return { set: Math.max(1, wanted) };
}

export interface DepthPage {
  readonly inForce: ReadonlySignal<GrammarInForce | null>;
  readonly submit: (command: Command) => number;
  /** Goes so many steps back or forth in time. */
  readonly travel: (steps: number) => void;
  readonly stepsAhead: () => number;
  /** Whether anything that was asked for is not answered, or still grows. */
  readonly busy: ReadonlySignal<boolean>;
  readonly newGesture: () => number;
  /** Somebody has chosen a depth. */
  readonly steered: () => void;
  readonly clock: Clock;
}

/** The depth of the grammar in force, as a control sets it: one move at a time, always to the newest depth that is wanted. */
export class DepthControl {
  /** The depth that is asked for; null where there is nothing to do. */
  readonly wanted = signal<number | null>(null);
  readonly shown = computed(() => this.wanted.value ?? this.#page.inForce.value?.depth ?? 0);
  readonly #page: DepthPage;
  readonly #stop: () => void;
  #gesture: number | undefined;
  /** Where the last move began: one that led nowhere is not made again. */
  #from: { readonly depth: number; readonly wanted: number } | null = null;
  #cancelWaiting: (() => void) | null = null;

  constructor(page: DepthPage) {
    this.#page = page;
    this.#stop = effect(() => {
      const [inForce, wanted] = [page.inForce.value, this.wanted.value];
      if (inForce !== null && wanted !== null && !page.busy.value) {
        this.#go(inForce, wanted);
      }
    });
  }

  /** A control moves: all of one movement is one deed. */
  drag(depth: number): void {
    this.#gesture ??= this.#page.newGesture();
    this.#want(depth);
  }

  /** A depth that was let go, typed or stepped to. */
  commit(depth: number): void {
    this.#want(depth);
    this.#gesture = undefined;
  }

  by(steps: number): void {
    this.commit(this.shown.peek() + steps);
  }

  /** What was wanted is given up, as where it was refused. */
  rest(): void {
    this.#cancelWaiting?.();
    this.#cancelWaiting = null;
    this.#from = null;
    this.wanted.value = null;
  }

  dispose(): void {
    this.#cancelWaiting?.();
    this.#stop();
  }

  #want(depth: number): void {
    this.#from = null;
    this.#page.steered();
    this.wanted.value = Math.max(0, Math.round(depth));
  }

  #go(inForce: GrammarInForce, wanted: number): void {
    const move = moveTo(inForce, wanted, this.#page.stepsAhead());
    if ("rest" in move || ("set" in move && move.set === inForce.depth)) {
      this.rest();
      return;
    }
    if (this.#from?.depth === inForce.depth && this.#from.wanted === wanted) {
      // Its answer is there, and what came of it is told a little later, if anything did.
      this.#cancelWaiting ??= this.#page.clock.after(PATIENCE, () => this.rest());
      return;
    }
    this.#cancelWaiting?.();
    this.#cancelWaiting = null;
    this.#from = { depth: inForce.depth, wanted };
    const gesture = this.#gesture === undefined ? {} : { gesture: this.#gesture };
    if ("travel" in move) {
      this.#page.travel(move.travel);
    } else if ("derive" in move) {
      this.#page.submit({ kind: "derive", steps: Math.min(move.derive, 1000), ...gesture });
    } else {
      const { text, values } = inForce;
      this.#page.submit({ kind: "set_grammar", text, values, depth: move.set, ...gesture });
    }
  }
}
