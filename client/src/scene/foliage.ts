import {
  BufferAttribute,
  DynamicDrawUsage,
  InstancedBufferGeometry,
  InstancedInterleavedBuffer,
  InterleavedBufferAttribute,
  Mesh,
} from "three";
import { grown } from "./column";
import { LeafSlots } from "./leaf-slots";
import { leafAzimuth, leafRandom } from "./leaves";
import type { Materials } from "./materials";
import type { TreeTable } from "./tree-table";

/** Row, parent's row, azimuth and share of the way along; a random number with the vigor above the point. */
const STRIDE = 5;
const TINT = 4;
const NO_LEAF = -1;
/** With more leaves than this each is drawn with half the triangles: nobody sees single ones then. */
const MANY_LEAVES = 60_000;

/** All leaves as instances of one blade. */
export class Foliage {
  /** Seen by the camera. */
  readonly mesh: Mesh;
  /** Seen by the sun. */
  readonly caster: Mesh;
  private readonly slots = new LeafSlots();
  private instances = new Float32Array(1024 * STRIDE);
  private buffer = this.allocate();
  private changedFrom = Number.POSITIVE_INFINITY;
  private changedTo = 0;
  private fine = true;
  private readonly detailed = blade([0.1, 0.28, 0.52, 0.78], [0.15, 0.29, 0.29, 0.15]);
  private readonly plain = blade([0.42], [0.3]);
  private readonly geometry: { near: InstancedBufferGeometry; far: InstancedBufferGeometry };

  constructor(materials: Pick<Materials, "leaf" | "leafDepth">) {
    this.geometry = { near: new InstancedBufferGeometry(), far: new InstancedBufferGeometry() };
    for (const [geometry, source] of [
      [this.geometry.near, this.detailed],
      [this.geometry.far, this.plain],
    ] as const) {
      geometry.setAttribute("blade", source.blade);
      geometry.setIndex(source.index);
    }
    this.bind();
    this.mesh = new Mesh(this.geometry.near, materials.leaf);
    this.caster = new Mesh(this.geometry.far, materials.leafDepth);
    for (const mesh of [this.mesh, this.caster]) mesh.frustumCulled = false;
  }

  /** Leaves of rows from `rows` on are gone. */
  truncate(rows: number): void {
    this.slots.truncate(rows, this.clear);
  }

  /** Places a row's leaves anew. */
  update(table: TreeTable, row: number): void {
    const parent = table.parent[row]!;
    const alive = table.radiusCode[row] !== 0 && parent >= 0;
    const count = alive ? table.foliage[row]! & 15 : 0;
    this.slots.assign(row, count, this.clear);
    if (count === 0) return;
    const first = this.slots.firstOf(row);
    this.reserve(this.slots.end);
    const vigor = table.foliage[row]! >> 4;
    for (let k = 0; k < count; k += 1) {
      const at = (first + k) * STRIDE;
      const { instances } = this;
      instances[at] = row;
      instances[at + 1] = parent;
      instances[at + 2] = leafAzimuth(row, k, count);
      instances[at + 3] = (k + 1) / count;
      instances[at + TINT] = vigor + Math.min(leafRandom(row, k), 0.999);
    }
    this.touch(first, count);
  }

  /** Whether each leaf has all its triangles, as far as there are not too many leaves. */
  detail(detailed: boolean): void {
    this.fine = detailed;
    this.mesh.geometry = detailed && this.slots.end <= MANY_LEAVES ? this.geometry.near : this.geometry.far;
  }

  /** Has three.js upload what was written since the last call. */
  upload(): void {
    for (const geometry of [this.geometry.near, this.geometry.far]) geometry.instanceCount = this.slots.end;
    this.detail(this.fine);
    this.mesh.visible = this.slots.end > 0;
    this.caster.visible = this.slots.end > 0;
    if (this.changedTo === 0) return;
    this.buffer.clearUpdateRanges();
    this.buffer.addUpdateRange(this.changedFrom * STRIDE, (this.changedTo - this.changedFrom) * STRIDE);
    this.buffer.needsUpdate = true;
    this.changedFrom = Number.POSITIVE_INFINITY;
    this.changedTo = 0;
  }

  dispose(): void {
    this.geometry.near.dispose();
    this.geometry.far.dispose();
  }

  private readonly clear = (first: number, count: number): void => {
    for (let slot = first; slot < first + count; slot += 1) this.instances[slot * STRIDE + TINT] = NO_LEAF;
    this.touch(first, count);
  };

  private touch(first: number, count: number): void {
    this.changedFrom = Math.min(this.changedFrom, first);
    this.changedTo = Math.max(this.changedTo, first + count);
  }

  private reserve(slots: number): void {
    if (slots * STRIDE <= this.instances.length) return;
    let room = this.instances.length / STRIDE;
    while (room < slots) room *= 2;
    this.instances = grown(this.instances, room * STRIDE);
    // A buffer cannot grow on the GPU; geometries that held the old one let go of it.
    this.geometry.near.dispose();
    this.geometry.far.dispose();
    this.buffer = this.allocate();
    this.bind();
  }

  private allocate(): InstancedInterleavedBuffer {
    const buffer = new InstancedInterleavedBuffer(this.instances, STRIDE);
    buffer.setUsage(DynamicDrawUsage);
    return buffer;
  }

  private bind(): void {
    for (const geometry of [this.geometry.near, this.geometry.far]) {
      geometry.setAttribute("leaf", new InterleavedBufferAttribute(this.buffer, 4, 0));
      geometry.setAttribute("tint", new InterleavedBufferAttribute(this.buffer, 1, TINT));
    }
  }
}

/** An ovate outline from base to tip: across −1 to 1, along, half width; both halves meet at the midrib. */
function blade(stations: number[], halfWidths: number[]) {
  const vertices: number[] = [0, 0, 0];
  for (const [i, along] of stations.entries()) {
    const half = halfWidths[i]!;
    vertices.push(-1, along, half, 0, along, 0, 1, along, half);
  }
  vertices.push(0, 1, 0);
  const index: number[] = [0, 2, 1, 0, 3, 2];
  for (let i = 0; i + 1 < stations.length; i += 1) {
    const below = 1 + 3 * i;
    const above = below + 3;
    index.push(below, below + 1, above, above, below + 1, above + 1);
    index.push(below + 1, below + 2, above + 1, above + 1, below + 2, above + 2);
  }
  const last = 1 + 3 * (stations.length - 1);
  const tip = last + 3;
  index.push(last, last + 1, tip, last + 1, last + 2, tip);
  return { blade: new BufferAttribute(new Float32Array(vertices), 3), index };
}
