import { NUMBERS, nameOf, shownValue, WIDGETS } from "../../../document/growth/growth-parameters";
import { say } from "../../../words/say";
import { branchingAt, deflectionAt, lateralEnd, mainEnd } from "./fork";
import { Grip } from "./grip";
import { arc, away, type Place } from "./place";
import { Diagram, WidgetFrame, type WidgetProps } from "./widget";

const [WIDTH, HEIGHT] = [196, 186];
const NODE: Place = { x: 90, y: 136 };

/** A fork to be bent: the branching angle ψ and the deflection angle δ (Figure 8A). */
export function ForkWidget({ studio }: WidgetProps) {
  const now = studio.parameters.value;
  if (now === null) {
    return null;
  }
  const { branching_angle: psi, deflection_angle, buds_per_node: buds } = now;
  const delta = buds === 1 ? deflection_angle : 0;
  const [lateral, main] = [lateralEnd(NODE, psi), mainEnd(NODE, delta)];
  const foot = { x: NODE.x, y: HEIGHT };
  const line = (from: Place, to: Place) => `M${from.x} ${from.y}L${to.x} ${to.y}`;
  return (
    <WidgetFrame
      studio={studio}
      title={say("architecture.fork")}
      help={say(buds === 1 ? "architecture.fork.help" : "architecture.fork.several")}
      parameters={WIDGETS.fork}
    >
      <Diagram
        width={WIDTH}
        height={HEIGHT}
        drawing={
          <>
            <path class="angle" d={`${arc(NODE, 34, 0, psi)}L${NODE.x} ${NODE.y}Z`} />
            {delta > 0 && <path class="angle second" d={`${arc(NODE, 60, -delta, 0)}L${NODE.x} ${NODE.y}Z`} />}
            <path class="guide" d={line(NODE, away(NODE, 0, 108))} />
            {buds > 1 && <path class="limb side faint" d={line(NODE, lateralEnd(NODE, -psi))} />}
            <path class="limb side" d={line(NODE, lateral)} />
            <path class="limb" d={`${line(foot, NODE)}L${main.x} ${main.y}`} />
            {psi >= 18 && (
              <text class="letter" {...labelled(away(NODE, psi / 2, psi < 40 ? 44 : 22))}>
                ψ
              </text>
            )}
            {delta >= 12 && (
              <text class="letter" {...labelled(away(NODE, -delta / 2, 49))}>
                δ
              </text>
            )}
          </>
        }
      >
        <Grip
          label={nameOf(NUMBERS.deflection_angle)}
          text={shownValue(NUMBERS.deflection_angle, deflection_angle)}
          {...NUMBERS.deflection_angle}
          value={deflection_angle}
          at={main}
          way="level"
          disabled={buds > 1}
          onPull={(to) => studio.growing.drag(deflectionAt(NODE, to))}
          onValue={(value) => studio.growing.drag({ deflection_angle: value })}
          onRelease={() => studio.growing.commit()}
        />
        <Grip
          label={nameOf(NUMBERS.branching_angle)}
          text={shownValue(NUMBERS.branching_angle, psi)}
          {...NUMBERS.branching_angle}
          value={psi}
          at={lateral}
          way="around"
          onPull={(to) => studio.growing.drag(branchingAt(NODE, to))}
          onValue={(value) => studio.growing.drag({ branching_angle: value })}
          onRelease={() => studio.growing.commit()}
        />
      </Diagram>
    </WidgetFrame>
  );
}

const labelled = ({ x, y }: Place) => ({ x, y: y + 5, "text-anchor": "middle" as const });
