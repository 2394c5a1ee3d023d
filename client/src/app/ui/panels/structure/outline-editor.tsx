import { useRef, useState } from "preact/hooks";
import { say } from "../../../words/say";
import { Slider } from "../../controls/slider";

type Vector = readonly [number, number, number];

/** The outline of a branching system, in units of the way from its base to its tip. */
export interface EnvelopeValue {
  readonly top: Vector;
  readonly bottom: Vector;
  /** Towards +x, +z, −x and −z. */
  readonly radii: readonly [number, number, number, number];
  readonly heights: readonly [number, number, number, number];
  readonly upper: number;
  readonly lower: number;
  readonly tip: Vector;
}

/** What a branch has that nobody has said anything of. */
const STANDARD: EnvelopeValue = {
  top: [0, 1, 0],
  bottom: [0, 0, 0],
  radii: [0.35, 0.35, 0.35, 0.35],
  heights: [0.45, 0.45, 0.45, 0.45],
  upper: 2,
  lower: 2,
  tip: [0, 1, 0],
};
const [SIZE, UNIT] = [240, 90];
const REACH = 28;
const STEPS = 24;

type Grip = "top" | "bottom" | "right" | "left";
const GRIPS: readonly Grip[] = ["top", "bottom", "right", "left"];

interface OutlineEditorProps {
  readonly label: string;
  readonly help: string;
  readonly value: EnvelopeValue | null;
  readonly onDrag: (value: EnvelopeValue) => void;
  readonly onCommit: (value: EnvelopeValue) => void;
  /** What was dragged is to be as it was. */
  readonly onCancel: () => void;
}

/** The outline from the front or from the side, with a handle at each end. */
export function OutlineEditor({ label, help, value, onDrag, onCommit, onCancel }: OutlineEditorProps) {
  const [side, setSide] = useState<0 | 1>(0);
  const [held, setHeld] = useState<EnvelopeValue | null>(null);
  const grip = useRef<Grip | null>(null);
  const hasMoved = useRef(false);
  const shown = held ?? value ?? STANDARD;
  const axis = side === 0 ? 0 : 2;
  const x = (across: number) => SIZE / 2 + across * UNIT;
  const y = (up: number) => SIZE - 60 - up * UNIT;
  const at: Record<Grip, readonly [number, number]> = {
    top: [shown.top[axis], shown.top[1]],
    bottom: [shown.bottom[axis], shown.bottom[1]],
    right: [shown.radii[side], shown.heights[side]],
    left: [-shown.radii[(side + 2) as 2 | 3], shown.heights[(side + 2) as 2 | 3]],
  };
  const place = (event: PointerEvent): readonly [number, number] => {
    const box = (event.currentTarget as SVGSVGElement).getBoundingClientRect();
    const [across, down] = [
      ((event.clientX - box.left) / box.width) * SIZE,
      ((event.clientY - box.top) / box.height) * SIZE,
    ];
    return [(across - SIZE / 2) / UNIT, (SIZE - 60 - down) / UNIT];
  };
  const cancel = () => {
    grip.current = null;
    setHeld(null);
    if (hasMoved.current) {
      onCancel();
    }
  };
  const change = (of: Grip, [across, up]: readonly [number, number]) => moved(shown, of, side, across, up);
  const slider = (name: "upper" | "lower") => (
    <Slider
      label={say(`structure.outline.${name}`)}
      help={say(`structure.outline.${name}.help`)}
      least={0.2}
      most={8}
      step={0.1}
      value={shown[name]}
      standard={2}
      onDrag={(number) => onDrag({ ...shown, [name]: number })}
      onCommit={(number) => onCommit({ ...shown, [name]: number })}
    />
  );
  return (
    <div class="structure-outline">
      <div class="structure-label" title={help}>
        {label}
      </div>
      <div class="structure-row">
        {([0, 1] as const).map((which) => (
          <button type="button" key={which} aria-pressed={side === which} onClick={() => setSide(which)}>
            {say(which === 0 ? "structure.outline.front" : "structure.outline.side")}
          </button>
        ))}
      </div>
      <svg
        class="structure-canvas"
        viewBox={`0 0 ${SIZE} ${SIZE}`}
        role="application"
        aria-label={say("structure.outline")}
        onPointerDown={(event) => {
          if (grip.current) {
            // A second finger.
            cancel();
            return;
          }
          hasMoved.current = false;
          const [across, up] = place(event);
          const far = (of: Grip) => Math.hypot(x(at[of][0]) - x(across), y(at[of][1]) - y(up));
          const nearest = GRIPS.reduce((one, other) => (far(other) < far(one) ? other : one));
          if (far(nearest) < REACH) {
            event.currentTarget.setPointerCapture(event.pointerId);
            grip.current = nearest;
            setHeld(shown);
          }
        }}
        onPointerMove={(event) => {
          if (grip.current) {
            const next = change(grip.current, place(event));
            hasMoved.current ||= next !== shown;
            setHeld(next);
            onDrag(next);
          }
        }}
        onPointerUp={() => {
          if (grip.current && held) {
            grip.current = null;
            setHeld(null);
            if (hasMoved.current) {
              onCommit(held);
            }
          }
        }}
        onPointerCancel={cancel}
      >
        <path d={outline(shown, side, x, y)} class="structure-hull" />
        <line x1={x(0)} y1={y(0)} x2={x(shown.tip[axis])} y2={y(shown.tip[1])} class="structure-axis" />
        {GRIPS.map((of) => (
          <circle key={of} cx={x(at[of][0])} cy={y(at[of][1])} r={8} class="structure-point" />
        ))}
      </svg>
      {slider("upper")}
      {slider("lower")}
    </div>
  );
}

