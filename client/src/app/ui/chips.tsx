import { useEffect, useState } from "preact/hooks";
import type { Studio } from "../studio";
import { CloseIcon, StopIcon } from "./icons";

/** Growth that is done sooner is not worth a word. */
const WORTH_A_WORD = 200;
/** So many steps are, whatever the hand is doing. */
const LONG_GROWTH = 20;

/** What is under way and can be ended: growth, the choice of one branch, a branch on its way to another limb. */
export function Chips({ studio }: { studio: Studio }) {
  const placing = studio.branches.hand.placing.value;
  return (
    <div class="chips" role="status">
      <GrowthChip studio={studio} />
      {placing !== null && (
        <p class="chip">
          {placing === "copy"
            ? "Tap the limb for the copy, drag to aim it"
            : "Tap the limb to move it to, drag to aim it"}
          <button
            type="button"
            aria-label="Leave the branch where it is"
            title="Leave the branch where it is (Esc)"
            onClick={() => studio.branches.hand.cancelPlacing()}
          >
            <CloseIcon />
          </button>
        </p>
      )}
      {studio.bud.row.value !== null && (
        <p class="chip">
          <i class="bud-sign" aria-hidden="true" />
          Only this branch grows
          <button
            type="button"
            aria-label="Let every branch grow"
            title="Let every branch grow (Esc)"
            onClick={() => studio.bud.release()}
          >
            <CloseIcon />
          </button>
        </p>
      )}
    </div>
  );
}

function GrowthChip({ studio }: { studio: Studio }) {
  const pending = studio.document.value?.pending_steps ?? 0;
  const outline = studio.tools.outline.shown.value?.stage === "growing";
  const handsFree = !studio.tools.drawing.value && studio.growth.deflection.value === 0;
  const growing = outline || pending >= LONG_GROWTH || (pending > 0 && handsFree);
  const shown = useLasting(growing && studio.phase.value === "connected");
  if (!shown) {
    return null;
  }
  return (
    <p class="chip">
      <i class="spinner" aria-hidden="true" />
      {outline ? "Growing into the outline…" : pending > 1 ? `Growing… ${pending} steps to go` : "Growing…"}
      <button type="button" class="chip-stop" onClick={() => studio.stop()}>
        <StopIcon />
        Stop
      </button>
    </p>
  );
}

/** Whether something has been so for a while. */
function useLasting(now: boolean): boolean {
  const [lasting, setLasting] = useState(false);
  useEffect(() => {
    if (!now) {
      setLasting(false);
      return undefined;
    }
    const timer = setTimeout(() => setLasting(true), WORTH_A_WORD);
    return () => clearTimeout(timer);
  }, [now]);
  return now && lasting;
}
