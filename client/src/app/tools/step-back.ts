import { type GrowthSources, isGrowing, stopGrowth } from "../document/growth/under-way";
import type { Layout } from "../page/layout";
import type { BranchWork } from "./branch/branch-work";
import type { ChosenBud } from "./chosen-bud";
import type { Toolbox } from "./toolbox";
import { FIRST_TOOL } from "./tools";

/** The parts of a page that a step back may concern. */
export interface StepBackTargets extends GrowthSources {
  readonly layout: Layout;
  readonly branches: { readonly prediction: Pick<BranchWork["prediction"], "rows" | "discard"> };
  readonly tools: Pick<Toolbox, "drawing" | "chosen" | "cancel" | "release" | "choose" | "endGrowth">;
  readonly bud: Pick<ChosenBud, "row" | "release">;
}

/** Steps back from what is nearest: a drawing, growth, a tool, a choice, a panel. */
export function stepBack(page: StepBackTargets): void {
  const { layout, branches, tools, bud } = page;
  if (layout.bare.peek()) {
    layout.bare.value = false;
  } else if (branches.prediction.rows.peek() !== null) {
    branches.prediction.discard();
  } else if (tools.drawing.peek()) {
    tools.cancel();
  } else if (isGrowing(page)) {
    stopGrowth(page);
  } else if (tools.release()) {
    // What the tool had marked was nearest.
  } else if (tools.chosen.peek() !== FIRST_TOOL) {
    tools.choose(FIRST_TOOL);
  } else if (bud.row.peek() !== null) {
    bud.release();
  } else {
    layout.panel.value = null;
  }
}
