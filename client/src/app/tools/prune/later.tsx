import { useEffect, useState } from "preact/hooks";
import { ToolOptions } from "../../ui/bars/tool-options";
import { Slider } from "../../ui/controls/slider";
import { Switch } from "../../ui/controls/switch";
import { say } from "../../words/say";
import type { ToolTopic, ToolViewProps } from "../descriptor";
import type { PruneTool } from "./prune-tool";

export { CutLineMark as Marks } from "../../ui/overlays/cut-line-mark";

export const HELP: readonly ToolTopic[] = [
  {
    name: "prune",
    title: ["Prune", "Schneiden"],
    text: ["Tap a branch, or draw a line through many", "Einen Ast antippen oder eine Linie durch mehrere ziehen"],
    words: [
      "cut remove delete shears eraser erase rubber trim clip scissors saw",
      "abschneiden entfernen löschen Schere Radiergummi radieren stutzen kappen Säge",
    ],
  },
  {
    name: "what-if",
    title: ["What if?", "Was wäre, wenn?"],
    text: [
      "A ghost shows how the tree grows on without a branch",
      "Ein Schemen zeigt, wie der Baum ohne einen Ast weiterwächst",
    ],
    words: ["predict ghost preview simulate try", "vorhersagen Vorschau Schemen ausprobieren"],
  },
];

export const CONTROLS = ["tools.what-if", "tools.dim"] as const;

/** Below this share of full light, in percent, is the dark; the slider's whole way. */
const BRIGHTEST = 60;

/** Whether cuts are only shown, and what stands in the dark. */
export function Options({ tool: prune, page }: ToolViewProps<PruneTool>) {
  const [percent, setPercent] = useState(0);
  const [count, setCount] = useState(0);
  const exposure = percent / 100;
  const revision = page.revision.value;
  // What is marked follows the tree, and is unmarked with the tool.
  useEffect(() => {
    setCount(prune.markDim(exposure > 0 ? exposure : null) ?? 0);
  }, [prune, exposure, revision]);
  useEffect(() => () => void prune.markDim(null), [prune]);
  return (
    <ToolOptions label={say("tools.pruning")}>
      <div class="tool-lead">
        <p class="tool-hint">{say("tools.pruning.hint")}</p>
        {percent > 0 && (
          <button
            type="button"
            class="primary danger"
            disabled={count === 0}
            onClick={() => {
              prune.cutDim(exposure);
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
        value={prune.predicts.value}
        standard={false}
        onCommit={(on) => {
          prune.predicts.value = on;
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
    </ToolOptions>
  );
}
