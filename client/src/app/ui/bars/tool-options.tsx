import type { ComponentChildren } from "preact";
import { useEffect, useState } from "preact/hooks";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { Slider } from "../controls/slider";
import { Switch } from "../controls/switch";
import { CloseIcon } from "../icons";

/** The options of the chosen tool, in one line at the bottom. */
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
    <section class="panel tool-options single-line" aria-label={label}>
      {children}
    </section>
  );
}

/** How far a branch stretches before anyone has said so, in percent. */
const USUAL_STRETCH = 30;

function BendOptions({ studio }: { studio: Studio }) {
  const { stretch } = studio.settings;
  const bend = studio.tools.shaping.value?.bend;
  const marked = bend?.base.value != null;
  const set = (percent: number) => {
    stretch.value = percent / 100;
  };
  return (
    <Options label={say("tools.bending")}>
      <p class="tool-hint">{say(marked ? "tools.bending.marked" : "tools.bending.unmarked")}</p>
      <Slider
        label={say("tools.stretch")}
        help={say("tools.stretch.help")}
        unit="%"
        least={0}
        most={100}
        step={1}
        value={Math.round(100 * stretch.value)}
        standard={USUAL_STRETCH}
        onDrag={set}
        onCommit={set}
      />
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

/** Below this share of full light, in percent, is the dark; the slider's whole way. */
const BRIGHTEST = 60;

function PruneOptions({ studio }: { studio: Studio }) {
  const prune = studio.tools.shaping.value?.prune;
  const [percent, setPercent] = useState(0);
  const [count, setCount] = useState(0);
  const exposure = percent / 100;
  const revision = studio.revision.value;
  // What is marked follows the tree, and is unmarked with the tool.
  useEffect(() => {
    setCount(prune?.markDim(exposure > 0 ? exposure : null) ?? 0);
  }, [prune, exposure, revision]);
  useEffect(() => () => void prune?.markDim(null), [prune]);
  return (
    <Options label={say("tools.pruning")}>
      <div class="tool-lead">
        <p class="tool-hint">{say("tools.pruning.hint")}</p>
        {percent > 0 && (
          <button
            type="button"
            class="primary danger"
            disabled={count === 0}
            onClick={() => {
              prune?.cutDim(exposure);
              setPercent(0);
            }}
          >
            {say(count === 0 ? "tools.cut.none" : count === 1 ? "tools.cut.one" : "tools.cut.many", { count })}
          </button>
        )}
      </div>
      <Switch
        label={say("tools.what-if")}
        help={say("tools.what-if.help")}
        value={prune?.predicts.value === true}
        standard={false}
        onCommit={(on) => {
          if (prune) {
            prune.predicts.value = on;
          }
        }}
      />
      <Slider
        label={say("tools.dim")}
        help={say("tools.dim.help")}
        unit="%"
        least={0}
        most={BRIGHTEST}
        step={1}
        value={percent}
        standard={0}
        inWords={(percent) =>
          percent === 0
            ? say("tools.dim.none")
            : say(count === 1 ? "tools.dim.one" : "tools.dim.many", { percent, count })
        }
        onDrag={setPercent}
        onCommit={setPercent}
      />
    </Options>
  );
}
