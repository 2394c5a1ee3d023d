import { BufferAttribute, DynamicDrawUsage, InstancedBufferAttribute, InstancedBufferGeometry, Mesh } from "three";
import { grown } from "./column";
import type { Materials } from "./materials";
import { radiusOf, type TreeTable } from "./tree-table";

/** How finely metamers of one thickness are drawn. */
interface Detail {
  /** Radius in internodes from which it applies. */
  from: number;
  sides: number;
  rings: number;
  /** Sides and rings of what casts the shadow, and of what is seen while frames must be quick. */
  coarse: readonly [sides: number, rings: number];
}

const THICK: Detail = { from: 0.28, sides: 16, rings: 5, coarse: [8, 3] };
const MEDIUM: Detail = { from: 0.09, sides: 8, rings: 3, coarse: [5, 2] };
const TWIG: Detail = { from: 0, sides: 5, rings: 2, coarse: [3, 2] };

const BEGINS_AXIS = 1;
const FROM_SEED = 2;
const TRUNK = 4;
const STRIDE = 4;
const NOWHERE = -1;

/** All metamers as instances of tube segments, one draw call per thickness. */
export class Branches {
  readonly meshes: Mesh[];
  readonly casters: Mesh[];
  private readonly sizes: Size[];
  private sizeOf = new Int8Array(0);
  private known = 0;

  constructor(materials: Pick<Materials, "bark" | "twig" | "branchDepth">) {
    this.sizes = [new Size(THICK), new Size(MEDIUM), new Size(TWIG)];
    this.meshes = this.sizes.map((size, i) => mesh(size.fine, i < 2 ? materials.bark : materials.twig));
    this.casters = this.sizes.map((size) => mesh(size.coarse, materials.branchDepth));
  }

  /** Rows from `rows` on are gone. */
  truncate(rows: number): void {
    for (let row = rows; row < this.known; row += 1) this.place(row, NOWHERE);
    this.known = Math.min(this.known, rows);
  }

  /** Draws a row as thick as it is now. */
  update(table: TreeTable, row: number): void {
    if (row >= this.known) {
      this.sizeOf = grown(this.sizeOf, table.parent.length);
      this.sizeOf.fill(NOWHERE, this.known, row + 1);
      this.known = row + 1;
    }
    const parent = table.parent[row]!;
    const alive = parent >= 0 && table.radiusCode[row] !== 0;
    this.place(row, alive ? this.fitting(radiusOf(table.radiusCode[row]!), this.sizeOf[row]!) : NOWHERE);
    if (!alive) return;
    const fromSeed = table.parent[parent]! < 0;
    const origin = table.axisOrigin[row]!;
    const flags =
      (table.startsAxis[row] === 1 || fromSeed ? BEGINS_AXIS : 0) |
      (fromSeed ? FROM_SEED : 0) |
      (table.parent[origin]! < 0 ? TRUNK : 0);
    this.sizes[this.sizeOf[row]!]!.write(row, parent, origin, flags);
  }

  /** Whether branches are as round and smooth as they can be. */
  detail(detailed: boolean): void {
    for (const [i, size] of this.sizes.entries()) this.meshes[i]!.geometry = detailed ? size.fine : size.coarse;
  }

  /** Has three.js upload what was written since the last call. */
  upload(): void {
    for (const size of this.sizes) size.upload();
    for (const [i, size] of this.sizes.entries()) {
      this.meshes[i]!.visible = size.count > 0;
      this.casters[i]!.visible = size.count > 0;
    }
  }

  dispose(): void {
    for (const size of this.sizes) size.dispose();
  }

  private place(row: number, size: number): void {
    const before = this.sizeOf[row]!;
    if (before === size) return;
    if (before !== NOWHERE) this.sizes[before]!.remove(row);
    if (size !== NOWHERE) this.sizes[size]!.add(row);
    this.sizeOf[row] = size;
  }

  /** A metamer changes its size only when it is clearly thicker or thinner, so that it does not flicker between two. */
  private fitting(radius: number, before: number): number {
    const fitted = radius >= THICK.from ? 0 : radius >= MEDIUM.from ? 1 : 2;
    if (before === NOWHERE || fitted <= before) return fitted;
    return radius < 0.9 * this.sizes[before]!.detail.from ? fitted : before;
  }
}

