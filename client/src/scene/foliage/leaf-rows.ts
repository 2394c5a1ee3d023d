import { Mesh, type ShaderMaterial, type Vector3, type Vector4 } from "three";
import type { Box } from "../camera/camera-view";
import type { Uniforms } from "../materials";
import type { Fineness } from "../rendering/fineness";
import type { TreeTable } from "../table/tree-table";
import { GivenLengths } from "./given-lengths";
import { BLADE_CARDS, bladesFor, divided, levelFor, SPRAY_CARDS } from "./leaf-cards";
import { leafRandom, SHOOT, shootOf } from "./leaves";
import { reachFrom } from "./nearness";
import { OrganKind, organsOf, standingOf } from "./organs";
import { RowInstances } from "./row-instances";

/** The largest leaf is this much longer than the leaf size (LF2). */
const LARGEST = 1.25;
const FAR = 2;
/** Where there are triangles for less than this share of the blades, leaves show the picture of a sprig instead, ... */
const TOO_FEW = 0.6;
/** ... up to this length in pixels, for the picture is no finer. */
const TWIG_PIXELS = 64;

/** What a leaf is drawn with, and what draws its shadow. */
export interface LeafMaterials {
  readonly leaf: ShaderMaterial;
  readonly leafDepth: ShaderMaterial;
}

/** All leaves as instances of one card, placed by the rules LF1 to LF6. */
export class LeafRows {
  /** Drawn into the picture. */
  readonly mesh: Mesh;
  /** Drawn into the shadow map. */
  readonly caster: Mesh;
  private readonly instances: RowInstances;
  private readonly lengths = new GivenLengths();
  private spray = false;
  /** Blades that each leaf is drawn as. */
  private blades = 1;

  /** The uniforms are the materials' own. */
  constructor(
    materials: LeafMaterials,
    private readonly uniforms: Uniforms,
  ) {
    this.instances = new RowInstances(BLADE_CARDS, [materials.leaf, materials.leafDepth]);
    const { geometries } = this.instances;
    this.mesh = new Mesh(geometries[FAR], materials.leaf);
    this.caster = new Mesh(geometries[FAR], materials.leafDepth);
    for (const mesh of [this.mesh, this.caster]) mesh.frustumCulled = false;
  }

  /** Leaves there are. */
  get filled(): number {
    return this.instances.filled;
  }

  /** How many leaves a row bears. */
  countOf(row: number): number {
    return this.instances.countOf(row);
  }

  /** Removes the leaves of rows from `rows` on. */
  truncate(rows: number): void {
    this.instances.truncate(rows);
    if (rows === 0) this.lengths.clear();
  }

  /** The shortest and the longest leaf there may be, in internodes. */
  get sizes(): readonly [shortest: number, longest: number] {
    return this.lengths.around(this.uniforms.uLeafSize!.value as number);
  }

  /** Places a row's leaves anew. */
  update(table: TreeTable, row: number): void {
    const parent = table.parent[row]!;
    const foliage = table.foliage[row]!;
    const count = table.radiusCode[row] !== 0 && parent >= 0 ? foliage & 15 : 0;
    const first = this.instances.place(row, count);
    const shoot = count > 0 ? leafRandom(shootOf(table, row), SHOOT) : 0;
    const organs = count > 0 ? organsOf(table, row, OrganKind.Leaf) : [];
    for (let k = 0; k < count; k += 1) {
      const standing = standingOf(row, k, count, organs[k]);
      this.lengths.take(standing.length);
      this.instances.write(first + k, row, parent, standing, foliage >> 4, leafRandom(row, k), shoot);
    }
  }

  /** Chooses triangles by how large the nearest leaf in the box may be on the screen, and how many leaves may be drawn. */
  detail({ eye, pixels, detailed, leaves }: Fineness, box: Box): void {
    const { filled, geometries } = this.instances;
    const share = Math.min(1, leaves / Math.max(1, filled));
    const drawn = filled * share;
    const size = LARGEST * this.sizes[1];
    const longest = (size * pixels) / Math.max(0.5, reachFrom(eye, box).nearest - size);
    const twigs = this.follow(drawn, detailed);
    const { cards, blades } = this;
    const level = levelFor(cards, drawn * blades, longest / Math.sqrt(blades), detailed);
    this.mesh.geometry = geometries[level]!;
    (this.uniforms.uLeafLevel!.value as Vector3).set(level, share, blades);
    this.uniforms.uLeafTwig!.value = twigs ? TWIG_PIXELS : 0;
    this.instances.thin(Math.floor(1 / share));
  }

  /** Draws them or not. */
  show(shown: boolean): void {
    this.mesh.visible = shown && this.instances.filled > 0;
    this.caster.visible = this.mesh.visible;
  }

  /** Uploads what was written since the last call. */
  upload(): void {
    this.instances.upload();
    this.show(true);
  }

  /** A restored context has lost the texture. */
  restored(): void {
    this.instances.restored();
  }

  dispose(): void {
    this.instances.dispose();
  }

  private get cards() {
    return this.spray ? SPRAY_CARDS : BLADE_CARDS;
  }

  /**
   * Sprays stand on crossed cards, but for the one that all are far off; and so many leaves are divided into blades. Says
   * whether they show the picture of a sprig instead.
   */
  private follow(leaves: number, detailed: boolean): boolean {
    const spray = (this.uniforms.uLeafForm!.value as Vector4).y > 0.5;
    const wanted = this.uniforms.uLeafBlades!.value as number;
    const most = bladesFor(spray ? SPRAY_CARDS : BLADE_CARDS, leaves, wanted, detailed);
    const twigs = most < TOO_FEW * wanted;
    const blades = twigs ? 1 : most;
    if (spray !== this.spray || blades !== this.blades) {
      this.spray = spray;
      this.blades = blades;
      this.instances.shape(divided(this.cards, blades));
    }
    return twigs;
  }
}
