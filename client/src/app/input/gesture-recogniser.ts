import { Fingers, SLOP } from "./fingers";
import type { Gesture, Grip, PointerPress, PointerSample, StrokePoint } from "./gesture";

export type { Gesture, Grip, PointerPress, PointerSample, StrokePoint } from "./gesture";

/** How far a pen or a mouse may wander before it is drawing, and no longer holding what is under it. */
export const FINE_SLOP = 5;
/** How long a resting finger waits for a second one before it is drawing, in milliseconds. */
export const HOLD = 110;
/** How long one is held on a branch to choose it. */
export const CHOOSE = 450;
/** Longer than this, in milliseconds, a press is no tap. */
export const LONGEST_TAP = 260;
/** How soon after a tap a second one makes it a double tap, in milliseconds. */
export const SECOND_TAP = 260;
/** And how near to it, in pixels. */
const SAME_PLACE = 28;
/** How long after a pen was last seen touches do not draw. */
export const PEN_MEMORY = 20_000;

type State =
  | { readonly kind: "idle" }
  | Waiting
  | Tapped
  /** A tool has these pointers; `pen` if they are no touches. */
  | { readonly kind: "grips"; readonly ids: Set<number>; readonly pen: boolean }
  /** What is under it has been chosen; nothing more comes of it. */
  | { readonly kind: "held"; readonly id: number }
  | { readonly kind: "stroke"; readonly id: number }
  | { readonly kind: "drag"; readonly id: number; readonly mode: "pan" | "orbit"; x: number; y: number }
  /** Two or more fingers move the view; `rotated` once three did, until all are lifted. */
  | { readonly kind: "fingers"; rotated: boolean };

/** One pointer is down; it may become a stroke, choose what is under it, or be the first of two fingers. */
interface Waiting {
  readonly kind: "waiting";
  readonly id: number;
  readonly since: number;
  readonly slop: number;
  readonly holdable: boolean;
  readonly doubles: boolean;
  /** The tap that came before it, if this one may make it a double tap. */
  readonly before: Tapped | null;
  /** Whether `hold-begin` has gone out. */
  shown: boolean;
  readonly points: StrokePoint[];
}

/** One was tapped, and may be again: only then is it known whether it draws. */
interface Tapped {
  readonly kind: "tapped";
  readonly until: number;
  readonly holdable: boolean;
  readonly x: number;
  readonly y: number;
  /** What it draws if it stays alone; none if it was nearly a hold. */
  readonly points: readonly StrokePoint[];
}

/**
 * Turns pointers into strokes and camera moves.
 *
 * A touch is held back until it has moved or rested a little, so that the first finger of a pinch draws no dot;
 * what it went through meanwhile is delivered with the stroke. Where holding still chooses something, any pointer is
 * held back until it has moved or chosen.
 */
export class GestureRecogniser {
  #state: State = { kind: "idle" };
  /** Touches that count, by pointer; palms beside a pen and fingers beside a stroke do not. */
  #fingers = new Fingers();
  #penSeen = Number.NEGATIVE_INFINITY;

  /** When `tick` is due, or null. */
  get deadline(): number | null {
    const state = this.#state;
    if (state.kind === "tapped") {
      return state.until;
    }
    return state.kind === "waiting" ? state.since + (state.shown ? CHOOSE : HOLD) : null;
  }

  /** Whether a stroke is in progress. */
  get stroking(): boolean {
    return this.#state.kind === "stroke";
  }

