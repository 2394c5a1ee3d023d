import type { TreeTable } from "../table/tree-table";
import { INHERIT, type Look, type Overlay, type SlotAssignment, type SlotWriter } from "./overlays";

/** Single metamers that are drawn to stand out, whatever grows on them. */
export class RowsOverlay implements Overlay {
  readonly slots = 1;

  constructor(
    readonly rows: readonly number[],
    readonly look: Exclude<Look, "plain">,
  ) {}

  *assignments(): Iterable<SlotAssignment> {
    for (const row of this.rows) yield { row, slot: 0, own: false, above: INHERIT };
  }

  write(_table: TreeTable, out: SlotWriter): void {
    out.plain(0);
    out.look(0, this.look);
  }

  /** Whoever shows it takes it away: rows that are gone may come back with the depth. */
  over(): boolean {
    return false;
  }
}
