/** What is asked of the table. */
interface Rows {
  readonly rows: number;
  readonly parent: ArrayLike<number>;
  /** 1 where a row begins an axis. */
  readonly startsAxis: ArrayLike<number>;
  /** 0 for the dead. */
  readonly radiusCode: ArrayLike<number>;
}

/** The row at which the axis of a row begins. */
export function axisStart(table: Rows, row: number): number {
  let first = row;
  for (;;) {
    const parent = table.parent[first] ?? -1;
    if (table.startsAxis[first] === 1 || parent < 0 || table.parent[parent]! < 0) {
      return first;
    }
    first = parent;
  }
}

/** The living rows of the axis a row belongs to, from its base to its tip. */
export function axisRows(table: Rows, row: number): number[] {
  const found = [axisStart(table, row)];
  for (let next = found[0]! + 1; next < table.rows; next += 1) {
    const follows = table.parent[next] === found[found.length - 1] && table.startsAxis[next] === 0;
    if (follows && table.radiusCode[next] !== 0) {
      found.push(next);
    }
  }
  return found;
}

/** The rows from one up to another above it, both included; null if it is not above. */
export function pathUp(table: Pick<Rows, "parent">, base: number, top: number): number[] | null {
  const path: number[] = [];
  for (let row = top; row >= base; row = table.parent[row]!) {
    path.push(row);
    if (row === base) return path.reverse();
  }
  return null;
}

/** The living rows of the axis a row belongs to and of all it bears, parents first; at most `most`. */
export function branchRows(table: Rows, row: number, most: number): number[] {
  return subtreeRows(table, axisStart(table, row), most);
}

/** A row and the living rows above it, parents first; at most `most`. */
export function subtreeRows(table: Rows, first: number, most: number): number[] {
  const on = new Uint8Array(table.rows - first);
  on[0] = 1;
  const found = [first];
  for (let next = first + 1; next < table.rows && found.length < most; next += 1) {
    const parent = table.parent[next]! - first;
    if (parent >= 0 && on[parent] === 1 && table.radiusCode[next] !== 0) {
      on[next - first] = 1;
      found.push(next);
    }
  }
  return found;
}
