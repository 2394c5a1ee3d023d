import { ToolOptions } from "../../ui/bars/tool-options";
import { say } from "../../words/say";
import type { ToolTopic, ToolViewProps } from "../descriptor";
import type { WidthTool } from "./width-tool";

export { WidthRings as Marks } from "../../ui/overlays/width-rings";

export const HELP: readonly ToolTopic[] = [
  {
    name: "width",
    title: ["Width", "Dicke"],
    text: [
      "Pinch around a limb, or tap it and pull the ring",
      "Den Ast zwischen zwei Finger nehmen, oder antippen und am Ring ziehen",
    ],
    words: [
      "thick girth diameter trunk thicker thinner fat slim",
      "dick Umfang Durchmesser Stamm dicker dünner schlank",
    ],
  },
];

/** What to do, and how many widths are set. */
export function Options({ tool: width }: ToolViewProps<WidthTool>) {
  const set = width.widths.value.length;
  return (
    <ToolOptions label={say("tools.widths")}>
      <p class="tool-hint">
        {width.chosen.value !== null ? say("tools.widths.chosen") : say("tools.widths.none-chosen")}
      </p>
      <span class="quiet">
        {say(set === 0 ? "tools.widths.none" : set === 1 ? "tools.widths.one" : "tools.widths.many", { count: set })}
      </span>
    </ToolOptions>
  );
}
