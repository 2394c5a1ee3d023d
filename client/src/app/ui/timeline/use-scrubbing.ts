import { useEffect, useRef, useState } from "preact/hooks";
import type { Studio } from "../../studio";

/** How far a finger wanders before it pulls the playhead and is no tap, in pixels. */
const SLOP = 4;
/** A finger that lands so near to the playhead takes hold of it where it is. */
const GRASP = 24;
/** A finger so far above the strip pulls slowly, so that single steps can be met. */
const FINE_FROM = 56;
const FINE = 0.2;
/** A finger that rests so long, in milliseconds, looks at what was done there, and goes nowhere. */
const RESTS = 400;
/** How long the description of what was touched stays, in milliseconds. */
const LINGERS = 1600;
/** And that of what a finger has rested on, with names to read. */
const READ = 4000;

interface Pull {
  readonly id: number;
  readonly from: number;
  /** When the finger came down, by the clock of the events. */
  readonly since: number;
  x: number;
  place: number;
  moved: boolean;
  /** Whether it rests on what was done, to look at it. */
  looks: boolean;
}

/** What the user does on the strip: it pulls the playhead, taps an operation, or only looks at one. */
export function useScrubbing(studio: Studio, track: { readonly current: HTMLElement | null }) {
  const pull = useRef<Pull | null>(null);
  const timer = useRef(0);
  const rest = useRef(0);
  const [place, setPlace] = useState<number | null>(null);
  const [looked, setLooked] = useState<number | null>(null);
  const [shown, setShown] = useState(false);
  const { time } = studio;
  const forget = () => {
    clearTimeout(timer.current);
    clearTimeout(rest.current);
  };
  useEffect(() => forget, []);

  const linger = (long = LINGERS) => {
    setShown(true);
    clearTimeout(timer.current);
    timer.current = window.setTimeout(() => {
      if (pull.current?.looks) {
        linger(READ);
        return;
      }
      setShown(false);
      if (long === READ) {
        setLooked(null);
      }
    }, long);
  };
  const operationUnder = (x: number) =>
    time.timeline.peek() === null ? null : time.scale.peek().operationAt(placeAt(x));
  const placeAt = (x: number) => {
    const bounds = track.current?.getBoundingClientRect();
    return bounds ? Math.min(1, Math.max(0, (x - bounds.left) / bounds.width)) : 0;
  };
  const down = (event: PointerEvent) => {
    if (pull.current !== null || event.button !== 0) {
      return;
    }
    track.current?.setPointerCapture(event.pointerId);
    const head = time.scale.peek().placeOf(time.step);
    const at = placeAt(event.clientX);
    const width = track.current?.clientWidth ?? 1;
    const grasped = Math.abs(at - head) * width < GRASP;
    pull.current = {
      id: event.pointerId,
      from: event.clientX,
      since: event.timeStamp,
      x: event.clientX,
      place: grasped ? head : at,
      moved: false,
      looks: false,
    };
    setLooked(null);
    linger();
    rests(pull.current, performance.now());
  };
  const rests = (held: Pull, since: number) => {
    clearTimeout(rest.current);
    rest.current = window.setTimeout(() => {
      if (pull.current !== held || held.moved) {
        return;
      }
      if (performance.now() - since < RESTS) {
        rests(held, since);
        return;
      }
      held.looks = true;
      setLooked(operationUnder(held.x));
      linger(READ);
    }, RESTS);
  };
  const move = (event: PointerEvent) => {
    const held = pull.current;
    if (!held) {
      if (event.pointerType !== "touch") {
        setLooked(operationUnder(event.clientX));
      }
      return;
    }
    const bounds = track.current?.getBoundingClientRect();
    if (event.pointerId !== held.id || !bounds) {
      return;
    }
    held.moved ||= Math.abs(event.clientX - held.from) > SLOP;
    if (!held.moved) {
      return;
    }
    held.looks = false;
    setLooked(null);
    const speed = bounds.top - event.clientY > FINE_FROM ? FINE : 1;
    held.place = Math.min(1, Math.max(0, held.place + (speed * (event.clientX - held.x)) / bounds.width));
    held.x = event.clientX;
    setPlace(held.place);
    time.pull(time.scale.peek().stepAt(held.place));
    linger();
  };
  const up = (event: PointerEvent) => {
    const held = pull.current;
    if (held?.id !== event.pointerId) {
      return;
    }
    pull.current = null;
    setPlace(null);
    time.release();
    clearTimeout(rest.current);
    // By the clock of the events: a page that was busy may have looked after a tap.
    if (held.looks && event.timeStamp - held.since >= RESTS) {
      linger(READ);
      return;
    }
    setLooked(null);
    const operation = time.timeline.peek()?.operations[time.scale.peek().operationAt(placeAt(event.clientX))];
    if (!held.moved && event.type === "pointerup" && operation) {
      // A tap goes to where the operation was done; there already, to where it began.
      time.to(time.step === operation.last ? operation.first : operation.last);
    }
    linger();
  };
  const key = (event: KeyboardEvent) => {
    const acts: Record<string, () => void> = {
      ArrowLeft: () => time.by(-1),
      ArrowDown: () => time.by(-1),
      ArrowRight: () => time.by(1),
      ArrowUp: () => time.by(1),
      PageDown: () => time.toEdge(-1),
      PageUp: () => time.toEdge(1),
      Home: () => time.to(0),
      End: () => time.to(time.timeline.peek()?.last_step ?? 0),
    };
    const act = acts[event.key];
    if (act) {
      event.preventDefault();
      act();
      linger();
    }
  };
  const handlers = {
    onPointerDown: down,
    onPointerMove: move,
    onPointerUp: up,
    onPointerCancel: up,
    onLostPointerCapture: up,
    onPointerLeave: ({ pointerType }: PointerEvent) => pointerType !== "touch" && setLooked(null),
    onKeyDown: key,
    // A finger that rests asks for no menu.
    onContextMenu: (event: Event) => event.preventDefault(),
  };
  return { place, looked, shown, handlers };
}