  down(press: PointerPress): Gesture[] {
    const state = this.#state;
    if (state.kind !== "tapped") {
      return this.#down(press, null);
    }
    this.#state = { kind: "idle" };
    const near = Math.hypot(press.x - state.x, press.y - state.y) <= SAME_PLACE;
    if (near && press.time < state.until && press.button === 0 && !press.pans) {
      return this.#down(press, state);
    }
    return [...drawn(state), ...this.#down(press, null)];
  }

  /** The pointer went through these places since the last call; `samples` is in time order. */
  move(samples: readonly PointerSample[]): Gesture[] {
    const last = samples[samples.length - 1];
    if (last === undefined) {
      return [];
    }
    if (last.device === "pen") {
      this.#penSeen = last.time;
    }
    const state = this.#state;
    switch (state.kind) {
      case "waiting":
        return state.id === last.id ? this.#wander(state, samples) : [];
      case "stroke":
        return state.id === last.id ? [{ kind: "stroke-move", points: samples.map(strokePoint) }] : [];
      case "drag": {
        if (state.id !== last.id) {
          return [];
        }
        const gesture = { kind: state.mode, dx: last.x - state.x, dy: last.y - state.y } as const;
        state.x = last.x;
        state.y = last.y;
        return [gesture];
      }
      case "fingers":
        return this.#moveFinger(state, last);
      case "grips":
        this.#fingers.place(last.id, last.x, last.y);
        return state.ids.has(last.id) ? [{ kind: "grip-move", id: last.id, x: last.x, y: last.y }] : [];
      case "idle":
      case "held":
      case "tapped":
        return [];
    }
  }

  up(sample: PointerSample): Gesture[] {
    return this.#lift(sample.id, sample.time);
  }

  /** The system took the pointer away: a stroke ends where it is, a candidate never was one. */
  cancel(id: number): Gesture[] {
    return this.#lift(id, null);
  }

  /** The hold time has passed. */
  tick(now: number): Gesture[] {
    const state = this.#state;
    if (state.kind === "tapped" && now >= state.until) {
      this.#state = { kind: "idle" };
      return drawn(state);
    }
    const point = state.kind === "waiting" ? state.points[0] : undefined;
    if (state.kind !== "waiting" || point === undefined || now < state.since + HOLD) {
      return [];
    }
    if (!state.holdable) {
      return this.#draw(state);
    }
    const { x, y } = point;
    if (now >= state.since + CHOOSE) {
      this.#state = { kind: "held", id: state.id };
      return [...ended(state), { kind: "choose", x, y }];
    }
    if (state.shown) {
      return [];
    }
    state.shown = true;
    return [{ kind: "hold-begin", x, y, milliseconds: state.since + CHOOSE - now }];
  }

  #down(press: PointerPress, before: Tapped | null): Gesture[] {
    switch (press.device) {
      case "mouse":
        return this.#mouseDown(press, before);
      case "pen":
        return this.#penDown(press, before);
      case "touch":
        return this.#touchDown(press, before);
    }
  }

