import type { Vec3 } from "../../../scene/vector";
import type { ToolPage } from "../../tools/descriptor";

/** Corners of a ring. */
const CORNERS = 36;
/** A ring is never smaller on the screen than this, in pixels, and stands so far off the bark. */
const LEAST_RING = 9;
const OFF_THE_BARK = 1.12;
/** Where a ring lies on the screen: what is in front of the limb, what behind it, and its ends across the limb. */
export interface Ring {
  readonly front: string;
  readonly back: string;
  readonly middle: readonly [number, number];
  readonly ends: readonly [readonly [number, number], readonly [number, number]];
}

/** The ring around a limb as it is seen. */
export function ringAt(
  { stage, table }: Pick<ToolPage, "stage" | "table">,
  row: number,
  diameter: number,
): Ring | null {
  const project = stage.projector();
  const axes = stage.screenAxes();
  const middle = stage.seenAt(row);
  const below = stage.seenAt(table.parent[row] ?? row);
  const spot = middle && project?.(middle);
  if (!project || !axes || !middle || !below || !spot) {
    return null;
  }
  const along = unit([middle[0] - below[0], middle[1] - below[1], middle[2] - below[2]]) ?? [0, 1, 0];
  const [right, , out] = axes;
  // Across the limb as it is seen, and then towards the eye.
  const across = unit(cross(along, out)) ?? right;
  const deep = cross(across, along);
  const towards = deep[0] * out[0] + deep[1] * out[1] + deep[2] * out[2] < 0 ? -1 : 1;
  const scale = stage.scaleAt(middle);
  const radius = Math.max((OFF_THE_BARK * diameter) / 2, LEAST_RING / Math.max(scale, 1e-3));
  const corner = (angle: number): readonly [number, number] => {
    const [c, s] = [radius * Math.cos(angle), radius * Math.sin(angle) * towards];
    return (
      project([
        middle[0] + across[0] * c + deep[0] * s,
        middle[1] + across[1] * c + deep[1] * s,
        middle[2] + across[2] * c + deep[2] * s,
      ]) ?? spot
    );
  };
  const half = (from: number) =>
    Array.from({ length: CORNERS / 2 + 1 }, (_, i) => corner(from + (2 * Math.PI * i) / CORNERS));
  const path = (points: (readonly [number, number])[]) =>
    `M${points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L")}`;
  const ends = [corner(Math.PI), corner(0)] as const;
  const ordered = ends[0][0] <= ends[1][0] ? ends : ([ends[1], ends[0]] as const);
  return { front: path(half(0)), back: path(half(Math.PI)), middle: spot, ends: ordered };
}

function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function unit(a: Vec3): Vec3 | null {
  const length = Math.hypot(a[0], a[1], a[2]);
  return length < 1e-6 ? null : [a[0] / length, a[1] / length, a[2] / length];
}
