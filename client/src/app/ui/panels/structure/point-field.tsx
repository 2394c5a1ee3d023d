import type { ComponentChildren } from "preact";
import { useRef, useState } from "preact/hooks";
import { say } from "../../../words/say";

/** A place in the drawing, in its units. */
export type Place = readonly [x: number, y: number];

/** How near to a point a finger takes hold of it, in units of the drawing. */
const REACH = 26;
/** So far beside the drawing a point that is pulled out is taken away. */
const OUT = 22;
/** So far a finger wanders that only taps. */
const TAP = 4;
/** How far an arrow key moves a point. */
const KEY_STEP = 6;
const ARROWS: Readonly<Record<string, Place>> = {
  ArrowLeft: [-KEY_STEP, 0],
  ArrowRight: [KEY_STEP, 0],
  ArrowUp: [0, -KEY_STEP],
  ArrowDown: [0, KEY_STEP],
};

interface PointFieldProps<Value> {
  readonly label: string;
  readonly size: Place;
  readonly value: Value;
  readonly places: (value: Value) => readonly Place[];
  /** The value with a point elsewhere, as near to there as it may be. */
  readonly moved: (value: Value, at: number, to: Place) => Value;
  /** The value with one point more; nothing where it has no room for it. */
  readonly added: (value: Value, to: Place) => { readonly value: Value; readonly at: number } | null;
  /** The value with a point less; nothing where that one stays. */
  readonly without: (value: Value, at: number) => Value | null;
  readonly onDrag: (value: Value) => void;
  readonly onCommit: (value: Value) => void;
  /** What was dragged is to be as it was. */
  readonly onCancel: () => void;
  /** Tells when a finger comes down, and when it has gone. */
  readonly onHold?: (holds: boolean) => void;
  /** What changes all points at once. */
  readonly buttons: ComponentChildren;
  /** What is drawn beneath the points; `at` is the point that is held or was picked last. */
  readonly children: (shown: Value, at: number | null) => ComponentChildren;
}

/** A finger on the drawing. */
interface Grip<Value> {
  readonly pointer: number;
  readonly from: Place;
  readonly before: Value;
  /** The point that it holds, and whether it came with it. */
  readonly at: number;
  readonly isNew: boolean;
  hasMoved: boolean;
  /** Whether it was pulled out of the drawing. */
  isOut: boolean;
  /** What is to be once it goes. */
  value: Value;
}

/**
 * Points in a drawing: dragged, added by a tap, taken away by pulling them out, by a double tap or by a button. One
 * gesture is one deed, and a second finger lets everything be as it was.
 */
