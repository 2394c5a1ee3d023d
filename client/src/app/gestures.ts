/** How far a finger may wander before it is drawing, in pixels. */
export const SLOP = 9;
/** How long a resting finger waits for a second one before it is drawing, in milliseconds. */
export const HOLD = 110;
/** How long after a pen was last seen touches do not draw. */
export const PEN_MEMORY = 20_000;

/** One pointer event, reduced to what gestures are made of. Positions are in pixels of the canvas. */
export interface PointerSample {
  readonly id: number;
  readonly device: "touch" | "pen" | "mouse";
  readonly x: number;
  readonly y: number;
  readonly pressure: number;
  /** In milliseconds, of the same clock for all calls. */
  readonly time: number;
}

export interface PointerPress extends PointerSample {
  readonly button: number;
  /** Shift or the space bar is held: the brush becomes a hand. */
  readonly hand: boolean;
}

/** A place a stroke went through. */
export interface StrokePoint {
  readonly x: number;
  readonly y: number;
  /** 0 to 1; only a pen knows, others say null. */
  readonly pressure: number | null;
}

export type Gesture =
  | { readonly kind: "stroke-begin"; readonly point: StrokePoint }
  | { readonly kind: "stroke-move"; readonly points: readonly StrokePoint[] }
  | { readonly kind: "stroke-end" }
  | { readonly kind: "pan"; readonly dx: number; readonly dy: number }
  | { readonly kind: "orbit"; readonly dx: number; readonly dy: number }
  | { readonly kind: "zoom"; readonly factor: number; readonly x: number; readonly y: number };

type State =
  | { readonly kind: "idle" }
  /** A finger is down that may yet become a stroke or the first of two. */
  | { readonly kind: "waiting"; readonly id: number; readonly since: number; readonly points: StrokePoint[] }
  | { readonly kind: "stroke"; readonly id: number }
  | { readonly kind: "drag"; readonly id: number; readonly mode: "pan" | "orbit"; x: number; y: number }
  /** Two or more fingers move the view; `rotated` once three did, until all are lifted. */
  | { readonly kind: "fingers"; rotated: boolean };

interface Finger {
  x: number;
  y: number;
}

/**
 * Turns pointers into strokes and camera moves.
 *
 * A touch is held back until it has moved or rested a little, so that the first finger of a pinch draws no dot;
 * what it went through meanwhile is delivered with the stroke.
 */
export class GestureRecogniser {
  #state: State = { kind: "idle" };
  /** Touches that count, by pointer; palms beside a pen and fingers beside a stroke do not. */
  #fingers = new Map<number, Finger>();
  #penSeen = Number.NEGATIVE_INFINITY;

  /** When `tick` is due, or null. */
  get deadline(): number | null {
    return this.#state.kind === "waiting" ? this.#state.since + HOLD : null;
  }

  /** Whether a stroke is under way. */
  get stroking(): boolean {
    return this.#state.kind === "stroke";
  }

