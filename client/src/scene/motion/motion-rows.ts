import type { TreeTable } from "../table/tree-table";
import type { MotionRows } from "./limbs";

/** A copy of what joints are made from, for a worker. Which row goes on as the same limb, the table knows. */
export function motionRows({ rows, parent, limbs, quantised, radiusCode, foliage }: TreeTable): MotionRows {
  return {
    parent: parent.slice(0, rows),
    onward: limbs.onward.slice(0, rows),
    quantised: quantised.slice(0, 3 * rows),
    radiusCode: radiusCode.slice(0, rows),
    leaves: foliage.slice(0, rows).map((each) => each & 15),
  };
}
