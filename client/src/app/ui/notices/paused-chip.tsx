import { useState } from "preact/hooks";
import { goOn } from "../../document/growth/go-on";
import { stopGrowth } from "../../document/growth/under-way";
import { explained } from "../../problems/explained";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { StopIcon } from "../icons";

/** Why growth rests, and the ways on (`LM19`, `OP5`). */
export function PausedChip({ studio }: { studio: Studio }) {
  const paused = studio.document.value?.paused;
  if (paused === undefined || studio.link.phase.value !== "connected") {
    return null;
  }
  const mayResume = paused === "crashes" && studio.rights.mayResume;
  return (
    <p class="chip" data-paused={paused}>
      {say(paused === "memory" ? "chips.paused.memory" : "chips.paused.crashes")}
      {paused === "crashes" && !mayResume && say("chips.paused.owner")}
      {mayResume && <GoOn studio={studio} />}
      {studio.rights.mayChange.value && (
        <button
          type="button"
          class="chip-stop"
          title={say("tools.growing.stop.title")}
          onClick={() => stopGrowth(studio)}
        >
          <StopIcon />
          {say("tools.growing.stop")}
        </button>
      )}
    </p>
  );
}

/** Has that tried again which the server did not outlive. */
export function GoOn({ studio, look = "chip-stop", then }: { studio: Studio; look?: string; then?: () => void }) {
  const [asking, setAsking] = useState(false);
  const act = async () => {
    const session = studio.link.session.value;
    if (session === null) {
      return;
    }
    setAsking(true);
    try {
      await goOn(session);
      then?.();
    } catch (error) {
      studio.toasts.show(await explained(error));
    } finally {
      setAsking(false);
    }
  };
  return (
    <button type="button" class={look} disabled={asking} onClick={() => void act()}>
      {say("chips.paused.go-on")}
    </button>
  );
}
