import { Mesh, type ShaderMaterial, type Vector3 } from "three";
import type { Box } from "../camera/camera-view";
import { leafHash } from "../leaf-hash";
import type { Uniforms } from "../materials";
import { SPRIG_LEAVES } from "../painting/measures";
import type { Fineness } from "../rendering/fineness";
import { grown } from "../table/column";
import type { TreeTable } from "../table/tree-table";
import { SPRIG_CARD } from "./leaf-cards";
import type { LeafRows } from "./leaf-rows";
import { leafRandom, SHOOT, shootOf } from "./leaves";
import { reachFrom } from "./nearness";
import { OrganKind, organsOf, standingOf } from "./organs";
import { RowInstances } from "./row-instances";

/** Leaves shorter than the first, in pixels, have all given way to sprigs; longer than the second, none. */
const BAND = [2.2, 3.6] as const;
/** With more leaves than this they do so sooner, up to so much, for then single leaves are not seen. */
const MANY = 40_000;
const SOONER = 2.15;
/** A tree with fewer leaves than this keeps them however far it is. */
const FEW = 2_000;
/** Of sixteen numbers a row has for its leaves, the one that says which of them a sprig stands in for. */
const CHOICE = 14;

/** What a sprig is drawn with, and what draws its shadow. */
export interface SprigMaterials {
  readonly sprig: ShaderMaterial;
  readonly sprigDepth: ShaderMaterial;
}

/**
 * Leaves that stand together on a shoot, drawn from afar as one card with a picture of them. A sprig takes the place of
 * every sixth leaf along a shoot, with its direction, light and colour, and covers as much as six. Single leaves and
 * sprigs shrink and swell against each other, one after the other, by how long a leaf is on the screen: there is no
 * moment in which one is put for the other, so nothing pops, and nothing has to remember which it was.
 */
export class Sprigs {
  /** Drawn into the picture. */
  readonly mesh: Mesh;
  /** Drawn into the shadow map. */
  readonly caster: Mesh;
  /** How far leaves have given way in the middle of the tree, 0 to 1. */
  share = 0;
  private readonly instances: RowInstances;
  /** How many metamers come before each on its axis, from a start that differs from axis to axis. */
  private place = new Uint32Array(0);

  /** The uniforms are the materials' own. */
  constructor(
    materials: SprigMaterials,
    private readonly uniforms: Uniforms,
  ) {
    this.instances = new RowInstances([SPRIG_CARD], [materials.sprig, materials.sprigDepth]);
    const [geometry] = this.instances.geometries;
    this.mesh = new Mesh(geometry, materials.sprig);
    this.caster = new Mesh(geometry, materials.sprigDepth);
    for (const mesh of [this.mesh, this.caster]) {
      mesh.frustumCulled = false;
      mesh.visible = false;
    }
  }

  /** Sprigs there are. */
  get count(): number {
    return this.instances.filled;
  }

  /** Sprigs of rows from `rows` on are gone. */
  truncate(rows: number): void {
    this.instances.truncate(rows);
  }

  /** Sees whether a row bears a sprig now. */
  update(table: TreeTable, row: number): void {
    if (row >= this.place.length) this.place = grown(this.place, Math.max(1024, 2 ** Math.ceil(Math.log2(row + 1))));
    const parent = table.parent[row]!;
    const follows = parent >= 0 && table.startsAxis[row] === 0;
    const place = follows ? this.place[parent]! + 1 : leafHash(row) % 4096;
    this.place[row] = place;
    const foliage = table.foliage[row]!;
    const leaves = table.radiusCode[row] !== 0 && parent >= 0 ? foliage & 15 : 0;
    const count = sprigsOf(place, leaves);
    if (count === 0 && this.instances.countOf(row) === 0) return;
    const first = this.instances.place(row, count);
    const shoot = count > 0 ? leafRandom(shootOf(table, row), SHOOT) : 0;
    const organs = count > 0 ? organsOf(table, row, OrganKind.Leaf) : [];
    for (let i = 0; i < count; i += 1) {
      const k = (leafHash(16 * row + CHOICE) + i) % leaves;
      const standing = standingOf(row, k, leaves, organs[k]);
      this.instances.write(first + i, row, parent, standing, foliage >> 4, leafRandom(row, k), shoot);
    }
  }

  /** Chooses, from where the box is seen, how far its leaves give way; those that are wholly gone are not drawn. */
  detail({ eye, pixels, merging, sprigs }: Fineness, box: Box, leaves: LeafRows): void {
    const [shortest, longest] = leaves.sizes;
    const size = this.uniforms.uLeafSize!.value as number;
    const { nearest, middle, farthest } = reachFrom(eye, box);
    const [low, high] = bandFor(leaves.filled, merging);
    const length = (distance: number, of = size) => (of * pixels) / Math.max(0.5, distance);
    const whole = SPRIG_LEAVES * this.count;
    // All sprigs together stand for as many leaves as there are.
    const swell = whole > 0 ? Math.min(1.3, Math.max(0.75, Math.sqrt(leaves.filled / whole))) : 1;
    const step = Math.max(1, Math.ceil(this.count / sprigs));
    this.instances.thin(step);
    (this.uniforms.uLeafBand!.value as Vector3).set(low, high, swell * Math.sqrt(step));
    this.share = high > 0 ? 1 - rise(low, high, length(middle)) : 0;
    const any = high > 0 && this.count > 0;
    const merged = any && length(farthest + size, shortest) < high;
    this.mesh.visible = merged;
    this.caster.visible = merged;
    leaves.show(!any || length(nearest - longest, longest) > low);
  }

  /** Uploads what was written since the last call. */
  upload(): void {
    this.instances.upload();
  }

  /** A restored context has lost the texture. */
  restored(): void {
    this.instances.restored();
  }

  dispose(): void {
    this.instances.dispose();
  }
}

/** Sprigs that a metamer with so many leaves bears, if all on its axis have as many: one for every sixth. */
export function sprigsOf(place: number, leaves: number): number {
  const before = Math.floor((place * leaves) / SPRIG_LEAVES);
  return Math.floor(((place + 1) * leaves) / SPRIG_LEAVES) - before;
}

/** The lengths of a leaf in pixels between which so many leaves give way to sprigs, times `merging`; both 0 where they never do. */
export function bandFor(leaves: number, merging: number): readonly [low: number, high: number] {
  if (leaves < FEW) return [0, 0];
  const sooner = merging * Math.min(SOONER, Math.max(1, Math.sqrt(leaves / MANY)));
  return [BAND[0] * sooner, BAND[1] * sooner];
}

/** As the shaders' own `smoothstep`. */
function rise(low: number, high: number, value: number): number {
  const t = Math.min(1, Math.max(0, (value - low) / (high - low)));
  return t * t * (3 - 2 * t);
}
