import {
  type Gesture,
  GestureRecogniser,
  type Grip,
  type PointerPress,
  type PointerSample,
  wheelFactor,
} from "./gesture-recogniser";
import { PressQueue } from "./press-queue";

export interface PointerHandlers {
  gesture(gesture: Gesture): void;
  /** A mouse or pen is over the canvas, or no longer. */
  hover(place: { readonly x: number; readonly y: number } | null): void;
  /** The wheel was turned with the alt key: above 1 widens the brush. */
  widen(factor: number): void;
  /** Whether the space bar is held. */
  panHeld(): boolean;
  /** Whether holding still at a place chooses something. */
  holdable(x: number, y: number): boolean;
  /** Whether two taps mean something to the chosen tool. */
  doubles(): boolean;
  /** Whether the chosen tool came, while its code is being loaded; null where it is there. */
  loading(): Promise<boolean> | null;
  /** What the chosen tool does with one more finger at a place; null if it draws strokes. */
  grip(x: number, y: number): Grip | null;
}

/** Feeds a canvas' pointer events to a gesture recogniser; returns what ends it. */
export function listenToPointers(canvas: HTMLCanvasElement, handlers: PointerHandlers): () => void {
  const recogniser = new GestureRecogniser();
  const queue = new PressQueue();
  let timer = 0;
  const stop = new AbortController();

  const deliver = (gestures: Gesture[]) => {
    for (const gesture of gestures) {
      handlers.gesture(gesture);
    }
    clearTimeout(timer);
    const { deadline } = recogniser;
    if (deadline !== null) {
      timer = window.setTimeout(
        () => deliver(recogniser.tick(performance.now())),
        Math.max(0, deadline - performance.now()) + 1,
      );
    }
  };
  const sample = (event: PointerEvent): PointerSample => {
    const bounds = canvas.getBoundingClientRect();
    const device = event.pointerType === "touch" || event.pointerType === "pen" ? event.pointerType : "mouse";
    const { pointerId: id, pressure } = event;
    // Synthetic events may carry another clock than the timer's; arrival is what the hold time is about.
    return {
      id,
      device,
      x: event.clientX - bounds.left,
      y: event.clientY - bounds.top,
      pressure,
      time: performance.now(),
    };
  };
  const on = <Kind extends keyof HTMLElementEventMap>(kind: Kind, run: (event: HTMLElementEventMap[Kind]) => void) =>
    canvas.addEventListener(kind, run, { signal: stop.signal, passive: false });

  on("pointerdown", (event) => {
    event.preventDefault();
    // Leaving a text field closes the tablet's keyboard.
    if (document.activeElement instanceof HTMLElement) {
      document.activeElement.blur();
    }
    try {
      canvas.setPointerCapture(event.pointerId);
    } catch {
      // A pointer that is gone already will send its end all the same.
    }
    const at = sample(event);
    const { button, altKey: choose } = event;
    const pans = event.shiftKey || handlers.panHeld();
    const down = () => {
      const holdable = button === 0 && !pans && handlers.holdable(at.x, at.y);
      const grip = button === 0 && !pans ? handlers.grip(at.x, at.y) : null;
      const doubles = handlers.doubles();
      const press: PointerPress = { ...at, button, pans, choose, holdable, doubles, ...(grip ? { grip } : {}) };
      deliver(recogniser.down(press));
    };
    queue.press(down, handlers.loading());
  });
  on("pointermove", (event) => {
    const coalesced = event.getCoalescedEvents?.() ?? [];
    const samples = (coalesced.length > 0 ? coalesced : [event]).map(sample);
    queue.follow(() => deliver(recogniser.move(samples)));
    if (event.pointerType !== "touch") {
      handlers.hover(sample(event));
    }
  });
  on("pointerup", (event) => {
    const at = sample(event);
    queue.follow(() => deliver(recogniser.up(at)));
  });
  const cancel = ({ pointerId }: PointerEvent) => queue.follow(() => deliver(recogniser.cancel(pointerId)));
  on("pointercancel", cancel);
  // A capture that is lost without an end (a dialog opens, say) must not leave a stroke running.
  on("lostpointercapture", cancel);
  on("pointerleave", (event) => {
    if (event.pointerType !== "touch") {
      handlers.hover(null);
    }
  });
  on("contextmenu", (event) => event.preventDefault());
  on("wheel", (event) => {
    event.preventDefault();
    const factor = wheelFactor(event.deltaY || event.deltaX, event.deltaMode, event.ctrlKey);
    if (event.altKey) {
      handlers.widen(factor);
      return;
    }
    const bounds = canvas.getBoundingClientRect();
    handlers.gesture({ kind: "zoom", factor, x: event.clientX - bounds.left, y: event.clientY - bounds.top });
  });
  // Safari's own pinch and its double-tap zoom would move the page under the canvas.
  for (const kind of ["gesturestart", "gesturechange"]) {
    document.addEventListener(kind, (event) => event.preventDefault(), { signal: stop.signal, passive: false });
  }
  on("touchstart", (event) => event.preventDefault());
  on("touchmove", (event) => event.preventDefault());

  return () => {
    stop.abort();
    clearTimeout(timer);
  };
}
