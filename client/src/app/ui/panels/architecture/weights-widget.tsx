import { NUMBERS, nameOf, WIDGETS } from "../../../document/growth/growth-parameters";
import { numberText } from "../../../words/number-text";
import { say } from "../../../words/say";
import { Grip } from "./grip";
import { type Corners, pointOf, weightsAt } from "./triangle";
import { Diagram, WidgetFrame, type WidgetProps } from "./widget";

const [WIDTH, HEIGHT] = [196, 186];
const CORNERS: Corners = [
  { x: 98, y: 28 },
  { x: 22, y: 158 },
  { x: 174, y: 158 },
];
/** What an arrow key moves the dot by, in pixels. */
const NUDGE = 2.5;

/** A dot in a triangle: how much heading, tropism and free space weigh (Figure 11B). */
export function WeightsWidget({ studio }: WidgetProps) {
  const now = studio.parameters.value;
  if (now === null) {
    return null;
  }
  const weights = [now.heading_weight, now.tropism_weight, now.space_weight] as const;
  const [alpha, beta, gamma] = weights.map((weight) => numberText(weight, 0.01)) as [string, string, string];
  const point = pointOf(now, CORNERS);
  const [h, t, e] = CORNERS;
  return (
    <WidgetFrame
      studio={studio}
      title={say("architecture.weights")}
      help={say("architecture.weights.help")}
      parameters={WIDGETS.weights}
    >
      <Diagram
        width={WIDTH}
        height={HEIGHT}
        drawing={
          <>
            <path class="field-shape" d={`M${h.x} ${h.y}L${t.x} ${t.y}L${e.x} ${e.y}Z`} />
            {CORNERS.map((corner, i) => (
              <path
                class="pull"
                key={WIDGETS.weights[i]!.name}
                d={`M${corner.x} ${corner.y}L${point.x} ${point.y}`}
                stroke-width={1 + 9 * weights[i]!}
              />
            ))}
            <text class="corner" x={h.x} y={17} text-anchor="middle">
              {nameOf(NUMBERS.heading_weight)}
            </text>
            <text class="corner" x={2} y={180}>
              {nameOf(NUMBERS.tropism_weight)}
            </text>
            <text class="corner" x={WIDTH - 2} y={180} text-anchor="end">
              {nameOf(NUMBERS.space_weight)}
            </text>
          </>
        }
      >
        <Grip
          label={say("architecture.weights.point")}
          text={say("architecture.weights.text", { alpha, beta, gamma })}
          {...NUMBERS.heading_weight}
          value={now.heading_weight}
          at={point}
          onPull={(to) => studio.growing.drag(weightsAt(to, CORNERS))}
          onValue={(value) => studio.growing.drag(weightsAt(value === 1 ? h : middleOf(t, e), CORNERS))}
          onArrows={(right, up) =>
            studio.growing.drag(weightsAt({ x: point.x + right * NUDGE, y: point.y - up * NUDGE }, CORNERS))
          }
          onRelease={() => studio.growing.commit()}
        />
      </Diagram>
    </WidgetFrame>
  );
}

const middleOf = (one: { x: number; y: number }, other: { x: number; y: number }) => ({
  x: (one.x + other.x) / 2,
  y: (one.y + other.y) / 2,
});
