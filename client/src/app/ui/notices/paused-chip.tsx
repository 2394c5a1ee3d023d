import { stopGrowth } from "../../document/growth/under-way";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { StopIcon } from "../icons";
import { GoOn } from "./go-on-button";

/** Why growth rests, and the ways on (`LM19`, `OP5`). */
export function PausedChip({ studio }: { studio: Studio }) {
  const paused = studio.document.value?.paused;
  if (paused === undefined || studio.link.phase.value !== "connected") {
    return null;
  }
  const mayResume = paused === "crashes" && studio.rights.mayResume;
  const fits = (studio.document.value?.trials ?? 0) > 0;
  return (
    <p class="chip" data-paused={paused}>
      {say(paused === "crashes" ? "chips.paused.crashes" : fits ? "chips.paused.fitting" : "chips.paused.memory")}
      {paused === "crashes" && !mayResume && say("chips.paused.owner")}
      {mayResume && <GoOn studio={studio} />}
      {studio.rights.mayChange.value && (
        <button
          type="button"
          class="chip-stop"
          title={say(fits ? "tools.fitting.stop.title" : "tools.growing.stop.title")}
          onClick={() => stopGrowth(studio)}
        >
          <StopIcon />
          {say("tools.growing.stop")}
        </button>
      )}
    </p>
  );
}
