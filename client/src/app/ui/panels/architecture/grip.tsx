import { useEffect, useRef } from "preact/hooks";
import type { Place } from "./place";

interface GripProps {
  readonly label: string;
  /** The value in words, with its unit. */
  readonly text: string;
  readonly value: number;
  readonly least: number;
  readonly most: number;
  /** What an arrow key changes. */
  readonly step: number;
  /** Where it is, in pixels of its diagram. */
  readonly at: Place;
  readonly disabled?: boolean;
  /** Marks the sign on it: along which way it goes. */
  readonly way?: "any" | "level" | "upright" | "around";
  /** The user pulls it to a place. */
  readonly onPull: (to: Place) => void;
  /** A key sets the value. */
  readonly onValue: (value: number) => void;
  /** Arrow keys move it in the plane instead: steps to the right and up. */
  readonly onArrows?: (right: number, up: number) => void;
  /** The user has let go. */
  readonly onRelease: () => void;
}

const FAST = 10;

/** A knob in a diagram, to be pulled with a finger, a pen, a mouse or keys. */
export function Grip(props: GripProps) {
  const { label, text, value, least, most, step, at, disabled = false, way = "any" } = props;
  /** The pointer that holds it, and by how much it missed the knob's middle. */
  const held = useRef<{ readonly pointer: number; readonly dx: number; readonly dy: number } | null>(null);
  const keyed = useRef(false);
  const latest = useRef(props);
  latest.current = props;
  // What is taken away under the pointer is let go.
  useEffect(
    () => () => {
      if (held.current !== null || keyed.current) {
        latest.current.onRelease();
      }
    },
    [],
  );

  const placeIn = (event: PointerEvent & { readonly currentTarget: HTMLElement }): Place | null => {
    const bounds = event.currentTarget.parentElement?.getBoundingClientRect();
    return bounds ? { x: event.clientX - bounds.left, y: event.clientY - bounds.top } : null;
  };
  const release = (event: PointerEvent) => {
    if (held.current?.pointer === event.pointerId) {
      held.current = null;
      props.onRelease();
    }
  };
  const releaseKeys = () => {
    if (keyed.current) {
      keyed.current = false;
      props.onRelease();
    }
  };
  const onKeyDown = (event: KeyboardEvent) => {
    const by = event.shiftKey ? FAST : 1;
    const arrows: Record<string, readonly [number, number]> = {
      ArrowRight: [by, 0],
      ArrowLeft: [-by, 0],
      ArrowUp: [0, by],
      ArrowDown: [0, -by],
      PageUp: [0, FAST],
      PageDown: [0, -FAST],
    };
    const [right, up] = arrows[event.key] ?? [0, 0];
    if (right !== 0 || up !== 0) {
      props.onArrows
        ? props.onArrows(right, up)
        : props.onValue(Math.min(most, Math.max(least, value + (right + up) * step)));
    } else if (event.key === "Home" || event.key === "End") {
      props.onValue(event.key === "Home" ? least : most);
    } else {
      return;
    }
    keyed.current = true;
    event.preventDefault();
  };

  return (
    <div
      class="grip"
      role="slider"
      tabIndex={disabled ? -1 : 0}
      aria-label={label}
      aria-valuemin={least}
      aria-valuemax={most}
      aria-valuenow={value}
      aria-valuetext={text}
      aria-disabled={disabled}
      data-way={way}
      style={{ transform: `translate(${at.x}px, ${at.y}px)` }}
      onPointerDown={(event) => {
        const place = placeIn(event);
        if (!disabled && held.current === null && place && event.button === 0) {
          event.currentTarget.setPointerCapture(event.pointerId);
          held.current = { pointer: event.pointerId, dx: place.x - at.x, dy: place.y - at.y };
        }
      }}
      onPointerMove={(event) => {
        const place = placeIn(event);
        const now = held.current;
        if (now?.pointer === event.pointerId && place) {
          props.onPull({ x: place.x - now.dx, y: place.y - now.dy });
        }
      }}
      onPointerUp={release}
      onPointerCancel={release}
      onLostPointerCapture={release}
      onKeyDown={onKeyDown}
      onKeyUp={releaseKeys}
      onBlur={releaseKeys}
    >
      <i aria-hidden="true" />
    </div>
  );
}
