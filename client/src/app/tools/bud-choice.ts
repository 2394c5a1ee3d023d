import { axisStart } from "../../scene/table/branch-rows";
import type { TreeTable } from "../../scene/table/tree-table";
import type { Stage } from "../view/stage";
import type { ChosenBud } from "./chosen-bud";
import { PICK_TOLERANCE } from "./tool";

interface BudChoice {
  readonly stage: Pick<Stage, "pickRow" | "hideBrush">;
  readonly table: TreeTable;
  readonly bud: ChosenBud;
}

/** Chooses the branch at a place, so that it alone grows; where there is none, or the same, every branch grows. */
export function chooseBud({ stage, table, bud }: BudChoice, x: number, y: number): void {
  const picked = stage.pickRow(x, y, PICK_TOLERANCE);
  const before = bud.row.peek();
  const axis = (row: number) => axisStart(table, row);
  if (picked === null || (before !== null && axis(picked) === axis(before))) {
    bud.release();
    return;
  }
  bud.choose(picked);
  stage.hideBrush();
  // Where the device can, the user feels that the hold is over.
  navigator.vibrate?.(12);
}
