import { Mesh, type ShaderMaterial, Vector3, Vector4 } from "three";
import type { OrnamentNature } from "../../wire/generated";
import { linear } from "../light/colours";
import type { Uniforms } from "../materials";
import { GradualTextures } from "../painting/gradual-textures";
import type { Kinds } from "../painting/paint";
import type { Painter } from "../painting/painter";
import type { Fineness } from "../rendering/fineness";
import { Dirty, type TreeTable } from "../table/tree-table";
import { ORNAMENT_CARDS } from "./leaf-cards";
import { leafRandom } from "./leaves";
import { organsOf, standingOf } from "./organs";
import type { OrnamentSort } from "./ornament-sorts";
import { isBearing, type Placing } from "./places";
import { RowInstances } from "./row-instances";

/** With more than this each place bears fewer of them, so that a large tree in flower is still drawn quickly. */
const MANY = 100_000;

interface OrnamentLook extends Placing {
  readonly kind: string;
  readonly tint: readonly [number, number, number];
  readonly size: number;
}

/** All flowers, or all fruits, as instances of one card. */
export class Ornaments<Look extends OrnamentLook> {
  /** Drawn into the picture. */
  readonly mesh: Mesh;
  /** Drawn into the shadow map. */
  readonly caster: Mesh;
  private readonly instances: RowInstances;
  private readonly form = { value: new Vector4(0.5, 0, 0, 0) };
  private readonly finish = { value: new Vector4() };
  private readonly tint = { value: new Vector3() };
  private readonly second = { value: new Vector3() };
  readonly textures: GradualTextures<"flower" | "fruit">;
  /** As it is set, and as it is shown: where it has none of these, what rows are given shows all the same. */
  private asked: Look | null = null;
  private look: Look | null = null;
  /** Rows that are given some. */
  private readonly given = new Set<number>();
  /** How many stand at a place: as many as the kind has, or fewer. */
  private together = 0;
  /** Rows there were when all places were looked for. */
  private searched = 0;
  /** Whether places have to be looked for in every row. */
  private stale = false;

  constructor(
    private readonly sort: OrnamentSort<Look["kind"]>,
    material: ShaderMaterial,
    depth: ShaderMaterial,
    uniforms: Uniforms,
    painter: Painter,
  ) {
    this.instances = new RowInstances([ORNAMENT_CARDS], [material, depth]);
    this.mesh = new Mesh(this.instances.geometries[0], material);
    this.caster = new Mesh(this.instances.geometries[0], depth);
    for (const mesh of [this.mesh, this.caster]) {
      mesh.frustumCulled = false;
      mesh.visible = false;
    }
    const { name } = sort;
    uniforms[`u${name}Form`] = this.form;
    uniforms[`u${name}Finish`] = this.finish;
    uniforms[`u${name}Tint`] = this.tint;
    uniforms[`u${name}Second`] = this.second;
    this.textures = new GradualTextures(name === "Flower" ? "flower" : "fruit", painter);
    const { colour, relief } = this.textures.drawn[0]!;
    uniforms[`u${name}Colour`] = colour;
    uniforms[`u${name}Relief`] = relief;
  }

  /** Shows another look; new places are found with the next upload. */
  setLook(look: Look): void {
    this.asked = look;
    this.show(this.given.size > 0 && look.kind === "none" ? { ...look, kind: this.sort.given, share: 0 } : look);
  }

  private show(look: Look): void {
    const before = this.look;
    this.look = look;
    const kind = this.kind;
    if (look.kind === "none") this.textures.dispose();
    else this.textures.choose(look.kind as Kinds["flower" | "fruit"]);
    this.stale ||=
      before?.kind !== look.kind ||
      before.share !== look.share ||
      before.place !== look.place ||
      before.vigor !== look.vigor;
    if (!kind) return;
    this.form.value.set(kind.reach, kind.hang, kind.turn, kind.stalk);
    this.finish.value.set(look.size, kind.gloss, 1, 0);
    this.tint.value.set(...linear(look.tint));
    this.second.value.set(...linear(kind.second));
  }

  /** Removes everything on rows from `rows` on. */
  truncate(rows: number): void {
    this.instances.truncate(rows);
    for (const row of this.given) if (row >= rows) this.given.delete(row);
    // What was too much for a large tree may not be for what is left of it.
    if (rows < this.searched / 2) this.stale = true;
  }

  /** Sees whether a row bears something now. */
  update(table: TreeTable, row: number, bits: number = Dirty.Shape): void {
    const organs = this.organsOf(table, row);
    const { look, kind, sort, instances } = this;
    if (!look || this.stale) return;
    const others = kind && organs.length === 0 && isBearing(table, row, look, sort.salt) ? this.together : 0;
    const count = kind ? organs.length || others : 0;
    if (count === instances.countOf(row) && (count === 0 || (bits & Dirty.Shape) === 0)) return;
    const [parent, vigor] = [table.parent[row]!, table.foliage[row]! >> 4];
    const first = instances.place(row, count);
    for (let k = 0; k < count; k += 1) {
      const standing = standingOf(row, k, count, organs[k], sort.salt);
      instances.write(first + k, row, parent, standing, vigor, leafRandom(row, k, sort.salt));
    }
  }

  /** What a living row is given of these; the first of them may change what is shown. */
  private organsOf(table: TreeTable, row: number): readonly number[] {
    const organs = table.radiusCode[row] === 0 ? [] : organsOf(table, row, this.sort.organ);
    const had = this.given.size > 0;
    if (organs.length > 0) this.given.add(row);
    else this.given.delete(row);
    if (this.asked && had !== this.given.size > 0) this.setLook(this.asked);
    return organs;
  }

  /** Uploads what was written since the last call. */
  upload(table: TreeTable): void {
    if (this.stale) this.search(table, this.kind?.together ?? 0);
    while (this.instances.filled > MANY && this.together > 1) this.search(table, Math.ceil(this.together / 2));
    this.instances.upload();
    const visible = this.kind !== null && this.instances.filled > 0;
    this.mesh.visible = visible;
    this.caster.visible = visible;
  }

  /** Draws no more than a picture may have of leaves; each is the larger for it, so that as much is covered. */
  detail({ leaves }: Pick<Fineness, "leaves">): void {
    const step = Math.max(1, Math.ceil(this.instances.count / leaves));
    this.instances.thin(step);
    this.finish.value.x = (this.look?.size ?? 0) * Math.sqrt(step);
    this.finish.value.z = Math.sqrt(step);
  }

  /** A restored context has lost the textures. */
  restored(): void {
    this.instances.restored();
    this.textures.restored();
  }

  dispose(): void {
    this.textures.dispose();
    this.instances.dispose();
  }

  /** Finds all places anew, for so many at each. */
  private search(table: TreeTable, together: number): void {
    this.stale = false;
    this.together = together;
    this.searched = table.rows;
    this.instances.truncate(0);
    if (this.kind) for (let row = 0; row < table.rows; row += 1) this.update(table, row);
  }

  private get kind(): OrnamentNature | null {
    const kinds: Partial<Record<string, OrnamentNature>> = this.sort.kinds;
    return (this.look && kinds[this.look.kind]) ?? null;
  }
}
