import type { ToolViewProps } from "../../tools/descriptor";
import type { PruneTool } from "../../tools/prune/prune-tool";

/** The line that is drawn through what shall be cut. */
export function CutLineMark({ tool }: ToolViewProps<PruneTool>) {
  const line = tool.line.value;
  if (line === null || line.length < 2) {
    return null;
  }
  const path = `M${line.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L")}`;
  return (
    <svg class="overlay cut-line-mark" aria-hidden="true">
      <path class="cut-line-casing" d={path} />
      <path class="cut-line-way" d={path} />
    </svg>
  );
}
