import { useRef } from "preact/hooks";
import { deflectionFor, FASTEST, growthRate, KEY_RATE } from "../../document/growth/grow-pacer";
import type { Studio } from "../../studio";
import { say } from "../../words/say";

const KEY_PUSH = deflectionFor(KEY_RATE);

/** A lever that springs back: pushed up the tree grows, pulled down it grows backwards, further is faster. */
export function GrowJog({ studio }: { studio: Studio }) {
  const lever = useRef<HTMLDivElement>(null);
  const held = useRef<number | null>(null);
  const deflection = studio.growth.deflection.value;
  const rate = Math.round(growthRate(deflection));

  const follow = (event: PointerEvent) => {
    const bounds = lever.current?.getBoundingClientRect();
    if (bounds) {
      const way = (bounds.height - bounds.width) / 2;
      const offset = bounds.top + bounds.height / 2 - event.clientY;
      studio.growth.to(Math.max(-1, Math.min(1, offset / way)));
    }
  };
  const release = (event: PointerEvent) => {
    if (held.current === event.pointerId) {
      held.current = null;
      studio.growth.release();
    }
  };
  const pushed = (key: string) => ({ ArrowUp: KEY_PUSH, PageUp: 1, ArrowDown: -KEY_PUSH, PageDown: -1 })[key];
  const speech =
    rate === 0 ? say("bars.grow.rest") : say(rate > 0 ? "bars.grow.forth" : "bars.grow.back", { rate: Math.abs(rate) });

  return (
    <div
      class="jog"
      data-place="grow"
      ref={lever}
      role="slider"
      tabIndex={0}
      aria-label={say("bars.grow")}
      aria-orientation="vertical"
      aria-valuemin={-FASTEST}
      aria-valuemax={FASTEST}
      aria-valuenow={rate}
      aria-valuetext={speech}
      data-moving={deflection !== 0}
      style={{ "--deflection": deflection }}
      title={say("bars.grow.title")}
      onPointerDown={(event) => {
        if (held.current === null && event.button === 0) {
          held.current = event.pointerId;
          event.currentTarget.setPointerCapture(event.pointerId);
          follow(event);
        }
      }}
      onPointerMove={(event) => {
        // Who stops growth meanwhile takes the lever out of the hand.
        if (held.current === event.pointerId && studio.growth.isHeld) {
          follow(event);
        }
      }}
      onPointerUp={release}
      onPointerCancel={release}
      onLostPointerCapture={release}
      onKeyDown={(event) => {
        const push = pushed(event.key);
        if (push !== undefined) {
          event.preventDefault();
          studio.growth.to(push);
        }
      }}
      onKeyUp={(event) => {
        if (pushed(event.key) !== undefined) {
          studio.growth.release();
        }
      }}
      onBlur={() => studio.growth.release()}
    >
      <svg class="jog-scale" viewBox="0 0 44 140" aria-hidden="true">
        <path d="M22 14v16M22 24c-4.5.2-7-2-7.3-6 4.5-.2 7 2 7.3 6ZM22 20c0-4 2.2-6.5 6.6-7 .2 4.3-2.2 6.8-6.6 7Z" />
        <path d="M16 116l6 7 6-7M22 123v-16" />
      </svg>
      <span class="jog-knob">
        <i />
        <i />
        <i />
      </span>
    </div>
  );
}
