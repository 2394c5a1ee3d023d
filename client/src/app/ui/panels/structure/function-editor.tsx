import { useRef } from "preact/hooks";
import type { Points } from "../../../document/design/design-model";
import { valueAt, valuesOf } from "../../../document/design/function-course";
import { numberText } from "../../../words/number-text";
import { say } from "../../../words/say";
import { type Place, PointField } from "./point-field";

const [WIDTH, HEIGHT, EDGE] = [240, 120, 14];
const MOST_POINTS = 16;
/** Two points are at least so far apart along the axis. */
const APART = 0.02;
const STEPS = 48;
const PLACES = Array.from({ length: STEPS + 1 }, (_, step) => step / STEPS);

interface FunctionEditorProps {
  readonly label: string;
  readonly help: string;
  readonly points: Points;
  /** What would be inherited, where the value is said relative to it. */
  readonly inherited: Points | null;
  /** Whether it is a factor, which has another scale than what it is a factor of. */
  readonly isFactor: boolean;
  readonly result: Points;
  readonly least: number;
  readonly most: number;
  /** What is drawn of the range at least. */
  readonly usual: readonly [number, number];
  readonly onDrag: (points: Points) => void;
  readonly onCommit: (points: Points) => void;
  readonly onCancel: () => void;
}

/**
 * A function of the place along an axis. Said as a whole it is one curve; said relative to what is inherited, that one is
 * thin, what is said of it dashed, and what comes of both bold.
 */
export function FunctionEditor(props: FunctionEditorProps) {
  const { label, help, points, inherited, result, isFactor, least, most, usual } = props;
  // The range is wide; what is drawn is what the values need, and stays while a finger is on it.
  const range = useRef({ top: 1, bottom: 0, isHeld: false });
  if (!range.current.isHeld) {
    const all = [...points, ...(isFactor ? [] : [...result, ...(inherited ?? [])])].map(([, value]) => value);
    range.current.bottom = Math.max(least, Math.min(usual[0], 0, 1.25 * Math.min(...all)));
    range.current.top = Math.min(most, Math.max(usual[1], 1.25 * Math.max(...all)));
  }
  const { top, bottom } = range.current;
  const x = (t: number) => EDGE + t * (WIDTH - 2 * EDGE);
  const y = (value: number) => HEIGHT - EDGE - ((value - bottom) / (top - bottom)) * (HEIGHT - 2 * EDGE);
  const back = ([across, down]: Place): readonly [number, number] => {
    const value = bottom + ((HEIGHT - EDGE - down) / (HEIGHT - 2 * EDGE)) * (top - bottom);
    return [
      round(clamp((across - EDGE) / (WIDTH - 2 * EDGE), 0, 1)),
      round(clamp(value, Math.max(least, bottom), Math.min(most, top))),
    ];
  };
  const highest = Math.max(...[...result, ...(inherited ?? [])].map(([, value]) => value), 1e-3);
  const line = (of: Points, scale = 1) =>
    valuesOf(of, PLACES)
      .map((value, step) => `${x(step / STEPS).toFixed(1)},${y(scale * value).toFixed(1)}`)
      .join(" ");
  // Where the scale is that of factors, what is inherited fills the lower half.
  const valueScale = isFactor ? (0.5 * top) / highest : 1;
  const middle = round(valueAt(points, 0.5));
  return (
    <div class="structure-function">
      <div class="structure-label" title={help}>
        {label}
      </div>
      <PointField
        label={say("structure.function", { parameter: label })}
        size={[WIDTH, HEIGHT]}
        value={points}
        places={(of) => of.map(([t, value]): Place => [x(t), y(value)])}
        moved={(of, at, to) => moved(of, at, back(to))}
        added={(of, to) => added(of, back(to))}
        without={(of, at) => (at > 0 && at < of.length - 1 ? of.filter((_, index) => index !== at) : null)}
        onDrag={props.onDrag}
        onCommit={props.onCommit}
        onCancel={props.onCancel}
        onHold={(holds) => {
          range.current.isHeld = holds;
        }}
      >
        {(shown) => (
          <>
            <rect x={EDGE} y={EDGE} width={WIDTH - 2 * EDGE} height={HEIGHT - 2 * EDGE} class="structure-grid" />
            {bottom < 0 && <line x1={x(0)} x2={x(1)} y1={y(0)} y2={y(0)} class="structure-grid" />}
            {inherited && <polyline points={line(inherited, valueScale)} class="structure-inherited" />}
            {inherited && <polyline points={line(result, valueScale)} class="structure-result" />}
            <polyline points={line(shown)} class={inherited ? "structure-local" : "structure-result"} />
            <text x={EDGE + 3} y={EDGE + 10}>
              {numberText(top, 0.01)}
            </text>
            <text x={EDGE + 3} y={HEIGHT - EDGE - 3}>
              {numberText(bottom, 0.01)}
            </text>
          </>
        )}
      </PointField>
      {inherited && <p class="structure-legend">{say("structure.function.relative")}</p>}
      <div class="structure-row">
        <button
          type="button"
          onClick={() =>
            props.onCommit([
              [0, middle],
              [1, middle],
            ])
          }
        >
          {say("structure.function.even")}
        </button>
        <button
          type="button"
          onClick={() => props.onCommit([...points].reverse().map(([t, value]) => [round(1 - t), value]))}
        >
          {say("structure.mirror")}
        </button>
      </div>
    </div>
  );
}

/** The ends stay at the ends, and no point passes another. */
function moved(points: Points, at: number, [t, value]: readonly [number, number]): Points {
  const [before, after] = [points[at - 1]?.[0], points[at + 1]?.[0]];
  const within = before === undefined ? 0 : after === undefined ? 1 : clamp(t, before + APART, after - APART);
  return points.map((point, index) => (index === at ? [round(within), value] : point));
}

function added(points: Points, to: readonly [number, number]) {
  const at = points.findIndex(([t]) => t > to[0]);
  const [before, after] = [points[at - 1]?.[0] ?? 0, points[at]?.[0] ?? 1];
  if (at < 1 || points.length >= MOST_POINTS || after - before < 2 * APART) {
    return null;
  }
  return { value: moved([...points.slice(0, at), to, ...points.slice(at)], at, to), at };
}

function clamp(value: number, least: number, most: number): number {
  return Math.min(Math.max(value, least), most);
}

function round(value: number): number {
  return Math.round(value * 1000) / 1000;
}
