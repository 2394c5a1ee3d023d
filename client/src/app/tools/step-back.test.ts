import { signal } from "@preact/signals";
import { expect, it } from "vitest";
import { Layout } from "../page/layout";
import { type StepBackTargets, stepBack } from "./step-back";
import { FIRST_TOOL, type ToolName } from "./tools";

it("steps back from one thing at a time, the nearest first", () => {
  const layout = new Layout();
  layout.bare.value = true;
  layout.panel.value = "leaves";
  const [rows, drawing, chosen, bud] = [
    signal<readonly number[] | null>([3]),
    signal(true),
    signal<ToolName>("bend"),
    signal<number | null>(4),
  ];
  let marked = true;
  const page = {
    layout,
    branches: { prediction: { rows, discard: () => (rows.value = null) } },
    tools: {
      drawing,
      chosen,
      cancel: () => (drawing.value = false),
      release: () => {
        const any = marked;
        marked = false;
        return any;
      },
      choose: (tool: ToolName) => (chosen.value = tool),
    },
    bud: { row: bud, release: () => (bud.value = null) },
  } as unknown as StepBackTargets;
  const left = () =>
    [
      layout.bare.value && "bare",
      rows.value !== null && "prediction",
      drawing.value && "drawing",
      marked && "mark",
      chosen.value !== FIRST_TOOL && "tool",
      bud.value !== null && "bud",
      layout.panel.value !== null && "panel",
    ].filter(Boolean);
  const all = ["bare", "prediction", "drawing", "mark", "tool", "bud", "panel"];
  expect(left()).toEqual(all);
  for (let steps = 1; steps <= all.length; steps += 1) {
    stepBack(page);
    expect(left()).toEqual(all.slice(steps));
  }
});
