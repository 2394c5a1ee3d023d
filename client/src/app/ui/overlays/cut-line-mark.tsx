import type { Studio } from "../../studio";

/** The line that is drawn through what shall be cut. */
export function CutLineMark({ studio }: { studio: Studio }) {
  const line = studio.tools.shaping.value?.prune.line.value ?? null;
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
