import { radiusOf, type TreeTable } from "../table/tree-table";
import type { Vec3 } from "../vector";
import { CROWN_SIDE, type CrownOrder } from "./crown-field";

/** What leaves take up beyond the nodes that bear them, in internodes. */
const MARGIN = 2.5;
/** Area of a leaf, of that of a square as long. */
const BLADE = 0.55;

/** A crown's cells, and where they lie. */
export interface CrownBox {
  readonly order: CrownOrder;
  readonly from: Vec3;
  readonly size: Vec3;
}

/** Sorts the leaves of a tree, so long each, and its wood into the cells of a box around it. */
export function crownOf(table: TreeTable, leaf: number): CrownBox {
  const { min, max } = table.bounds();
  const from = [min[0] - MARGIN, min[1] - MARGIN, min[2] - MARGIN] as const;
  const size = [max[0] - from[0] + MARGIN, max[1] - from[1] + MARGIN, max[2] - from[2] + MARGIN] as const;
  const cell = [size[0] / CROWN_SIDE, size[1] / CROWN_SIDE, size[2] / CROWN_SIDE] as const;
  const area = new Float32Array(CROWN_SIDE ** 3);
  const { position, parent, radiusCode, foliage, rows } = table;
  for (let row = 0; row < rows; row += 1) {
    const code = radiusCode[row]!;
    const before = parent[row]!;
    if (code === 0 || before < 0) continue;
    const x = position[3 * row]!;
    const y = position[3 * row + 1]!;
    const z = position[3 * row + 2]!;
    const length = Math.hypot(x - position[3 * before]!, y - position[3 * before + 1]!, z - position[3 * before + 2]!);
    const much = BLADE * (foliage[row]! & 15) * leaf * leaf + 2 * radiusOf(code) * length;
    spread(area, (x - from[0]) / cell[0], (y - from[1]) / cell[1], (z - from[2]) / cell[2], much);
  }
  return { order: { area, cell }, from, size };
}

/** Shares what is at a place, in cells, out among the eight whose middles are nearest. */
function spread(area: Float32Array, x: number, y: number, z: number, much: number): void {
  const [i, j, k] = [Math.floor(x - 0.5), Math.floor(y - 0.5), Math.floor(z - 0.5)];
  const [u, v, w] = [x - 0.5 - i, y - 0.5 - j, z - 0.5 - k];
  for (let corner = 0; corner < 8; corner += 1) {
    const [a, b, c] = [corner & 1, (corner >> 1) & 1, corner >> 2];
    const share = (a ? u : 1 - u) * (b ? v : 1 - v) * (c ? w : 1 - w);
    const at = ((k + c) * CROWN_SIDE + j + b) * CROWN_SIDE + i + a;
    if (at >= 0 && at < area.length) area[at]! += share * much;
  }
}