  #mouseDown(press: PointerPress, before: Tapped | null): Gesture[] {
    if (this.#state.kind !== "idle") {
      return [];
    }
    if (press.button === 0 && !press.pans) {
      return this.#press(press, before);
    }
    const mode = press.button === 2 ? "orbit" : "pan";
    this.#state = { kind: "drag", id: press.id, mode, x: press.x, y: press.y };
    return [];
  }

  #penDown(press: PointerPress, tapped: Tapped | null): Gesture[] {
    this.#penSeen = press.time;
    const state = this.#state;
    if ((state.kind === "stroke" || state.kind === "waiting") && !this.#fingers.has(state.id)) {
      return [];
    }
    if (state.kind === "grips" && state.pen) {
      return [];
    }
    // Whatever a palm had begun ends: the pen is what draws.
    const before = ended(this.#state);
    this.#state = { kind: "idle" };
    this.#fingers.clear();
    if (press.pans) {
      this.#state = { kind: "drag", id: press.id, mode: "pan", x: press.x, y: press.y };
      return before;
    }
    return [...before, ...this.#press(press, tapped)];
  }

  #touchDown(press: PointerPress, before: Tapped | null): Gesture[] {
    const state = this.#state;
    const busy = state.kind === "stroke" || state.kind === "drag" || (state.kind === "grips" && state.pen);
    // A palm beside a pen that is held still is no second finger.
    if (busy || (state.kind === "waiting" && !this.#fingers.has(state.id))) {
      return [];
    }
    this.#fingers.add(press.id, press.x, press.y, press.time);
    const draws = !press.pans && press.time - this.#penSeen >= PEN_MEMORY;
    if (press.grip && (state.kind === "grips" || (state.kind === "idle" && draws))) {
      return this.#gripTouch(press, press.grip);
    }
    if (this.#fingers.size > 1) {
      const rotated = this.#fingers.size > 2 || (state.kind === "fingers" && state.rotated);
      this.#state = { kind: "fingers", rotated };
      return ended(state);
    }
    if (press.pans) {
      this.#state = { kind: "drag", id: press.id, mode: "pan", x: press.x, y: press.y };
    } else if (press.time - this.#penSeen < PEN_MEMORY) {
      this.#state = { kind: "fingers", rotated: false };
    } else {
      this.#wait(press, SLOP, before);
    }
    return [];
  }

  #gripTouch(press: PointerPress, grip: Grip): Gesture[] {
    const state = this.#state;
    if (grip === "take") {
      return this.#grip(press, SLOP, false);
    }
    if (grip === "ignore") {
      return [];
    }
    this.#state = { kind: "fingers", rotated: this.#fingers.size > 2 };
    return ended(state);
  }

  #grip(press: PointerPress, slop: number, pen: boolean): Gesture[] {
    const { id, x, y } = press;
    if (this.#state.kind === "grips") {
      this.#state.ids.add(id);
    } else {
      this.#state = { kind: "grips", ids: new Set([id]), pen };
    }
    return [{ kind: "grip-begin", id, x, y, slop }];
  }

  /** A mouse or pen draws at once, except where it may be held or tapped twice. */
  #press(press: PointerPress, before: Tapped | null): Gesture[] {
    if (press.grip) {
      return this.#grip(press, FINE_SLOP, true);
    }
    if (press.choose) {
      this.#state = { kind: "held", id: press.id };
      return [{ kind: "choose", x: press.x, y: press.y }];
    }
    if (press.holdable) {
      this.#wait(press, FINE_SLOP, before);
      return [];
    }
    const tap = before ? drawn(before) : [];
    this.#state = { kind: "stroke", id: press.id };
    return [...tap, { kind: "stroke-begin", point: strokePoint(press) }];
  }

  #wait(press: PointerPress, slop: number, before: Tapped | null): void {
    const { id, time: since, holdable, doubles = false } = press;
    const points = [strokePoint(press)];
    this.#state = { kind: "waiting", id, since, slop, holdable, doubles, before, shown: false, points };
  }

  #wander(state: Waiting, samples: readonly PointerSample[]): Gesture[] {
    const first = state.points[0];
    let far = false;
    for (const sample of samples) {
      state.points.push(strokePoint(sample));
      far ||= first !== undefined && Math.hypot(sample.x - first.x, sample.y - first.y) > state.slop;
      this.#fingers.place(sample.id, sample.x, sample.y);
    }
    const now = samples[samples.length - 1]?.time ?? 0;
    return far ? this.#draw(state) : this.tick(now);
  }

  /** A candidate becomes a stroke, with all it went through. */
  #draw(state: Waiting): Gesture[] {
    const [first, ...rest] = state.points;
    if (first === undefined) {
      return [];
    }
    const gestures: Gesture[] = [...ended(state), { kind: "stroke-begin", point: first }];
    this.#state = { kind: "stroke", id: state.id };
    return rest.length > 0 ? [...gestures, { kind: "stroke-move", points: rest }] : gestures;
  }

  #moveFinger(state: Extract<State, { kind: "fingers" }>, sample: PointerSample): Gesture[] {
    if (!this.#fingers.has(sample.id)) {
      return [];
    }
    const moved = this.#fingers.moved(sample.id, sample.x, sample.y, sample.time);
    if (moved === null) {
      return [];
    }
    const [before, after] = moved;
    const dx = after.x - before.x;
    const dy = after.y - before.y;
    if (this.#fingers.size >= 3) {
      return [{ kind: "orbit", dx, dy }];
    }
    // After a rotation the view rests until all fingers are up, so that lifting them one by one does not jerk it.
    if (this.#fingers.size < 2 || state.rotated) {
      return [];
    }
    const pan: Gesture = { kind: "pan", dx, dy };
    if (before.distance < 1 || after.distance < 1 || before.distance === after.distance) {
      return [pan];
    }
    return [pan, { kind: "zoom", factor: after.distance / before.distance, x: after.x, y: after.y }];
  }

  /** `time` is null where the system took the pointer away. */
  #lift(id: number, time: number | null): Gesture[] {
    const tap = this.#fingers.remove(id, time);
    const state = this.#state;
    if (state.kind === "fingers") {
      if (this.#fingers.size === 0) {
        this.#state = { kind: "idle" };
      }
      return tap > 1 ? [{ kind: "several-tap", fingers: tap }] : [];
    }
    if (state.kind === "grips") {
      this.#fingers.noTap();
      if (!state.ids.delete(id)) {
        return [];
      }
      if (state.ids.size === 0) {
        // Fingers that were only resting on the screen do not draw either.
        this.#state = this.#fingers.size > 0 ? { kind: "fingers", rotated: true } : { kind: "idle" };
      }
      return [{ kind: "grip-end", id }];
    }
    if (state.kind === "idle" || state.kind === "tapped" || state.id !== id) {
      return [];
    }
    if (state.kind === "waiting" && time !== null && state.doubles && time - state.since <= LONGEST_TAP) {
      return this.#tapped(state, time);
    }
    // A quick tap is a stroke of one place; what was nearly held long enough is not.
    if (state.kind !== "waiting" || time === null || state.shown) {
      this.#state = { kind: "idle" };
      return ended(state);
    }
    const gestures = [...this.#draw(state), ...ended(this.#state)];
    this.#state = { kind: "idle" };
    return gestures;
  }

  /** A tap waits for a second one; two are a double tap where there is a branch, and nothing elsewhere. */
  #tapped({ holdable, points, before, shown }: Waiting, time: number): Gesture[] {
    const { x, y } = points[0] ?? { x: 0, y: 0 };
    const gestures: Gesture[] = shown ? [{ kind: "hold-end" }] : [];
    if (before) {
      this.#state = { kind: "idle" };
      return before.holdable && holdable ? [...gestures, { kind: "double-tap", x, y }] : gestures;
    }
    this.#state = { kind: "tapped", until: time + SECOND_TAP, holdable, x, y, points: shown ? [] : points };
    return gestures;
  }
}

