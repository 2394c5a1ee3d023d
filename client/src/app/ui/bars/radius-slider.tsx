import { useRef } from "preact/hooks";
import type { Studio } from "../../studio";
import { MAX_RADIUS, placeOf, radiusAt, radiusLabel, stepRadius } from "../../tools/brush/brush-radius";
import { descriptorOf } from "../../tools/tools";
import { say } from "../../words/say";

/** Who pulls past the slider's end by this share of its way asks for more than there is room for. */
const PAST_END = 1.08;

/** A vertical slider for the brush's radius. */
export function RadiusSlider({ studio }: { studio: Studio }) {
  const track = useRef<HTMLDivElement>(null);
  const { radius } = studio.stage;
  const widest = studio.stage.widest.value;
  const place = placeOf(radius, widest);

  const follow = (event: PointerEvent) => {
    const bounds = track.current?.getBoundingClientRect();
    if (bounds && (event.type === "pointerdown" || event.buttons % 2 === 1)) {
      const pulled = (bounds.bottom - event.clientY) / bounds.height;
      studio.stage.setRadius(pulled > PAST_END ? MAX_RADIUS : radiusAt(pulled, widest));
    }
  };
  const onKeyDown = (event: KeyboardEvent) => {
    const notches = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1, PageUp: 4, PageDown: -4 }[event.key];
    if (notches !== undefined) {
      studio.stage.setRadius(stepRadius(radius, notches));
    } else if (event.key === "Home" || event.key === "End") {
      studio.stage.setRadius(event.key === "Home" ? 0 : widest);
    } else {
      return;
    }
    event.preventDefault();
  };

  return (
    <div class="radius" data-idle={descriptorOf(studio.tools.chosen.value).usesRadius !== true}>
      <div class="radius-value" aria-hidden="true">
        {radiusLabel(radius)}
      </div>
      <div
        class="radius-slider"
        data-place="radius"
        role="slider"
        tabIndex={0}
        aria-label={say("bars.radius")}
        aria-orientation="vertical"
        aria-valuemin={0}
        aria-valuemax={widest}
        aria-valuenow={Math.round(radius * 10) / 10}
        aria-valuetext={
          radius === 0 ? say("bars.radius.sketch") : say("bars.radius.value", { radius: radiusLabel(radius) })
        }
        style={{ "--place": place }}
        onPointerDown={(event) => {
          if (event.button === 0) {
            event.currentTarget.setPointerCapture(event.pointerId);
            follow(event);
          }
        }}
        onPointerMove={follow}
        onKeyDown={onKeyDown}
      >
        <div class="radius-track" ref={track}>
          <svg viewBox="0 0 20 100" preserveAspectRatio="none" aria-hidden="true">
            <path class="wedge" d="M9 100 L2 2 Q10 -2 18 2 L11 100 Q10 101 9 100Z" />
          </svg>
          <span class="radius-thumb" />
        </div>
      </div>
    </div>
  );
}
