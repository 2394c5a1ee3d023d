import type { ChunkChange, Frame, Rows } from "../src/wire/frame";
import { CHUNK_ROWS, MIN_RADIUS, POSITION_STEPS, RADIUS_LOG_STEP } from "../src/wire/generated";

/** What `espalier grow --export TREE.json` writes; see docs/formats.md. */
export interface Skeleton {
  readonly metamers: readonly {
    readonly parent: number | null;
    readonly position: readonly [number, number, number];
    readonly radius: number;
    readonly order: number;
    readonly birth: number;
  }[];
}

/** Metamers with more twig tips above them bear no leaves. */
const MOST_TIPS_WITH_LEAVES = 2;

/** A skeleton as one catch-up frame; light and vigor, of which it says nothing, follow from how far out a metamer is. */
export function skeletonTree({ metamers }: Skeleton, leavesPerNode: number): Frame {
  const n = metamers.length;
  const tips = new Uint32Array(n);
  for (let row = n - 1; row > 0; row -= 1) {
    const { parent } = metamers[row]!;
    tips[row]! ||= 1;
    if (parent !== null) tips[parent]! += tips[row]!;
  }
  const centre = ([0, 1, 2] as const).map((a) => metamers.reduce((sum, m) => sum + m.position[a], 0) / n);
  const off = (row: number) => Math.hypot(...metamers[row]!.position.map((x, a) => x - centre[a]!));
  const spread = metamers.reduce((sum, _, row) => sum + off(row), 0) / n;
  const quantised = metamers.map((m) => m.position.map((x) => Math.round(x * POSITION_STEPS)));
  const changes: ChunkChange[] = [];
  for (let first = 0; first < n; first += CHUNK_ROWS) {
    const count = Math.min(CHUNK_ROWS, n - first);
    const rows: Rows = {
      parent: new Uint32Array(count),
      position: new Int32Array(3 * count),
      radius: new Uint16Array(count),
      foliage: new Uint8Array(count),
      light: new Uint8Array(count),
      born: new Uint32Array(count),
    };
    for (let i = 0; i < count; i += 1) {
      const row = first + i;
      const { parent, radius, order } = metamers[row]!;
      const begins = parent !== null && metamers[parent]!.order !== order;
      rows.parent[i] = parent === null ? 0 : 2 * (row - parent) + (begins ? 1 : 0);
      for (const a of [0, 1, 2]) {
        rows.position[3 * i + a] = quantised[row]![a]! - (parent === null ? 0 : quantised[parent]![a]!);
      }
      rows.radius[i] =
        parent === null ? 0 : 1 + Math.max(0, Math.round(Math.log(radius / MIN_RADIUS) / RADIUS_LOG_STEP));
      const outer = Math.min(1, (0.6 * off(row)) / spread);
      const leafy = parent !== null && tips[row]! <= MOST_TIPS_WITH_LEAVES;
      const vigor = Math.floor(15 * Math.min(1, outer * (0.5 + 0.5 * (((row * 7919) % 101) / 101))));
      rows.foliage[i] = (leafy ? leavesPerNode : 0) | (vigor << 4);
      rows.light[i] = Math.round(255 * (0.1 + 0.9 * outer));
      rows.born[i] = metamers[row]!.birth;
    }
    changes.push({ change: "replace", chunk: first / CHUNK_ROWS, generation: 1, rows });
  }
  return { epoch: 1, sequence: 1, catchUp: true, changes };
}
