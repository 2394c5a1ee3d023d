import type { TreeTable } from "../../scene/table/tree-table";
import type { Frame } from "../../wire/frame";
import type { Resume } from "../../wire/generated";

/** What the connection needs of the rows the server has sent; `scene/table/tree-table.ts` provides it. */
export interface RowStore<Frame> {
  /** What is held, if anything, for a resume (`RS1`). */
  held(): Resume | undefined;
  /** Takes in a frame; throws where it does not fit what is held. */
  apply(frame: Frame): void;
  /** Forgets every row. */
  clear(): void;
  /** How many rows are held, and what they add up to (`CK1`); null where nobody looks at them. No frame is to be taken in meanwhile. */
  sum(): Promise<RowSum | null>;
}

export interface RowSum {
  readonly rows: number;
  readonly crc32: number;
}

/** The table of rows as the connection sees it. */
export function rowStore(table: TreeTable): RowStore<Frame> {
  return {
    held: () =>
      table.epoch !== 0 && table.rows > 0
        ? { epoch: table.epoch, generations: table.generations(), rows: table.rows }
        : undefined,
    apply: (frame) => table.apply(frame),
    clear: () => table.clear(),
    sum: async () => {
      const { checksumOf } = await import("../../scene/table/checksum");
      return { rows: table.rows, crc32: checksumOf(table) };
    },
  };
}