/** The outline with a handle elsewhere; left and right move together unless they differ already. */
function moved(value: EnvelopeValue, of: Grip, side: 0 | 1, across: number, up: number): EnvelopeValue {
  const axis = side === 0 ? 0 : 2;
  const put = (vector: Vector): Vector => {
    const [x, , z] = vector;
    const height = round(Math.min(Math.max(up, -4), 4));
    const aside = round(Math.min(Math.max(Math.abs(across) < 0.05 ? 0 : across, -2), 2));
    return axis === 0 ? [aside, height, z] : [x, height, aside];
  };
  if (of === "top") {
    const top = put(value.top);
    return top[1] > value.bottom[1] + 0.1 ? { ...value, top } : value;
  }
  if (of === "bottom") {
    const bottom = put(value.bottom);
    return bottom[1] < value.top[1] - 0.1 ? { ...value, bottom } : value;
  }
  const [index, opposite] = of === "right" ? [side, side + 2] : [side + 2, side];
  const isEven = value.radii[index as 0] === value.radii[opposite as 0];
  const radius = round(Math.min(Math.max(Math.abs(across), 0.05), 3));
  const height = round(Math.min(Math.max(up, value.bottom[1] + 0.02), value.top[1] - 0.02));
  const [radii, heights] = [[...value.radii], [...value.heights]];
  for (const one of isEven ? [index, opposite] : [index]) {
    radii[one] = radius;
    heights[one] = height;
  }
  return {
    ...value,
    radii: radii as unknown as EnvelopeValue["radii"],
    heights: heights as unknown as EnvelopeValue["heights"],
  };
}

/** The outline in a plane: above and below the widest line a curve with its own exponent. */
function outline(value: EnvelopeValue, side: 0 | 1, x: (across: number) => number, y: (up: number) => number): string {
  const axis = side === 0 ? 0 : 2;
  const places: string[] = [];
  const quarter = (end: Vector, radius: number, height: number, power: number, back: boolean) => {
    for (let step = 0; step <= STEPS; step++) {
      const share = back ? 1 - step / STEPS : step / STEPS;
      // From the end (share 0) to the widest line (share 1).
      const across = end[axis] + (radius - end[axis]) * share;
      const up = end[1] - (end[1] - height) * (1 - (1 - share ** power) ** (1 / power));
      places.push(`${x(across)},${y(up)}`);
    }
  };
  const [right, left] = [value.radii[side], -value.radii[(side + 2) as 2]];
  const [rightUp, leftUp] = [value.heights[side], value.heights[(side + 2) as 2]];
  quarter(value.top, right, rightUp, value.upper, false);
  quarter(value.bottom, right, rightUp, value.lower, true);
  quarter(value.bottom, left, leftUp, value.lower, false);
  quarter(value.top, left, leftUp, value.upper, true);
  return `M${places.join("L")}Z`;
}

function round(value: number): number {
  return Math.round(value * 100) / 100;
}