export function PointField<Value>(props: PointFieldProps<Value>) {
  const { size, value, places, without } = props;
  const [held, setHeld] = useState<{ readonly value: Value; readonly isOut: boolean } | null>(null);
  const [picked, setPicked] = useState<number | null>(null);
  const grip = useRef<Grip<Value> | null>(null);
  /** Whether the last tap made a point: a second one at once does not take it away. */
  const hasAdded = useRef(false);
  const shown = held?.value ?? value;
  const points = places(shown);
  const [width, height] = size;

  const placeOf = (event: MouseEvent): Place => {
    const box = (event.currentTarget as SVGSVGElement).getBoundingClientRect();
    return [((event.clientX - box.left) / box.width) * width, ((event.clientY - box.top) / box.height) * height];
  };
  const near = (to: Place): number | null => {
    const far = points.map((point) => apart(point, to));
    const least = Math.min(...far);
    return least < REACH ? far.indexOf(least) : null;
  };
  const take = (event: PointerEvent, at: number, to: Value, isNew: boolean) => {
    (event.currentTarget as Element).setPointerCapture(event.pointerId);
    const from = placeOf(event);
    grip.current = {
      pointer: event.pointerId,
      from,
      before: value,
      at,
      isNew,
      hasMoved: isNew,
      isOut: false,
      value: to,
    };
    setPicked(at);
    setHeld({ value: to, isOut: false });
    props.onHold?.(true);
  };
  const letGo = () => {
    const last = grip.current;
    grip.current = null;
    setHeld(null);
    props.onHold?.(false);
    return last;
  };
  const cancel = () => {
    if (letGo()?.hasMoved) {
      setPicked(null);
      props.onCancel();
    }
  };
  const down = (event: PointerEvent) => {
    if (grip.current !== null) {
      cancel();
      return;
    }
    const to = placeOf(event);
    const found = near(to);
    hasAdded.current = found === null;
    if (found !== null) {
      take(event, found, value, false);
      return;
    }
    const added = props.added(value, to);
    if (added) {
      take(event, added.at, added.value, true);
      props.onDrag(added.value);
    }
  };
  const move = (event: PointerEvent) => {
    const now = grip.current;
    if (now?.pointer !== event.pointerId) {
      return;
    }
    const to = placeOf(event);
    now.hasMoved ||= apart(to, now.from) > TAP;
    if (!now.hasMoved) {
      return;
    }
    const isOut = Math.max(-to[0], to[0] - width, -to[1], to[1] - height) > OUT;
    const base = now.isNew ? (props.added(now.before, now.from)?.value ?? now.before) : now.before;
    const fewer = isOut ? (now.isNew ? now.before : without(now.before, now.at)) : null;
    now.isOut = fewer !== null;
    now.value = fewer ?? props.moved(base, now.at, to);
    setHeld({ value: now.value, isOut: now.isOut });
    props.onDrag(now.value);
  };
  const up = (event: PointerEvent) => {
    if (grip.current?.pointer !== event.pointerId) {
      return;
    }
    const last = letGo();
    if (last?.hasMoved) {
      setPicked(last.isOut ? null : last.at);
      props.onCommit(last.value);
    }
  };
  const remove = (at: number) => {
    const fewer = without(value, at);
    if (fewer) {
      setPicked(null);
      props.onCommit(fewer);
    }
  };
  const key = (event: KeyboardEvent, at: number, [x, y]: Place) => {
    const by = ARROWS[event.key];
    if (by) {
      event.preventDefault();
      event.stopPropagation();
      props.onCommit(props.moved(value, at, [x + by[0], y + by[1]]));
    } else if (event.key === "Delete" || event.key === "Backspace") {
      remove(at);
    }
  };
  const isPicked = picked !== null && picked < points.length && held?.isOut !== true;
  return (
    <>
      {/* biome-ignore lint/a11y/useSemanticElements: a drawing is no fieldset. */}
      <svg
        class="structure-canvas"
        viewBox={`0 0 ${width} ${height}`}
        role="group"
        aria-label={props.label}
        data-out={held?.isOut === true}
        onPointerDown={down}
        onPointerMove={move}
        onPointerUp={up}
        onPointerCancel={cancel}
        onDblClick={(event) => {
          const found = near(placeOf(event));
          if (found !== null && !hasAdded.current) {
            remove(found);
          }
        }}
      >
        {props.children(shown, isPicked ? picked : null)}
        {points.map((place, at) => (
          // biome-ignore lint/a11y/useSemanticElements: there are no buttons in drawings.
          <circle
            key={at}
            cx={place[0]}
            cy={place[1]}
            r={7}
            class="structure-point"
            data-picked={isPicked && at === picked}
            role="button"
            tabIndex={0}
            aria-label={say("structure.point", { number: at + 1 })}
            onFocus={() => setPicked(at)}
            onKeyDown={(event) => key(event, at, place)}
          />
        ))}
      </svg>
      <div class="structure-row">
        {props.buttons}
        <button
          type="button"
          disabled={!isPicked || without(value, picked) === null || held !== null}
          onClick={() => picked !== null && remove(picked)}
        >
          {say("structure.point.without")}
        </button>
      </div>
    </>
  );
}

function apart(a: Place, b: Place): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}
