import { useRef } from "preact/hooks";
import type { Hint } from "../../../wire/generated";
import type { Studio } from "../../studio";
import { type Key, say } from "../../words/say";
import { useAnimationFrames } from "../use-animation-frames";

/** The sentence stays so far from the edges of the workspace, in pixels: half its width, and its height. */
const ROOM = { x: 130, y: 96 };

const REASONS = {
  out_of_reach: "problems.out-of-reach",
  nothing_grew: "problems.nothing-grew",
  did_not_reach: "problems.did-not-reach",
} as const satisfies Record<Hint["reason"], Key>;

/** A sentence at the place where somebody drew and growth does not come. */
export function VainMark({ studio }: { studio: Studio }) {
  const mark = useRef<HTMLParagraphElement>(null);
  const hint = studio.drawnInVain.shown.value;
  useAnimationFrames(hint !== null, () => {
    const element = mark.current;
    const at = hint && studio.stage.projector()?.(hint.position);
    if (!element?.parentElement || !at) {
      return;
    }
    const { clientWidth, clientHeight } = element.parentElement;
    const [x, y] = [inside(at[0], ROOM.x, clientWidth), inside(at[1], ROOM.y, clientHeight)];
    element.style.translate = `${x}px ${y}px`;
  });
  return (
    <p class="vain" ref={mark} role="status" data-reason={hint?.reason}>
      {hint && <span key={hint.id}>{say(REASONS[hint.reason])}</span>}
    </p>
  );
}

/** The nearest place to `at` that keeps so far from both ends; the middle where there is no such place. */
function inside(at: number, room: number, length: number): number {
  return length < 2 * room ? length / 2 : Math.min(Math.max(at, room), length - room);
}
