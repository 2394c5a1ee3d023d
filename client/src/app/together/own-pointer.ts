import type { Vec3 } from "../../scene/vector";
import type { Viewport } from "../../scene/viewport";
import type { Pointer } from "../../wire/generated";
import { nearestBase } from "../view/places";
import { place, within } from "./cameras";
import type { Wood } from "./others";
import { besideWood } from "./wood-place";

/** A pointer is on wood that is so near, in pixels. */
const NEAR = 24;
/** The farthest that an offset from wood may be (LM20). */
const FARTHEST_OFFSET = 16;

type Table = Parameters<typeof nearestBase>[0];

/** Where this page points at a place of the canvas: on the wood there, else on the plane through the nearest plant. */
export function pointerAt(x: number, y: number, view: Viewport, table: Table, wood: Wood): Pointer | null {
  const picked = view.pick(x, y, NEAR);
  const on = picked && onWoodAt(picked.row, picked.point, wood);
  if (on) {
    return on;
  }
  const at = view.pointOnPlane(x, y, nearestBase(table, view, x, y));
  return at && { kind: "space", position: place(at) };
}

function onWoodAt(row: number, point: Vec3, wood: Wood): Pointer | null {
  const [end, parent] = [wood.placeOf(row), wood.parentOf(row)];
  const begin = parent < 0 ? null : wood.placeOf(parent);
  if (!end || !begin) {
    return null;
  }
  const { along, offset } = besideWood(point, begin, end);
  const steps = (value: number) => within(Math.round(value * 32) / 32, -FARTHEST_OFFSET, FARTHEST_OFFSET);
  return {
    kind: "wood",
    row,
    along: Math.round(along * 255) / 255,
    offset: [steps(offset[0]), steps(offset[1]), steps(offset[2])],
  };
}

/** So many places of a line, evenly. */
export function thinned<Place>(line: readonly Place[], most: number): readonly Place[] {
  if (line.length <= most) {
    return line;
  }
  return Array.from({ length: most }, (_, i) => line[Math.round((i * (line.length - 1)) / (most - 1))]!);
}
