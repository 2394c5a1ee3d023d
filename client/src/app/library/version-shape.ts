import { askFor } from "../requests/request";

/** So many points of a version say how large it is, to some hundredths. */
const POINTS = 4000;
/** Bytes of each type of a property that the files have. */
const SIZES: Readonly<Record<string, number>> = { float: 4, uint: 4, uchar: 1 };

/** The box around a tree, in metres: x y z. */
export interface Shape {
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
}

/** How large a version is. */
export async function shapeOfVersion(tree: string, number: number, stop: AbortSignal): Promise<Shape | null> {
  const path = `${versionPath(tree, number)}/tree.ply?points=${POINTS}`;
  return shapeOfPoints(await (await askFor("GET", path, undefined, { signal: stop })).arrayBuffer());
}

export function versionPath(tree: string, number: number): string {
  return `/api/v1/trees/${encodeURIComponent(tree)}/versions/${number}`;
}

/** The box around the points of a PLY file; null where it has none, or is none of ours. */
export function shapeOfPoints(file: ArrayBuffer): Shape | null {
  const head = /^ply\n[\s\S]*?end_header\n/.exec(new TextDecoder("latin1").decode(file.slice(0, 2048)))?.[0];
  if (!head?.includes("format binary_little_endian 1.0")) {
    return null;
  }
  const count = Number(/element vertex (\d+)/.exec(head)?.[1] ?? 0);
  const types = [...head.matchAll(/property (\w+) \w+/g)].map(([, type = ""]) => SIZES[type] ?? 0);
  const stride = types.reduce((sum, size) => sum + size, 0);
  if (count === 0 || types.includes(0) || file.byteLength < head.length + count * stride) {
    return null;
  }
  const points = new DataView(file, head.length);
  const min: [number, number, number] = [Infinity, Infinity, Infinity];
  const max: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  for (let point = 0; point < count; point += 1) {
    for (const axis of [0, 1, 2] as const) {
      const place = points.getFloat32(point * stride + 4 * axis, true);
      min[axis] = Math.min(min[axis], place);
      max[axis] = Math.max(max[axis], place);
    }
  }
  return [...min, ...max].every(Number.isFinite) ? { min, max } : null;
}

/** How high it stands above the ground, and how far it spreads at most, in metres. */
export function measuresOf({ min, max }: Shape): { readonly height: number; readonly spread: number } {
  return { height: Math.max(0, max[1]), spread: Math.max(max[0] - min[0], max[2] - min[2]) };
}
