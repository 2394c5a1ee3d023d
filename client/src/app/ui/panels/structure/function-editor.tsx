import { useRef, useState } from "preact/hooks";
import type { Points } from "../../../document/design/design-model";
import { numberText } from "../../../words/number-text";
import { say } from "../../../words/say";

const [WIDTH, HEIGHT, EDGE] = [240, 120, 14];
/** How near to a point a finger takes hold of it, in units of the drawing. */
const REACH = 26;
const MOST_POINTS = 16;

interface FunctionEditorProps {
  readonly label: string;
  readonly help: string;
  readonly points: Points;
  /** What would be inherited, where the value is not one of its own. */
  readonly inherited: Points | null;
  readonly result: Points;
  readonly least: number;
  readonly most: number;
  readonly onDrag: (points: Points) => void;
  readonly onCommit: (points: Points) => void;
}

/** A function of the place along an axis: points to move, more of them by a tap, fewer by pulling one out. */
export function FunctionEditor(props: FunctionEditorProps) {
  const { label, help, points, inherited, result, least, most } = props;
  const [held, setHeld] = useState<Points | null>(null);
  const grip = useRef<number | null>(null);
  const shown = held ?? points;
  // The range is wide; what is drawn is what the values need.
  const top = Math.min(most, 1.25 * Math.max(...[...shown, ...result, ...(inherited ?? [])].map(([, y]) => y), 1e-3));
  const bottom = Math.max(least, Math.min(0, ...shown.map(([, y]) => y)));
  const scale = useRef({ top, bottom });
  if (held === null) {
    scale.current = { top, bottom };
  }
  const { top: high, bottom: low } = scale.current;
  const x = (t: number) => EDGE + t * (WIDTH - 2 * EDGE);
  const y = (value: number) => HEIGHT - EDGE - ((value - low) / (high - low)) * (HEIGHT - 2 * EDGE);
  const line = (of: Points) => of.map(([t, value]) => `${x(t)},${y(value)}`).join(" ");

  const place = (event: PointerEvent): readonly [number, number] => {
    const box = (event.currentTarget as SVGSVGElement).getBoundingClientRect();
    const [across, down] = [
      ((event.clientX - box.left) / box.width) * WIDTH,
      ((event.clientY - box.top) / box.height) * HEIGHT,
    ];
    const t = Math.min(Math.max((across - EDGE) / (WIDTH - 2 * EDGE), 0), 1);
    const value = low + ((HEIGHT - EDGE - down) / (HEIGHT - 2 * EDGE)) * (high - low);
    return [round(t), round(Math.min(Math.max(value, least), most))];
  };
  const near = ([t, value]: readonly [number, number]) => {
    const distances = shown.map(([px, py]) => Math.hypot(x(px) - x(t), y(py) - y(value)));
    const nearest = Math.min(...distances);
    return nearest < REACH ? distances.indexOf(nearest) : null;
  };
  const moved = (at: number, [t, value]: readonly [number, number]): Points => {
    const [before, after] = [shown[at - 1]?.[0], shown[at + 1]?.[0]];
    // The ends stay at the ends.
    const within =
      before === undefined ? 0 : after === undefined ? 1 : Math.min(Math.max(t, before + 0.02), after - 0.02);
    return shown.map((point, index) => (index === at ? ([within, value] as const) : point));
  };
  return (
    <div class="structure-function">
      <div class="structure-label" title={help}>
        {label}
      </div>
      <svg
        class="structure-canvas"
        viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
        role="application"
        aria-label={say("structure.function", { parameter: label })}
        onPointerDown={(event) => {
          event.currentTarget.setPointerCapture(event.pointerId);
          const to = place(event);
          const found = near(to);
          if (found !== null) {
            grip.current = found;
            setHeld(shown);
          } else if (shown.length < MOST_POINTS) {
            const at = shown.findIndex(([t]) => t > to[0]);
            const next = [...shown.slice(0, at), to, ...shown.slice(at)];
            grip.current = at;
            setHeld(next);
            props.onDrag(next);
          }
        }}
        onPointerMove={(event) => {
          if (grip.current !== null) {
            const next = moved(grip.current, place(event));
            setHeld(next);
            props.onDrag(next);
          }
        }}
        onPointerUp={() => {
          if (grip.current !== null && held) {
            grip.current = null;
            setHeld(null);
            props.onCommit(held);
          }
        }}
        onPointerCancel={() => {
          grip.current = null;
          setHeld(null);
        }}
        onDblClick={(event) => {
          const found = near(place(event as unknown as PointerEvent));
          if (found !== null && found > 0 && found < shown.length - 1) {
            props.onCommit(shown.filter((_, index) => index !== found));
          }
        }}
      >
        <rect x={EDGE} y={EDGE} width={WIDTH - 2 * EDGE} height={HEIGHT - 2 * EDGE} class="structure-grid" />
        {inherited && <polyline points={line(inherited)} class="structure-inherited" />}
        {inherited && <polyline points={line(result)} class="structure-result" />}
        <polyline points={line(shown)} class={inherited ? "structure-local" : "structure-result"} />
        {shown.map(([t, value]) => (
          <circle key={t} cx={x(t)} cy={y(value)} r={7} class="structure-point" />
        ))}
        <text x={EDGE + 3} y={EDGE + 10}>
          {numberText(high, 0.01)}
        </text>
      </svg>
    </div>
  );
}

function round(value: number): number {
  return Math.round(value * 1000) / 1000;
}
