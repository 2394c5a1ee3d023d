import type { TreeTable } from "../table/tree-table";
import type { Look, Overlay, SlotAssignment, SlotWriter } from "./overlays";

/** Branches that are about to be cut, or are cut and not yet gone from the table. */
export class CutOverlay implements Overlay {
  readonly slots = 1;

  /** `rows` are those that the branches begin with. */
  constructor(
    readonly rows: readonly number[],
    readonly look: Exclude<Look, "plain">,
  ) {}

  *assignments(): Iterable<SlotAssignment> {
    for (const row of this.rows) yield { row, slot: 0, own: false, above: 0 };
  }

  write(_table: TreeTable, out: SlotWriter): void {
    out.plain(0);
    out.look(0, this.look);
  }

  over(table: TreeTable): boolean {
    return this.rows.every((row) => row >= table.rows || table.radiusCode[row] === 0);
  }
}
