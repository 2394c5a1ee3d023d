import { TreeTable } from "../src/scene/table/tree-table";

/** A table whose frames hold differences to the parents' positions and new values, not what would be told of them. */
export class PlainTable extends TreeTable {
  constructor(clock?: () => number) {
    super(clock, {
      turn: (way, values, at) => way.set(values.subarray(at, at + 3)),
      radius: (_, value) => value,
      foliage: (_, value) => value,
      light: (_, value) => value,
    });
  }
}
