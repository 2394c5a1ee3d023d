import { useRef } from "preact/hooks";
import { combinedCourse, MOST_POINTS, type Points, valueAt, valuesOf } from "../../../document/design/function-course";
import {
  type Drawn,
  type Extent,
  type Extents,
  extentOf,
  relativeExtents,
} from "../../../document/design/function-extents";
import { NEUTRAL, type Relation, withRelative } from "../../../document/design/relative-values";
import { numberText, unitText } from "../../../words/number-text";
import { say } from "../../../words/say";
import { type Place, PointField } from "./point-field";

const [WIDTH, HEIGHT] = [240, 132];
/** Around what is drawn: numbers stand beside it, and what a point says above it. */
const [ABOVE, BELOW, BESIDE] = [20, 14, 38];
/** A point at an end of the axis covers none of them. */
const PAST_POINT = 9;
/** Two points are at least so far apart along the axis. */
const APART = 0.02;
const STEPS = 48;
const PLACES = Array.from({ length: STEPS + 1 }, (_, step) => step / STEPS);

interface FunctionEditorProps {
  readonly label: string;
  readonly help: string;
  readonly unit: string;
  /** What is said. */
  readonly own: Drawn;
  /** What it is said relative to, if to anything, and what of the parameter is drawn. */
  readonly relative: {
    readonly relation: Relation;
    readonly inherited: Points;
    readonly of: Omit<Drawn, "points">;
  } | null;
  readonly onDrag: (points: Points) => void;
  readonly onCommit: (points: Points) => void;
  readonly onCancel: () => void;
}

/**
 * A function of the place along an axis. Said as a whole it is one curve; said relative to what is inherited, that one is
 * thin, what is said of it dashed, and what comes of both bold. Signs stand on the side of what is said, and what the
 * branch gets on the other.
 */
