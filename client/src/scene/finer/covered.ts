import { type Mesh, type Object3D, Vector3 } from "three";
import { leafHash } from "../leaf-hash";

/** Of what reaches below one height and above the other, in internodes, the ground is covered. */
const HIGH = 0.45;
const LOW = -0.3;
/** Grass keeps this far from its edge, in cells. */
const KEEPS = 0.6;

/** A square of the ground as a number, from its column and its line. */
export const cellOf = (column: number, line: number) => column * 65_536 + line;

/** From a square to those beside it. */
const AROUND = [cellOf(1, 0), cellOf(-1, 0), cellOf(0, 1), cellOf(0, -1)] as const;

/** The squares of the ground, so wide, in which something lies: grass does not grow through it. */
export function coveredCells(bodies: readonly Object3D[], side: number): Set<number> {
  const covered = new Set<number>();
  const corners = [new Vector3(), new Vector3(), new Vector3()] as const;
  for (const { geometry, matrixWorld } of bodies as readonly Mesh[]) {
    const { position } = geometry.attributes;
    const index = geometry.getIndex();
    if (!position || !index) continue;
    for (let at = 0; at < index.count; at += 3) {
      for (const [n, corner] of corners.entries()) {
        corner.fromBufferAttribute(position, index.getX(at + n)).applyMatrix4(matrixWorld);
      }
      const heights = corners.map(({ y }) => y);
      if (Math.min(...heights) < HIGH && Math.max(...heights) > LOW) cover(covered, corners, side);
    }
  }
  return covered;
}

/** Whether no grass grows in a square: over an edge that lies low it does here and there, and a few tufts behind it. */
export function isBare(covered: ReadonlySet<number>, cell: number): boolean {
  if (!covered.has(cell)) return false;
  const open = (cell: number) => AROUND.some((step) => !covered.has(cell + step));
  const chance = leafHash(cell) & 255;
  if (chance < 70) return true;
  return !open(cell) && (chance < 200 || !AROUND.some((step) => open(cell + step)));
}

/** Adds the squares whose middles lie in a triangle seen from above, or hardly outside it. */
function cover(covered: Set<number>, corners: readonly [Vector3, Vector3, Vector3], side: number): void {
  const x = corners.map((corner) => corner.x / side) as [number, number, number];
  const z = corners.map((corner) => corner.z / side) as [number, number, number];
  const area = (x[1] - x[0]) * (z[2] - z[0]) - (x[2] - x[0]) * (z[1] - z[0]);
  if (Math.abs(area) < 1e-6) return;
  const turn = Math.sign(area);
  const [left, right] = [Math.floor(Math.min(...x) - KEEPS), Math.floor(Math.max(...x) + KEEPS)];
  const [near, far] = [Math.floor(Math.min(...z) - KEEPS), Math.floor(Math.max(...z) + KEEPS)];
  for (let line = near; line <= far; line += 1) {
    for (let column = left; column <= right; column += 1) {
      const inside = [0, 1, 2].every((a) => {
        const b = (a + 1) % 3;
        const [dx, dz] = [x[b]! - x[a]!, z[b]! - z[a]!];
        const off = dx * (line + 0.5 - z[a]!) - dz * (column + 0.5 - x[a]!);
        return turn * off >= -KEEPS * Math.hypot(dx, dz);
      });
      if (inside) covered.add(cellOf(column, line));
    }
  }
}
