import { ToolOptions } from "../../ui/bars/tool-options";
import { Slider } from "../../ui/controls/slider";
import { CloseIcon } from "../../ui/icons";
import { say } from "../../words/say";
import type { ToolTopic, ToolViewProps } from "../descriptor";
import type { BendTool } from "./bend-tool";

export { BendMarks as Marks } from "../../ui/overlays/bend-marks";

export const HELP: readonly ToolTopic[] = [
  {
    name: "bend",
    title: ["Bend", "Biegen"],
    text: [
      "One finger holds the base, another drags the end, more between. With a mouse or pen drag a branch; click first where it shall bend from",
      "Ein Finger hält den Ansatz, ein anderer zieht das Ende, weitere dazwischen. Mit Maus oder Stift am Ast ziehen; vorher anklicken, von wo an er sich biegen soll",
    ],
    words: ["curve stretch form pull warp pose", "krümmen dehnen formen ziehen verformen verbiegen"],
  },
];

export const CONTROLS = ["tools.stretch"] as const;

/** How far a branch stretches before anyone has said so, in percent. */
const USUAL_STRETCH = 30;

/** What is held of a branch, and how far it stretches. */
export function Options({ tool: bend, page }: ToolViewProps<BendTool>) {
  const { stretch } = page.settings;
  const marked = bend.base.value !== null;
  const set = (percent: number) => {
    stretch.value = percent / 100;
  };
  return (
    <ToolOptions label={say("tools.bending")}>
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
          onClick={() => bend.release()}
        >
          <CloseIcon />
        </button>
      )}
    </ToolOptions>
  );
}
