import type { Overlay } from "../src/scene/overlay/overlays";
import type { TreeTable } from "../src/scene/table/tree-table";
import type { Vec3 } from "../src/scene/vector";
import { MIN_RADIUS, RADIUS_LOG_STEP } from "../src/wire/generated";
import { PlainTable } from "./plain-table";

/** A metamer of a small tree: its parent's row, where it ends, and what else is not as usual. */
export interface Twig {
  readonly parent: number;
  readonly at: readonly [number, number, number];
  readonly begins?: boolean;
  readonly light?: number;
  readonly radius?: number;
  readonly dead?: boolean;
}

/**
 * A trunk of five (rows 1 to 5) with a limb of four to the right from row 2 (6 to 9), which bears a twig (10, 11) at
 * row 7, and a twig to the left from row 3 (12, 13).
 */
export const SMALL: readonly Twig[] = [
  { parent: -1, at: [0, 0, 0] },
  ...[1, 2, 3, 4, 5].map((y) => ({ parent: y - 1, at: [0, y, 0] as const, radius: 0.5 })),
  { parent: 2, at: [1, 2, 0], begins: true, radius: 0.3 },
  ...[2, 3, 4].map((x) => ({ parent: x + 4, at: [x, 2, 0] as const, radius: 0.3 })),
  { parent: 7, at: [2, 3, 0], begins: true, light: 20 },
  { parent: 10, at: [2, 4, 0], light: 30 },
  { parent: 3, at: [-1, 3, 0], begins: true, light: 10 },
  { parent: 12, at: [-2, 3, 0], light: 10 },
];

/** A table with these metamers, quantised as the server would. */
export function tableOf(twigs: readonly Twig[], table = new PlainTable(() => 0)): TreeTable {
  const step = (value: number) => Math.round(256 * value);
  const rows = {
    parent: Uint32Array.from(twigs, ({ parent, begins }, row) =>
      parent < 0 ? 0 : 2 * (row - parent) + (begins ? 1 : 0),
    ),
    position: Int32Array.from(
      twigs.flatMap(({ parent, at }) => at.map((x, axis) => step(x) - step(twigs[parent]?.at[axis] ?? 0))),
    ),
    radius: Uint16Array.from(twigs, ({ parent, radius = 0.1, dead }) =>
      parent < 0 || dead ? 0 : 1 + Math.round(Math.log(radius / MIN_RADIUS) / RADIUS_LOG_STEP),
    ),
    foliage: Uint8Array.from(twigs, () => 0),
    light: Uint8Array.from(twigs, ({ light = 200 }) => light),
    born: Uint32Array.from(twigs, (_, row) => row),
  };
  const sequence = (table.sequence ?? 0) + 1;
  table.apply({ epoch: 1, sequence, catchUp: true, changes: [{ change: "replace", chunk: 0, generation: 1, rows }] });
  return table;
}

/** A view straight from the front in which an internode is 100 pixels, the origin at (500, 900). */
export function frontView(table: TreeTable) {
  const overlays = new Set<Overlay>();
  /** A wind that carries all wood as far to the right, in internodes, and what it was told. */
  const wind = { carries: 0, blowing: true, sways: true, released: [] as number[][], cuts: [] as number[][] };
  const placeOf = (row: number) =>
    [table.position[3 * row]!, table.position[3 * row + 1]!, table.position[3 * row + 2]!] as const;
  const glass = ([x, y]: readonly number[]) => [500 + 100 * x!, 900 - 100 * y!] as const;
  const seenAt = (row: number) => {
    const [x, y, z] = placeOf(row);
    return [x + wind.carries, y, z] as const;
  };
  return {
    overlays,
    placeOf,
    seenAt,
    wind,
    air: {
      get sways() {
        return wind.sways;
      },
      release: (rows: readonly number[]) => void wind.released.push([...rows]),
      cut: (rows: readonly number[]) => void wind.cuts.push([...rows]),
    },
    glass,
    pointOnPlane: (x: number, y: number, through: readonly number[]) =>
      [(x - 500) / 100, (900 - y) / 100, through[2]!] as const,
    projector: () => glass,
    /** The living row whose end is nearest, within the tolerance. */
    pick(x: number, y: number, tolerance: number) {
      let best: { row: number; point: Vec3; seen: Vec3 } | null = null;
      let least = tolerance;
      for (let row = 1; row < table.rows; row += 1) {
        const [px, py] = glass(seenAt(row));
        const gap = Math.hypot(px - x, py - y);
        if (table.radiusCode[row] !== 0 && gap <= least) {
          best = { row, point: placeOf(row), seen: seenAt(row) };
          least = gap;
        }
      }
      return best;
    },
    addOverlay: (overlay: Overlay) => void overlays.add(overlay),
    removeOverlay: (overlay: Overlay) => void overlays.delete(overlay),
    hasOverlay: (overlay: Overlay) => overlays.has(overlay),
    overlayChanged: () => {},
  };
}
