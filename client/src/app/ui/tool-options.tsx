import type { ComponentChildren } from "preact";
import { useEffect, useState } from "preact/hooks";
import type { Studio } from "../studio";
import { say } from "../words";
import { CloseIcon } from "./icons";

/** What the tool at hand can be told, in one line at the bottom. */
export function ToolOptions({ studio }: { studio: Studio }) {
  const tool = studio.tools.chosen.value;
  if (studio.branches.prediction.rows.value !== null || studio.tools.shaping.value === null) {
    return null;
  }
  switch (tool) {
    case "bend":
      return <BendOptions studio={studio} />;
    case "width":
      return <WidthOptions studio={studio} />;
    case "prune":
      return <PruneOptions studio={studio} />;
    default:
      return null;
  }
}

function Options({ label, children }: { label: string; children: ComponentChildren }) {
  return (
    <section class="panel tool-options" aria-label={label}>
      {children}
    </section>
  );
}

function BendOptions({ studio }: { studio: Studio }) {
  const { stretch } = studio.settings;
  const bend = studio.tools.shaping.value?.bend;
  const marked = bend?.base.value != null;
  const percent = Math.round(100 * stretch.value);
  return (
    <Options label={say("tools.bending")}>
      <p class="tool-hint">{say(marked ? "tools.bending.marked" : "tools.bending.unmarked")}</p>
      <label class="tool-slider ends">
        <span>{say("tools.stretch.stiff")}</span>
        <input
          type="range"
          aria-label={say("tools.stretch")}
          aria-valuetext={percent === 0 ? say("tools.stretch.none") : say("tools.stretch.value", { percent })}
          min={0}
          max={100}
          value={percent}
          style={{ "--place": `${percent}%` }}
          onInput={(event) => {
            stretch.value = Number(event.currentTarget.value) / 100;
          }}
        />
        <span>{say("tools.stretch.stretchy")}</span>
      </label>
      {marked && (
        <button
          type="button"
          class="tool"
          aria-label={say("tools.base-release")}
          title={say("tools.base-release.title")}
          onClick={() => bend?.release()}
        >
          <CloseIcon />
        </button>
      )}
    </Options>
  );
}

function WidthOptions({ studio }: { studio: Studio }) {
  const width = studio.tools.shaping.value?.width;
  const set = width?.widths.value.length ?? 0;
  return (
    <Options label={say("tools.widths")}>
      <p class="tool-hint">
        {width?.chosen.value != null ? say("tools.widths.chosen") : say("tools.widths.none-chosen")}
      </p>
      <span class="quiet">
        {say(set === 0 ? "tools.widths.none" : set === 1 ? "tools.widths.one" : "tools.widths.many", { count: set })}
      </span>
    </Options>
  );
}

/** Below this share of full light is the dark; the slider's whole way. */
const BRIGHTEST = 0.6;

function PruneOptions({ studio }: { studio: Studio }) {
  const prune = studio.tools.shaping.value?.prune;
  const [exposure, setExposure] = useState(0);
  const [count, setCount] = useState(0);
  const revision = studio.revision.value;
  // What is marked follows the tree, and is unmarked with the tool.
  useEffect(() => {
    setCount(prune?.markDim(exposure > 0 ? exposure : null) ?? 0);
  }, [prune, exposure, revision]);
  useEffect(() => () => void prune?.markDim(null), [prune]);
  const percent = Math.round(100 * exposure);
  return (
    <Options label={say("tools.pruning")}>
      <p class="tool-hint">{say("tools.pruning.hint")}</p>
      <label class="switch" title={say("tools.what-if.title")}>
        <input
          type="checkbox"
          checked={prune?.foresees.value === true}
          onChange={(event) => {
            if (prune) {
              prune.foresees.value = event.currentTarget.checked;
            }
          }}
        />
        <span>{say("tools.what-if")}</span>
      </label>
      <label class="tool-slider">
        <span>{say("tools.dim")}</span>
        <input
          type="range"
          aria-label={say("tools.dim.label")}
          aria-valuetext={
            exposure === 0
              ? say("tools.dim.none")
              : say(count === 1 ? "tools.dim.one" : "tools.dim.many", { percent, count })
          }
          min={0}
          max={100 * BRIGHTEST}
          value={percent}
          style={{ "--place": `${(100 * exposure) / BRIGHTEST}%` }}
          onInput={(event) => setExposure(Number(event.currentTarget.value) / 100)}
        />
      </label>
      {exposure > 0 && (
        <button
          type="button"
          class="primary danger"
          disabled={count === 0}
          onClick={() => {
            prune?.cutDim(exposure);
            setExposure(0);
          }}
        >
          {say(count === 0 ? "tools.cut.none" : count === 1 ? "tools.cut.one" : "tools.cut.many", { count })}
        </button>
      )}
    </Options>
  );
}
