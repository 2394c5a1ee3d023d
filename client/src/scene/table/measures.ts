/** What plants are measured from. */
interface Rows {
  readonly rows: number;
  readonly position: ArrayLike<number>;
  readonly parent: ArrayLike<number>;
  /** 0 for the dead. */
  readonly radiusCode: ArrayLike<number>;
  /** Steps of growth up to each birth. */
  readonly born: ArrayLike<number>;
}

/** How large and how old plants are. */
export interface Measures {
  /** From the ground to the highest node, in internodes. */
  readonly height: number;
  /** The widest plant along one of the ground's two axes, in internodes. */
  readonly spread: number;
  /** From the oldest seed to the youngest wood on it, in steps of growth. */
  readonly age: number;
}

/** The measures of the living wood; null where there is none. */
export function measuresOf({ rows, position, parent, radiusCode, born }: Rows): Measures | null {
  const seedOf = new Int32Array(rows);
  const widths = new Map<number, { readonly low: [number, number]; readonly high: [number, number] }>();
  let [height, age] = [0, 0];
  for (let row = 0; row < rows; row += 1) {
    const bearer = parent[row]!;
    seedOf[row] = bearer < 0 ? row : seedOf[bearer]!;
    if (bearer < 0 || radiusCode[row] === 0) continue;
    const [x, y, z] = [position[3 * row]!, position[3 * row + 1]!, position[3 * row + 2]!];
    const seed = seedOf[row]!;
    const width = widths.get(seed) ?? { low: [x, z], high: [x, z] };
    widths.set(seed, width);
    [x, z].forEach((place, axis) => {
      width.low[axis] = Math.min(width.low[axis]!, place);
      width.high[axis] = Math.max(width.high[axis]!, place);
    });
    height = Math.max(height, y);
    age = Math.max(age, born[row]! - born[seed]!);
  }
  if (widths.size === 0) return null;
  const spreads = [...widths.values()].map(({ low, high }) => Math.max(high[0] - low[0], high[1] - low[1]));
  return { height, spread: Math.max(...spreads), age };
}
