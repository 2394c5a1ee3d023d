import { useRef } from "preact/hooks";
import { GrowthShare } from "../../document/growth/growth-share";
import { isGrowing, stopGrowth } from "../../document/growth/under-way";
import { treeFiles } from "../../library/tree-files";
import type { Studio } from "../../studio";
import { symmetryNow } from "../../tools/symmetry/stroke-copies";
import { symmetryText } from "../../tools/symmetry/symmetry-text";
import { descriptorOf } from "../../tools/tools";
import { say } from "../../words/say";
import { CloseIcon, StopIcon } from "../icons";
import { JobsChip } from "./jobs-chip";
import { PausedChip } from "./paused-chip";
import { TransferChip } from "./transfer-chip";
import { useLasting } from "./use-lasting";

/** What is in progress and can be ended: growth, the choice of one branch, a branch on its way to another limb. */
export function Chips({ studio }: { studio: Studio }) {
  const placing = studio.branches.held.placing.value;
  return (
    <>
      <PausedChip studio={studio} />
      <GrowthChip studio={studio} />
      <TransferChip transfer={studio.exports.transfer} name="export" />
      <TransferChip transfer={studio.exports.picture} name="picture" />
      <TransferChip transfer={studio.obstacles.transfer} name="import" />
      <TransferChip transfer={treeFiles.transfer} name="tree" />
      {studio.rights.mayOrder && <JobsChip studio={studio} />}
      {placing !== null && (
        <p class="chip">
          {say(placing === "copy" ? "tools.placing.copy" : "tools.placing.move")}
          <button
            type="button"
            aria-label={say("tools.placing.cancel")}
            title={say("tools.placing.cancel.title")}
            onClick={() => studio.branches.held.cancelPlacing()}
          >
            <CloseIcon />
          </button>
        </p>
      )}
      <SymmetryChip studio={studio} />
      {studio.stage.widened.value && (
        <p class="chip">
          {say("tools.widened")}
          <button type="button" class="chip-stop" onClick={() => studio.stage.unwiden()}>
            {say("tools.widened.back")}
          </button>
        </p>
      )}
      {studio.bud.row.value !== null && (
        <p class="chip">
          <i class="bud-sign" aria-hidden="true" />
          {say("tools.bud")}
          <button
            type="button"
            aria-label={say("tools.bud.release")}
            title={say("tools.bud.release.title")}
            onClick={() => studio.bud.release()}
          >
            <CloseIcon />
          </button>
        </p>
      )}
    </>
  );
}

function SymmetryChip({ studio }: { studio: Studio }) {
  const symmetry = symmetryNow(studio.settings, studio.bud.row.value);
  if (symmetry.kind === "off" || descriptorOf(studio.tools.chosen.value).isSymmetric !== true) {
    return null;
  }
  return (
    <p class="chip">
      {symmetryText(symmetry)}
      <button
        type="button"
        aria-label={say("chips.symmetry.end")}
        title={say("chips.symmetry.end")}
        onClick={() => {
          studio.settings.symmetry.value = { ...symmetry, kind: "off" };
        }}
      >
        <CloseIcon />
      </button>
    </p>
  );
}

function GrowthChip({ studio }: { studio: Studio }) {
  const pending = studio.document.value?.pending_steps ?? 0;
  const outline = studio.outline.shown.value?.stage === "growing";
  const shown = useLasting(isGrowing(studio) && studio.link.phase.value === "connected");
  const share = useRef(new GrowthShare()).current.of(pending);
  if (!shown || studio.document.value?.paused !== undefined) {
    return null;
  }
  const trials = studio.document.value?.trials ?? 0;
  const growth = outline ? "tools.growing.outline" : pending > 1 ? "tools.growing.steps" : "tools.growing";
  const fitting = trials > 1 ? "tools.fitting.trials" : "tools.fitting";
  const text = trials > 0 ? say(fitting, { count: trials }) : say(growth, { count: pending });
  return (
    <p class="chip">
      {share === null || outline ? (
        <i class="spinner" aria-hidden="true" />
      ) : (
        <progress aria-label={text} max={1} value={share} />
      )}
      {text}
      {studio.rights.mayChange.value && (
        <button
          type="button"
          class="chip-stop"
          title={say(trials > 0 ? "tools.fitting.stop.title" : "tools.growing.stop.title")}
          onClick={() => stopGrowth(studio)}
        >
          <StopIcon />
          {say("tools.growing.stop")}
        </button>
      )}
    </p>
  );
}
