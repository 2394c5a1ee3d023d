import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { numberText, onStep, unitText } from "../../words/number-text";

interface PolarProps {
  readonly label: string;
  readonly least: number;
  readonly most: number;
  readonly step: number;
  readonly unit: string;
  readonly value: number;
  /** Goes on from its most to its least. */
  readonly wraps?: boolean;
  /** What a place on the drawing means: x to the right and y down, from −1 to 1 across it; null for nothing. */
  readonly valueAt: (x: number, y: number) => number | null;
  readonly onDrag: (value: number) => void;
  readonly onCommit: (value: number) => void;
  /** The drawing, which is square. */
  readonly children: ComponentChildren;
}

/** A number that is set by pulling at something that turns. */
export function Polar(props: PolarProps) {
  const { label, least, most, step, unit, value, wraps = false, children } = props;
  const open = useRef<number | null>(null);
  const latest = useRef(props);
  latest.current = props;

  const drag = (to: number) => {
    const span = most - least;
    const within = wraps ? least + ((((to - least) % span) + span) % span) : to;
    open.current = onStep(within, least, most, step);
    latest.current.onDrag(open.current);
  };
  const commit = () => {
    const to = open.current;
    if (to !== null) {
      open.current = null;
      latest.current.onCommit(to);
    }
  };
  useEffect(
    () => () => {
      if (open.current !== null) {
        latest.current.onCommit(open.current);
      }
    },
    [],
  );
  const follow = (event: PointerEvent & { readonly currentTarget: HTMLElement }) => {
    const bounds = event.currentTarget.getBoundingClientRect();
    const x = ((event.clientX - bounds.left) / bounds.width) * 2 - 1;
    const y = ((event.clientY - bounds.top) / bounds.height) * 2 - 1;
    const to = props.valueAt(x, y);
    if (to !== null) {
      drag(to);
    }
  };
  return (
    <div
      class="polar"
      role="slider"
      tabIndex={0}
      aria-label={label}
      aria-valuemin={least}
      aria-valuemax={most}
      aria-valuenow={Math.round(value)}
      aria-valuetext={`${numberText(value, step)}${unitText(unit)}`}
      onPointerDown={(event) => {
        if (event.button === 0) {
          event.currentTarget.setPointerCapture(event.pointerId);
          follow(event);
        }
      }}
      onPointerMove={(event) => {
        if (event.currentTarget.hasPointerCapture(event.pointerId)) {
          follow(event);
        }
      }}
      onPointerUp={commit}
      onPointerCancel={commit}
      onKeyDown={(event) => {
        const notches = NOTCHES[event.key];
        if (notches !== undefined) {
          event.preventDefault();
          drag((open.current ?? value) + notches * step);
        } else if (event.key === "Home" || event.key === "End") {
          event.preventDefault();
          drag(event.key === "Home" ? least : most - (wraps ? step : 0));
        }
      }}
      onKeyUp={commit}
      onBlur={commit}
    >
      {children}
    </div>
  );
}

/** So many steps a key goes. */
const NOTCHES: Record<string, number> = {
  ArrowUp: 1,
  ArrowRight: 1,
  ArrowDown: -1,
  ArrowLeft: -1,
  PageUp: 10,
  PageDown: -10,
};
