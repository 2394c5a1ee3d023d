import { useEffect, useRef } from "preact/hooks";
import type { Hint } from "../../../wire/generated";
import type { Studio } from "../../studio";
import { type Key, say } from "../../words/say";
import { useAnimationFrames } from "../use-animation-frames";

/** The sentence stays so far from the sides and the foot of the workspace, in pixels. */
const ROOM = { x: 130, y: 96 };
/** It stands so far above the place, as its style has it, and so far below what lies over it. */
const [ABOVE, GAP] = [36, 8];

const REASONS = {
  out_of_reach: "problems.out-of-reach",
  nothing_grew: "problems.nothing-grew",
  did_not_reach: "problems.did-not-reach",
} as const satisfies Record<Hint["reason"], Key>;

/** A sentence at the place where somebody drew and growth does not come. */
export function VainMark({ studio }: { studio: Studio }) {
  const mark = useRef<HTMLParagraphElement>(null);
  const hint = studio.drawnInVain.shown.value;
  useEffect(() => {
    if (hint !== null) {
      studio.drawnInVain.seen();
    }
  }, [studio, hint]);
  useAnimationFrames(hint !== null, () => {
    const element = mark.current;
    const at = hint && studio.stage.projector()?.(hint.position);
    if (!element?.parentElement || !at) {
      return;
    }
    const { clientWidth, clientHeight } = element.parentElement;
    // The bars at the top, and what is in progress below them, would hide it.
    const chips = element.parentElement.querySelector<HTMLElement>(".chips");
    const covered = chips ? chips.offsetTop + chips.offsetHeight : 0;
    const top = covered + GAP + (element.firstElementChild?.clientHeight ?? 0) + ABOVE;
    const [x, y] = [inside(at[0], ROOM.x, clientWidth), inside(at[1], ROOM.y, clientHeight, top)];
    element.style.translate = `${x}px ${y}px`;
  });
  return (
    <p class="vain" ref={mark} role="status" data-reason={hint?.reason}>
      {hint && <span key={hint.id}>{say(REASONS[hint.reason])}</span>}
    </p>
  );
}

/** The nearest place to `at` that keeps so far from the ends; the middle where there is no such place. */
function inside(at: number, room: number, length: number, first = room): number {
  return length < first + room ? length / 2 : Math.min(Math.max(at, first), length - room);
}