/** The metamers drawn with one level of detail, in no order. */
class Size {
  readonly fine: InstancedBufferGeometry;
  readonly coarse: InstancedBufferGeometry;
  count = 0;
  private instances = new Uint32Array(256 * STRIDE);
  private attribute = this.allocate();
  private readonly slotOf = new Map<number, number>();
  private changedFrom = Number.POSITIVE_INFINITY;
  private changedTo = 0;

  constructor(readonly detail: Detail) {
    this.fine = tube(detail.sides, detail.rings);
    this.coarse = tube(...detail.coarse);
    this.bind();
  }

  add(row: number): void {
    const slot = this.count;
    this.count += 1;
    if (this.count * STRIDE > this.instances.length) {
      this.instances = grown(this.instances, 2 * this.instances.length);
      this.dispose();
      this.attribute = this.allocate();
      this.bind();
    }
    this.slotOf.set(row, slot);
    this.instances[slot * STRIDE] = row;
    this.touch(slot);
  }

  remove(row: number): void {
    const slot = this.slotOf.get(row);
    if (slot === undefined) return;
    const last = this.count - 1;
    // The last metamer takes the place of the one that leaves.
    const moving = this.instances[last * STRIDE]!;
    this.instances.copyWithin(slot * STRIDE, last * STRIDE, (last + 1) * STRIDE);
    this.slotOf.set(moving, slot);
    this.slotOf.delete(row);
    this.count = last;
    if (slot < last) this.touch(slot);
  }

  write(row: number, parent: number, origin: number, flags: number): void {
    const slot = this.slotOf.get(row);
    if (slot === undefined) return;
    const at = slot * STRIDE;
    const { instances } = this;
    if (instances[at + 1] === parent && instances[at + 2] === origin && instances[at + 3] === flags) return;
    instances[at + 1] = parent;
    instances[at + 2] = origin;
    instances[at + 3] = flags;
    this.touch(slot);
  }

  upload(): void {
    for (const geometry of [this.fine, this.coarse]) geometry.instanceCount = this.count;
    if (this.changedTo === 0) return;
    this.attribute.clearUpdateRanges();
    this.attribute.addUpdateRange(this.changedFrom * STRIDE, (this.changedTo - this.changedFrom) * STRIDE);
    this.attribute.needsUpdate = true;
    this.changedFrom = Number.POSITIVE_INFINITY;
    this.changedTo = 0;
  }

  dispose(): void {
    this.fine.dispose();
    this.coarse.dispose();
  }

  private bind(): void {
    for (const geometry of [this.fine, this.coarse]) geometry.setAttribute("metamer", this.attribute);
  }

  private touch(slot: number): void {
    this.changedFrom = Math.min(this.changedFrom, slot);
    this.changedTo = Math.max(this.changedTo, slot + 1);
  }

  private allocate(): InstancedBufferAttribute {
    const attribute = new InstancedBufferAttribute(this.instances, STRIDE);
    attribute.setUsage(DynamicDrawUsage);
    return attribute;
  }
}

function mesh(geometry: InstancedBufferGeometry, material: Materials[keyof Materials]): Mesh {
  const made = new Mesh(geometry, material);
  made.frustumCulled = false;
  return made;
}

/** A tube without ends: cosine, place along, sine. */
function tube(sides: number, rings: number): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  const vertices: number[] = [];
  const index: number[] = [];
  for (let ring = 0; ring < rings; ring += 1) {
    for (let side = 0; side < sides; side += 1) {
      const angle = (2 * Math.PI * side) / sides;
      vertices.push(Math.cos(angle), ring / (rings - 1), Math.sin(angle));
      if (ring + 1 === rings) continue;
      const a = ring * sides + side;
      const b = ring * sides + ((side + 1) % sides);
      index.push(a, a + sides, b, b, a + sides, b + sides);
    }
  }
  geometry.setAttribute("ring", new BufferAttribute(new Float32Array(vertices), 3));
  geometry.setIndex(index);
  return geometry;
}
