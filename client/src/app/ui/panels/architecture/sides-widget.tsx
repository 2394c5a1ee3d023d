import { useRef, useState } from "preact/hooks";
import { NUMBERS, WIDGETS } from "../../../document/growth/growth-parameters";
import { numberText } from "../../../words/number-text";
import { say } from "../../../words/say";
import { useEased } from "./eased";
import { Grip } from "./grip";
import { away, clamped, type Place } from "./place";
import { distanceAt, type Ellipse, favoured, movedBy, pulledTo, reachOf, widenedTo } from "./sides";
import { Diagram, WidgetFrame, type WidgetProps } from "./widget";

const [WIDTH, HEIGHT] = [196, 196];
const AXIS: Place = { x: WIDTH / 2, y: HEIGHT / 2 };
/** What the ellipse at rest fills, from the axis on, in pixels. */
const ROOM = 60;
/** So much is in sight at least, in units of the ellipse. */
const LEAST_SIGHT = 1.45;
/** Grips stand outside the ellipse, so that those of a small one can be distinguished. */
const OUTSIDE = 22;
const DIRECTIONS = Array.from({ length: 16 }, (_, i) => (360 * i) / 16);

/** An ellipse around a branch seen end-on: which side its buds thrive on (Figure 10B). */
export function SidesWidget({ studio }: WidgetProps) {
  const now = studio.parameters.value;
  const [held, setHeld] = useState(false);
  const begin = useRef<Ellipse | null>(null);
  const { above, below, aside } = reachOf(now ?? PLAIN);
  // The scale stays while the user pulls, or the ellipse would run away from it.
  const scale = useEased(ROOM / Math.max(LEAST_SIGHT, above, below, aside), held);
  if (now === null) {
    return null;
  }
  const { gravimorphism_vertical: s, gravimorphism_horizontal: p, gravimorphism_shift: e } = now;
  const middle = { x: AXIS.x, y: AXIS.y - s * e * scale };
  const inside = ({ x, y }: Place): Place => ({ x: clamped(x, 12, WIDTH - 12), y: clamped(y, 12, HEIGHT - 12) });
  const release = () => {
    begin.current = null;
    setHeld(false);
    studio.growing.commit();
  };
  const pull = (act: (to: Place, from: Ellipse) => void) => (to: Place) => {
    begin.current ??= now;
    setHeld(true);
    act(to, begin.current);
  };
  const text = (value: number) => numberText(value, 0.01);
  return (
    <WidgetFrame
      studio={studio}
      title={say("architecture.sides")}
      help={say("architecture.sides.help")}
      parameters={WIDGETS.sides}
      note={say(`architecture.sides.${favoured(now)}`)}
    >
      <Diagram
        width={WIDTH}
        height={HEIGHT}
        drawing={
          <>
            <path class="guide" d={`M${AXIS.x} 8V${HEIGHT - 8}M8 ${AXIS.y}H${WIDTH - 8}`} />
            <ellipse class="field-shape" cx={middle.x} cy={middle.y} rx={p * scale} ry={s * scale} />
            {DIRECTIONS.map((direction) => {
              const reach = distanceAt(direction, now);
              const end = away(AXIS, direction, Math.max(7, reach * scale - 5));
              return (
                <g key={direction} style={{ opacity: clamped(0.25 + 0.5 * reach, 0.3, 1) }}>
                  <path class="shoot-line" d={`M${AXIS.x} ${AXIS.y}L${end.x} ${end.y}`} />
                  <circle class="shoot-tip" cx={end.x} cy={end.y} r={clamped(1.6 + 1.7 * reach, 1.6, 5)} />
                </g>
              );
            })}
            <circle class="cut-wood" cx={AXIS.x} cy={AXIS.y} r={9} />
            <circle class="cut-ring" cx={AXIS.x} cy={AXIS.y} r={4.5} />
          </>
        }
      >
        <Grip
          label={say("architecture.sides.aside")}
          text={text(aside)}
          {...NUMBERS.gravimorphism_horizontal}
          value={p}
          at={inside({ x: AXIS.x + p * scale + OUTSIDE, y: middle.y })}
          way="level"
          onPull={pull((to) => studio.growing.drag(widenedTo((to.x - AXIS.x - OUTSIDE) / scale)))}
          onValue={(value) => studio.growing.drag(widenedTo(value))}
          onRelease={release}
        />
        <Grip
          label={say("architecture.sides.whole")}
          text={text(e)}
          {...NUMBERS.gravimorphism_shift}
          value={e}
          at={inside({ x: AXIS.x - p * scale - OUTSIDE, y: middle.y })}
          way="upright"
          onPull={pull((to, from) => studio.growing.drag(movedBy((AXIS.y - to.y) / scale - centreOf(from), from)))}
          onValue={(value) => studio.growing.drag({ gravimorphism_shift: value })}
          onRelease={release}
        />
        {(["above", "below"] as const).map((end) => {
          const [value, up] = end === "above" ? [above, -1] : [below, 1];
          return (
            <Grip
              key={end}
              label={say(`architecture.sides.${end}`)}
              text={text(value)}
              value={Math.round(100 * value) / 100}
              least={0}
              most={6}
              step={0.05}
              at={inside({ x: AXIS.x, y: AXIS.y + up * (value * scale + OUTSIDE) })}
              way="upright"
              onPull={pull((to, from) =>
                studio.growing.drag(pulledTo(end, ((to.y - AXIS.y) * up - OUTSIDE) / scale, from)),
              )}
              onValue={(to) => studio.growing.drag(pulledTo(end, to, now))}
              onRelease={release}
            />
          );
        })}
      </Diagram>
    </WidgetFrame>
  );
}

const PLAIN: Ellipse = { gravimorphism_vertical: 1, gravimorphism_horizontal: 1, gravimorphism_shift: 0 };

const centreOf = ({ gravimorphism_vertical, gravimorphism_shift }: Ellipse) =>
  gravimorphism_vertical * gravimorphism_shift;
