import { signal } from "@preact/signals";
import { expect, it } from "vitest";
import type { Command } from "../../wire/generated";
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
  const pending = signal({ pending_steps: 7 });
  const page = {
    layout,
    document: pending,
    outline: { shown: signal(null) },
    growth: { deflection: signal(0), release: () => {} },
    submit: ({ kind }: Command) => {
      pending.value = { pending_steps: kind === "stop" ? 0 : 7 };
    },
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
      endGrowth: () => {},
      choose: (tool: ToolName) => (chosen.value = tool),
    },
    bud: { row: bud, release: () => (bud.value = null) },
  } as unknown as StepBackTargets;
  const left = () =>
    [
      layout.bare.value && "bare",
      rows.value !== null && "prediction",
      drawing.value && "drawing",
      pending.value.pending_steps > 0 && "growth",
      marked && "mark",
      chosen.value !== FIRST_TOOL && "tool",
      bud.value !== null && "bud",
      layout.panel.value !== null && "panel",
    ].filter(Boolean);
  const all = ["bare", "prediction", "drawing", "growth", "mark", "tool", "bud", "panel"];
  expect(left()).toEqual(all);
  for (let steps = 1; steps <= all.length; steps += 1) {
    stepBack(page);
    expect(left()).toEqual(all.slice(steps));
  }
});
