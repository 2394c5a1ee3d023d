import { useRef, useState } from "preact/hooks";
import { AxisCurve } from "../../../../scene/structure/axis-curve";
import { added, type Curve, mirrored, moved, STRAIGHT, without } from "../../../document/design/curve-points";
import { say } from "../../../words/say";
import { type Place, PointField } from "./point-field";

const [WIDTH, HEIGHT, EDGE] = [240, 240, 26];
/** At least so much of the plane is seen, in lengths of the chord. */
const LEAST_SPAN = 1.15;

interface CurveEditorProps {
  readonly label: string;
  readonly help: string;
  readonly value: Curve;
  /** The course that would be inherited, where the branch has one of its own. */
  readonly inherited: Curve | null;
  readonly onDrag: (value: Curve) => void;
  readonly onCommit: (value: Curve) => void;
  readonly onCancel: () => void;
}

/** What of the plane is drawn. */
interface Window {
  readonly across: number;
  readonly up: number;
  readonly unit: number;
}

/** The course of an axis in one of the two planes that it stands in: across, or deep. Its ends stay where they are. */
export function CurveEditor(props: CurveEditorProps) {
  const { label, help, value, inherited } = props;
  const [side, setSide] = useState<0 | 2>(0);
  const view = useRef<{ readonly window: Window; readonly side: 0 | 2; readonly isHeld: boolean } | null>(null);
  if (!view.current?.isHeld) {
    const all = [...value, ...(inherited ?? [])];
    const [former, fit] = [view.current?.side === side ? view.current.window : null, windowOn(all, side)];
    // What a finger has just let go stays where it is, as long as there is room.
    const stays = former !== null && fit.unit < 2 * former.unit && all.every((point) => isIn(former, point, side));
    view.current = { window: stays ? former : fit, side, isHeld: false };
  }
  const { across, up, unit } = view.current.window;
  const draw = (point: readonly [number, number, number]): Place => [
    WIDTH / 2 + (point[side] - across) * unit,
    HEIGHT / 2 - (point[1] - up) * unit,
  ];
  const line = (of: Curve) =>
    new AxisCurve(of).places
      .map(draw)
      .map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`)
      .join(" ");
  const back = ([x, y]: Place): Place => [across + (x - WIDTH / 2) / unit, up - (y - HEIGHT / 2) / unit];
  return (
    <div class="structure-curve">
      <div class="structure-label" title={help}>
        {label}
      </div>
      <div class="structure-row">
        {([0, 2] as const).map((which) => (
          <button type="button" key={which} aria-pressed={side === which} onClick={() => setSide(which)}>
            {say(which === 0 ? "structure.outline.front" : "structure.outline.side")}
          </button>
        ))}
      </div>
      <PointField
        key={side}
        label={say("structure.curve", { parameter: label })}
        size={[WIDTH, HEIGHT]}
        value={value}
        places={(of) => of.map(draw)}
        moved={(of, at, to) => moved(of, at, side, back(to))}
        added={(of, to) => added(of, side, back(to))}
        without={without}
        onDrag={props.onDrag}
        onCommit={props.onCommit}
        onCancel={props.onCancel}
        buttons={
          <>
            <button type="button" onClick={() => props.onCommit(STRAIGHT)}>
              {say("structure.curve.straight")}
            </button>
            <button type="button" onClick={() => props.onCommit(mirrored(value, side))}>
              {say("structure.mirror")}
            </button>
          </>
        }
        onHold={(isHeld) => {
          view.current = view.current && { ...view.current, isHeld };
        }}
      >
        {(shown) => (
          <>
            <line
              x1={draw([0, 0, 0])[0]}
              y1={draw([0, 0, 0])[1]}
              x2={draw([0, 1, 0])[0]}
              y2={draw([0, 1, 0])[1]}
              class="structure-chord"
            />
            {inherited && <polyline points={line(inherited)} class="structure-inherited" />}
            <polyline points={line(shown)} class="structure-result" />
          </>
        )}
      </PointField>
    </div>
  );
}

function isIn({ across, up, unit }: Window, point: readonly [number, number, number], side: 0 | 2): boolean {
  const within = (off: number, length: number) => Math.abs(off) * unit < length / 2 - EDGE / 3;
  return within(point[side] - across, WIDTH) && within(point[1] - up, HEIGHT);
}

/** The part of the plane in which all points lie, with room about them. */
function windowOn(points: Curve, side: 0 | 2): Window {
  const bounds = (part: 0 | 1 | 2) => {
    const all = points.map((point) => point[part]);
    return [Math.min(...all), Math.max(...all)] as const;
  };
  const [[left, right], [low, high]] = [bounds(side), bounds(1)];
  const span = Math.max(LEAST_SPAN, right - left, high - low);
  return { across: (left + right) / 2, up: (low + high) / 2, unit: (WIDTH - 2 * EDGE) / span };
}
