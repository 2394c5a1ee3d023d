import { Vector3 } from "three";
import type { DyeColours, DyedBlock } from "../../wire/generated";
import { grown } from "./column";
import type { TreeTable } from "./tree-table";

/** Numbers that the dye of a row can have; the first says that it has none. */
export const DYES = 16;

/** The colours that designs say of branches, as the server tells them (`DS14`). */
export interface Dyed {
  readonly dyes: readonly DyeColours[];
  readonly blocks: readonly DyedBlock[];
}
export const UNDYED: Dyed = { dyes: [], blocks: [] };

/** The dye of each row: that of its block, or else of the row that bears it. */
export class RowDyes {
  /** For the shaders' `uDyes`. */
  readonly uniform = { value: Array.from({ length: 2 * DYES }, () => new Vector3(1, 1, 1)) };
  private told: Dyed = UNDYED;
  private numbers = new Uint8Array(0);
  private stale = false;

  /** Takes other dyes over. */
  tell(told: Dyed): void {
    this.told = told;
    this.stale = true;
    for (let dye = 1; dye < DYES; dye += 1) {
      const colours = told.dyes[dye - 1];
      this.uniform.value[dye]!.set(...(colours?.bark ?? [1, 1, 1]));
      this.uniform.value[DYES + dye]!.set(...(colours?.leaves ?? [1, 1, 1]));
    }
  }

  /** The dye of a row, as it was found last. */
  of(row: number): number {
    return this.numbers[row] ?? 0;
  }

  /** Rows from `rows` on are gone; others may take their numbers. */
  truncate(rows: number): void {
    this.numbers.fill(0, rows);
  }

  /** Finds the dye of each row after the table or the dyes have changed, and calls `changed` for each row that gets another one. */
  assign(table: TreeTable, changed: (row: number) => void, tableChanged: boolean): void {
    const { blocks } = this.told;
    if (!this.stale && !(tableChanged && blocks.length > 0)) return;
    this.stale = false;
    const { rows, parent } = table;
    this.numbers = grown(this.numbers, parent.length);
    const from = blocks[0]?.first ?? rows;
    const give = (row: number, dye: number) => {
      if (this.numbers[row] === dye) return;
      this.numbers[row] = dye;
      changed(row);
    };
    for (let row = 0; row < Math.min(from, rows); row += 1) give(row, 0);
    let row = from;
    const inherit = (until: number) => {
      for (; row < until; row += 1) {
        const below = parent[row]!;
        give(row, below >= 0 ? this.numbers[below]! : 0);
      }
    };
    for (const { first, runs } of blocks) {
      inherit(Math.min(first, rows));
      for (const [count, dye] of runs) {
        for (const end = Math.min(row + count, rows); row < end; row += 1) give(row, dye);
      }
    }
    inherit(rows);
  }
}