/** What has to be said when a state is left before its time. */
function ended(state: State): Gesture[] {
  if (state.kind === "stroke") {
    return [{ kind: "stroke-end" }];
  }
  if (state.kind === "grips") {
    return [{ kind: "grip-drop" }];
  }
  if (state.kind === "tapped") {
    return drawn(state);
  }
  if (state.kind === "waiting" && state.before) {
    return [...drawn(state.before), ...(state.shown ? [{ kind: "hold-end" } as const] : [])];
  }
  return state.kind === "waiting" && state.shown ? [{ kind: "hold-end" }] : [];
}

/** A tap that stayed alone: a stroke of one place. */
function drawn({ points }: Tapped): Gesture[] {
  const [first, ...rest] = points;
  if (first === undefined) {
    return [];
  }
  const begin: Gesture[] = [{ kind: "stroke-begin", point: first }];
  return [
    ...begin,
    ...(rest.length > 0 ? [{ kind: "stroke-move", points: rest } as const] : []),
    { kind: "stroke-end" },
  ];
}

/** How a turn of the wheel zooms: above 1 comes closer. `mode` is the event's deltaMode. */
export function wheelFactor(delta: number, mode: number, pinch: boolean): number {
  const pixels = delta * (mode === 1 ? 18 : mode === 2 ? 400 : 1);
  // A trackpad's pinch arrives as a wheel with the control key and a much smaller delta.
  const exponent = Math.max(-0.5, Math.min(0.5, -pixels * (pinch ? 0.01 : 0.0016)));
  return Math.exp(exponent);
}

function strokePoint(sample: PointerSample): StrokePoint {
  return { x: sample.x, y: sample.y, pressure: sample.device === "pen" ? sample.pressure : null };
}
