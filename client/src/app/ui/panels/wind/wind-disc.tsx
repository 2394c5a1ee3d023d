import { useRef } from "preact/hooks";
import { AIR_NUMBERS } from "../../../../scene/motion/air-numbers";
import { placeOnDisc, RIM, windAt } from "../../../document/wind/compass";
import type { WindControl } from "../../../document/wind/wind-control";
import type { Studio } from "../../../studio";
import { numberText, unitText } from "../../../words/number-text";
import { say } from "../../../words/say";
import { useAnimationFrames } from "../../use-animation-frames";

const HALF = 60;

/** Where the wind blows to, and how strongly, by one finger: seen from above, with who looks at the tree below. */
export function WindDisc({ studio, wind }: { studio: Studio; wind: WindControl }) {
  const { speed, direction } = wind.settings.value;
  const arrow = useRef<SVGGElement>(null);
  const turned = () => (studio.stage.turned * 180) / Math.PI;
  useAnimationFrames(true, () => {
    const [x, y] = placeOnDisc(speed, direction, turned());
    arrow.current?.querySelector("path")?.setAttribute("d", `M0 0L${HALF * x} ${HALF * y}`);
    arrow.current?.querySelector("circle")?.setAttribute("transform", `translate(${HALF * x} ${HALF * y})`);
  });
  const follow = (event: PointerEvent & { readonly currentTarget: HTMLElement }) => {
    const { left, top, width, height } = event.currentTarget.getBoundingClientRect();
    const [x, y] = [((event.clientX - left) / width) * 2 - 1, ((event.clientY - top) / height) * 2 - 1];
    return windAt(x, y, turned());
  };
  const step = (faster: number, round: number) =>
    wind.set({
      speed: Math.min(AIR_NUMBERS.speed.most, Math.max(0, speed + faster)),
      direction: (direction + round + 360) % 360,
    });
  const { step: tenth } = AIR_NUMBERS.speed;
  return (
    <div
      class="polar wind-disc"
      role="slider"
      tabIndex={0}
      aria-label={say("wind.disc")}
      aria-valuemin={AIR_NUMBERS.speed.least}
      aria-valuemax={AIR_NUMBERS.speed.most}
      aria-valuenow={speed}
      aria-valuetext={say("wind.disc.value", {
        speed: `${numberText(speed, tenth)}${unitText(AIR_NUMBERS.speed.unit)}`,
        direction: numberText(direction, AIR_NUMBERS.direction.step),
      })}
      onPointerDown={(event) => {
        if (event.button === 0) {
          event.currentTarget.setPointerCapture(event.pointerId);
          wind.drag(follow(event));
        }
      }}
      onPointerMove={(event) => {
        if (event.currentTarget.hasPointerCapture(event.pointerId)) {
          wind.drag(follow(event));
        }
      }}
      onPointerUp={(event) => {
        if (event.currentTarget.hasPointerCapture(event.pointerId)) {
          wind.set(follow(event));
        }
      }}
      onPointerCancel={() => wind.set({ speed, direction })}
      onKeyDown={(event) => {
        const by = KEYS[event.key];
        if (by) {
          event.preventDefault();
          step(by[0], by[1]);
        }
      }}
    >
      <svg viewBox={`${-HALF} ${-HALF} ${2 * HALF} ${2 * HALF}`} aria-hidden="true">
        <circle r={HALF * RIM} class="dial-track" />
        <circle r={(HALF * RIM) / 2} class="wind-ring" />
        <path d="M-5 58 0 52 5 58Z" class="dial-viewer" />
        <circle r="9" class="dial-crown" />
        <circle r="4" cx="-2.5" cy="-2.5" class="dial-crown-light" />
        <g ref={arrow}>
          <path class="wind-arrow" />
          <circle r="8" class="wind-knob" />
        </g>
      </svg>
    </div>
  );
}

/** How much stronger a key makes the wind, and by how many degrees it turns it. */
const KEYS: Record<string, readonly [faster: number, round: number]> = {
  ArrowUp: [0.5, 0],
  ArrowDown: [-0.5, 0],
  ArrowLeft: [0, -5],
  ArrowRight: [0, 5],
  PageUp: [5, 0],
  PageDown: [-5, 0],
};