export function FunctionEditor({ label, help, unit, own, relative, onDrag, onCommit, onCancel }: FunctionEditorProps) {
  // The range is wide; what is drawn is what the values need, and stays while a finger is on it.
  const held = useRef<Extents | null>(null);
  const extents = held.current ?? extentsOf(own, relative);
  const right = WIDTH - (relative ? BESIDE : BELOW);
  const x = (t: number) => BESIDE + t * (right - BESIDE);
  const up = (value: number, of: keyof Extents) => {
    const { bottom, top } = extents[of];
    return HEIGHT - BELOW - ((value - bottom) / (top - bottom)) * (HEIGHT - ABOVE - BELOW);
  };
  const back = ([across, down]: Place): readonly [number, number] => {
    const { bottom, top } = extents.own;
    const value = bottom + ((HEIGHT - BELOW - down) / (HEIGHT - ABOVE - BELOW)) * (top - bottom);
    const { least, most } = own.range;
    return [
      round(clamp((across - BESIDE) / (right - BESIDE), 0, 1)),
      round(clamp(value, Math.max(least, bottom), Math.min(most, top))),
    ];
  };
  const line = (values: readonly number[], of: keyof Extents) =>
    values.map((value, step) => `${x(step / STEPS).toFixed(1)},${up(value, of).toFixed(1)}`).join(" ");
  const inherited = relative && valuesOf(relative.inherited, PLACES);
  const resultOf = (said: readonly number[]) =>
    relative && said.map((one, at) => withRelative(inherited?.[at] ?? 0, one, relative.of.range, relative.relation));
  const written = (value: number, of: keyof Extents) => {
    const { bottom, top } = extents[of];
    const text = numberText(value, Number.isInteger(value) ? 1 : stepOf(top - bottom));
    if (of === "own" && relative?.relation === "factor") {
      return `×${text}`;
    }
    const sign = of === "own" && relative && !/^[−0.,]*$|^−/.test(text) ? "+" : "";
    return `${sign}${text}${unitText(unit)}`;
  };
  /** What a point says, and what the branch gets there. */
  const said = (points: Points, at: number) => {
    const [t = 0, value = 0] = points[at] ?? [];
    const gets = relative && withRelative(valueAt(relative.inherited, t), value, relative.of.range, relative.relation);
    return say("structure.function.at", {
      percent: Math.round(100 * t),
      value: gets === null ? written(value, "own") : `${written(value, "own")} → ${written(gets, "result")}`,
    });
  };
  const middle = round(valueAt(own.points, 0.5));
  return (
    <div class="structure-function">
      <div class="structure-label" title={help}>
        {label}
      </div>
      <PointField
        label={say("structure.function", { parameter: label })}
        size={[WIDTH, HEIGHT]}
        value={own.points}
        places={(of) => of.map(([t, value]): Place => [x(t), up(value, "own")])}
        moved={(of, at, to) => moved(of, at, back(to))}
        added={(of, to) => added(of, back(to))}
        without={(of, at) => (at > 0 && at < of.length - 1 ? of.filter((_, index) => index !== at) : null)}
        onDrag={onDrag}
        onCommit={onCommit}
        onCancel={onCancel}
        buttons={
          <>
            <button
              type="button"
              onClick={() =>
                onCommit([
                  [0, middle],
                  [1, middle],
                ])
              }
            >
              {say("structure.function.even")}
            </button>
            <button
              type="button"
              onClick={() => onCommit([...own.points].reverse().map(([t, value]) => [round(1 - t), value]))}
            >
              {say("structure.mirror")}
            </button>
          </>
        }
        onHold={(holds) => {
          held.current = holds ? extents : null;
        }}
      >
        {(shown, at) => {
          const values = valuesOf(shown, PLACES);
          const result = resultOf(values);
          return (
            <>
              <rect x={x(0)} y={ABOVE} width={right - BESIDE} height={HEIGHT - ABOVE - BELOW} class="structure-grid" />
              <Scale
                at={x(0) - PAST_POINT}
                anchor="end"
                extent={extents.own}
                neutral={relative ? NEUTRAL[relative.relation] : undefined}
                up={(value) => up(value, "own")}
                written={(value) => written(value, "own")}
              />
              {relative && (
                <>
                  <line
                    x1={x(0)}
                    x2={x(1)}
                    y1={up(NEUTRAL[relative.relation], "own")}
                    y2={up(NEUTRAL[relative.relation], "own")}
                    class="structure-chord"
                  />
                  <Scale
                    at={right + PAST_POINT}
                    anchor="start"
                    extent={extents.result}
                    up={(value) => up(value, "result")}
                    written={(value) => written(value, "result")}
                  />
                </>
              )}
              {inherited && <polyline points={line(inherited, "result")} class="structure-inherited" />}
              {result && <polyline points={line(result, "result")} class="structure-result" />}
              <polyline points={line(values, "own")} class={relative ? "structure-local" : "structure-result"} />
              {at !== null && (
                <text x={right} y={ABOVE - 7} text-anchor="end" class="structure-said">
                  {said(shown, at)}
                </text>
              )}
            </>
          );
        }}
      </PointField>
      {relative && <p class="structure-legend">{say("structure.function.relative")}</p>}
    </div>
  );
}

interface ScaleProps {
  readonly at: number;
  readonly anchor: "start" | "end";
  readonly extent: Extent;
  /** Where between its ends something stands that leaves all as it is. */
  readonly neutral?: number;
  readonly up: (value: number) => number;
  readonly written: (value: number) => string;
}

/** The numbers at the ends of an upright axis, and at what leaves all as it is. */
function Scale({ at, anchor, extent: { bottom, top }, neutral, up, written }: ScaleProps) {
  const marked = neutral === undefined ? [top, bottom] : [top, neutral, bottom];
  return (
    <>
      {marked.map((value) => (
        <text key={value} x={at} y={up(value) + 3} text-anchor={anchor}>
          {written(value)}
        </text>
      ))}
    </>
  );
}

function extentsOf(own: Drawn, relative: FunctionEditorProps["relative"]): Extents {
  if (!relative) {
    const extent = extentOf(own);
    return { own: extent, result: extent };
  }
  const { relation, inherited, of } = relative;
  const result = combinedCourse(inherited, own.points, (a, b) => withRelative(a, b, of.range, relation));
  return relativeExtents(own, { ...of, points: [...inherited, ...result] }, relation);
}

/** A number is written as finely as one can read it off. */
function stepOf(span: number): number {
  if (span > 30) {
    return 1;
  }
  return span > 3 ? 0.1 : 0.01;
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
