import type { ComponentChildren } from "preact";
import { useEffect, useState } from "preact/hooks";
import type { Studio } from "../studio";
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
    <Options label="Bending">
      <p class="tool-hint">
        {marked
          ? "Drag any place above the ring. Tap a place to have it stay put."
          : "Drag a branch. Hold or tap its base first to say where it bends from."}
      </p>
      <label class="tool-slider ends">
        <span>stiff</span>
        <input
          type="range"
          aria-label="Stretch"
          aria-valuetext={percent === 0 ? "stiff: it keeps its length" : `${percent} in 100`}
          min={0}
          max={100}
          value={percent}
          style={{ "--place": `${percent}%` }}
          onInput={(event) => {
            stretch.value = Number(event.currentTarget.value) / 100;
          }}
        />
        <span>stretchy</span>
      </label>
      {marked && (
        <button
          type="button"
          class="tool"
          aria-label="Let go of the base"
          title="Let go of the base (Esc)"
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
    <Options label="Widths">
      <p class="tool-hint">
        {width?.chosen.value != null
          ? "Pull a knob to make the limb thicker. Drag the dot to move the ring along it."
          : "Pinch around a limb with two fingers, or tap it."}
      </p>
      <span class="quiet">
        {set === 0 ? "No width is set" : set === 1 ? "One width is set" : `${set} widths are set`}
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
  const branches = count === 1 ? "1 branch" : `${count} branches`;
  return (
    <Options label="Pruning">
      <p class="tool-hint">Tap a branch, or draw a line through branches.</p>
      <label class="switch" title="Show how the tree would grow on, before anything is cut">
        <input
          type="checkbox"
          checked={prune?.foresees.value === true}
          onChange={(event) => {
            if (prune) {
              prune.foresees.value = event.currentTarget.checked;
            }
          }}
        />
        <span>What if?</span>
      </label>
      <label class="tool-slider">
        <span>In the dark</span>
        <input
          type="range"
          aria-label="Mark branches that get less light than"
          aria-valuetext={exposure === 0 ? "none" : `${percent} in 100: ${branches}`}
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
          {count === 0 ? "None" : `Cut ${branches}`}
        </button>
      )}
    </Options>
  );
}