  down(press: PointerPress): Gesture[] {
    switch (press.device) {
      case "mouse":
        return this.#mouseDown(press);
      case "pen":
        return this.#penDown(press);
      case "touch":
        return this.#touchDown(press);
    }
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
      case "idle":
        return [];
    }
  }

  up(sample: PointerSample): Gesture[] {
    return this.#lift(sample.id, false);
  }

  /** The system took the pointer away: a stroke ends where it is, a candidate never was one. */
  cancel(id: number): Gesture[] {
    return this.#lift(id, true);
  }

  /** The hold time has passed. */
  tick(now: number): Gesture[] {
    const state = this.#state;
    return state.kind === "waiting" && now >= state.since + HOLD ? this.#draw(state) : [];
  }

  #mouseDown(press: PointerPress): Gesture[] {
    if (this.#state.kind !== "idle") {
      return [];
    }
    if (press.button === 0 && !press.hand) {
      return this.#begin(press);
    }
    const mode = press.button === 2 ? "orbit" : "pan";
    this.#state = { kind: "drag", id: press.id, mode, x: press.x, y: press.y };
    return [];
  }

  #penDown(press: PointerPress): Gesture[] {
    this.#penSeen = press.time;
    if (this.#state.kind === "stroke" && !this.#fingers.has(this.#state.id)) {
      return [];
    }
    // Whatever a palm had begun ends: the pen is what draws.
    const ended: Gesture[] = this.#state.kind === "stroke" ? [{ kind: "stroke-end" }] : [];
    this.#fingers.clear();
    if (press.hand) {
      this.#state = { kind: "drag", id: press.id, mode: "pan", x: press.x, y: press.y };
      return ended;
    }
    return [...ended, ...this.#begin(press)];
  }

  #touchDown(press: PointerPress): Gesture[] {
    const state = this.#state;
    if (state.kind === "stroke" || state.kind === "drag") {
      return [];
    }
    this.#fingers.set(press.id, { x: press.x, y: press.y });
    if (this.#fingers.size > 1) {
      const rotated = this.#fingers.size > 2 || (state.kind === "fingers" && state.rotated);
      this.#state = { kind: "fingers", rotated };
      return [];
    }
    if (press.hand) {
      this.#state = { kind: "drag", id: press.id, mode: "pan", x: press.x, y: press.y };
    } else if (press.time - this.#penSeen < PEN_MEMORY) {
      this.#state = { kind: "fingers", rotated: false };
    } else {
      this.#state = { kind: "waiting", id: press.id, since: press.time, points: [strokePoint(press)] };
    }
    return [];
  }

  #wander(state: Extract<State, { kind: "waiting" }>, samples: readonly PointerSample[]): Gesture[] {
    const first = state.points[0];
    let far = false;
    for (const sample of samples) {
      state.points.push(strokePoint(sample));
      far ||= first !== undefined && Math.hypot(sample.x - first.x, sample.y - first.y) > SLOP;
      this.#place(sample);
    }
    const late = (samples[samples.length - 1]?.time ?? 0) >= state.since + HOLD;
    return far || late ? this.#draw(state) : [];
  }

  /** A candidate becomes a stroke, with all it went through. */
  #draw(state: Extract<State, { kind: "waiting" }>): Gesture[] {
    const [first, ...rest] = state.points;
    if (first === undefined) {
      return [];
    }
    this.#state = { kind: "stroke", id: state.id };
    const begin: Gesture = { kind: "stroke-begin", point: first };
    return rest.length > 0 ? [begin, { kind: "stroke-move", points: rest }] : [begin];
  }

  #begin(press: PointerPress): Gesture[] {
    this.#state = { kind: "stroke", id: press.id };
    return [{ kind: "stroke-begin", point: strokePoint(press) }];
  }

  #place(sample: PointerSample): void {
    const finger = this.#fingers.get(sample.id);
    if (finger) {
      finger.x = sample.x;
      finger.y = sample.y;
    }
  }

  #moveFinger(state: Extract<State, { kind: "fingers" }>, sample: PointerSample): Gesture[] {
    if (!this.#fingers.has(sample.id)) {
      return [];
    }
    const before = spread(this.#fingers);
    this.#place(sample);
    const after = spread(this.#fingers);
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

  #lift(id: number, cancelled: boolean): Gesture[] {
    this.#fingers.delete(id);
    const state = this.#state;
    if (state.kind === "fingers") {
      if (this.#fingers.size === 0) {
        this.#state = { kind: "idle" };
      }
      return [];
    }
    if (state.kind === "idle" || state.id !== id) {
      return [];
    }
    // A quick tap is a stroke of one place.
    const gestures = state.kind === "waiting" && !cancelled ? this.#draw(state) : [];
    this.#state = { kind: "idle" };
    const stroke = state.kind === "stroke" || gestures.length > 0;
    return stroke ? [...gestures, { kind: "stroke-end" }] : [];
  }
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

/** The centre of the fingers and how far they are from it on average, times two. */
function spread(fingers: Map<number, Finger>): { x: number; y: number; distance: number } {
  const all = [...fingers.values()];
  const count = Math.max(1, all.length);
  const x = all.reduce((sum, finger) => sum + finger.x, 0) / count;
  const y = all.reduce((sum, finger) => sum + finger.y, 0) / count;
  const distance = (2 * all.reduce((sum, finger) => sum + Math.hypot(finger.x - x, finger.y - y), 0)) / count;
  return { x, y, distance };
}
