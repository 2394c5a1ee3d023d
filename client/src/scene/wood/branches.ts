import { Mesh, type RawShaderMaterial } from "three";
import { type BarkLook, RADIUS_LOG_STEP } from "../../wire/generated";
import type { BlockGeometry } from "../block-geometry";
import { grown } from "../table/column";
import { slopeCode } from "../table/girth";
import type { TreeTable } from "../table/tree-table";
import type { Vec3 } from "../vector";
import type { Bark } from "./bark";
import { BranchBin } from "./branch-bin";
import { LEVELS, levelFor, type Seen } from "./branch-levels";
import { face, ribbon, tube } from "./branch-shapes";
import { Roots } from "./roots";

const BEGINS_LIMB = 1;
const FROM_SEED = 2;
const TRUNK = 4;
const CUT = 8;
const OVERLAPS = 16;
const ROOT = 32;

/** Where the flags hold how the girth changes at both ends of a metamer. */
const SLOPE_BELOW = 8;
const SLOPE_ABOVE = 16;

const NOWHERE = -1;
/** Sides of a cut end. */
const FACE_SIDES = 16;
/** A trunk that begins higher above the ground or deeper in it spreads no roots over it, in internodes. */
const ON_GROUND = 0.3;
/** Up to so many of its radii above the ground a trunk has ribs, and is drawn as if it were so much thicker. */
const [RIBBED, RIBS] = [3, 3] as const;
/** Segments of the strips that cast the shadows of limbs. */
const CASTER_SEGMENTS = 3;
/** An end this many codes thicker than the thinnest twig has lost what made it so thick: it was cut. */
const THICK_END = Math.ceil(Math.log(1.7) / RADIUS_LOG_STEP);
/** Rows looked at again in a frame after the eye has moved; more would be felt. */
const ROWS_A_FRAME = 20_000;
/** One that is drawn otherwise from then on costs as much as so many that are not. */
const ROWS_A_MOVE = 3;
/** What an internode counts as before anybody has looked, in pixels. */
const UNSEEN_PIXELS = 30;
/** Nothing is nearer to the eye than this, in internodes. */
const NEAREST = 0.3;

/** From where the branches are seen. */
export interface Onlooker {
  readonly eye: Vec3;
  /** Pixels of an internode at distance one. */
  readonly pixels: number;
}

/** What wood is drawn with. `twig` and `branchDepth` are for strips that face the eye, if there are any. */
export interface WoodMaterials {
  readonly bark: RawShaderMaterial;
  readonly twig: RawShaderMaterial;
  readonly branchDepth: RawShaderMaterial;
}

interface Options {
  /** The bark of all wood; absent where another part sets it. */
  readonly bark?: Bark;
  /** Whether thin wood is drawn as strips, and shadows are; otherwise both passes meet the very same tubes. */
  readonly strips?: boolean;
}

/** All metamers as instances of tube segments and strips, one draw call for each level of detail. */
export class Branches {
  /** What the camera sees: a mesh for each level, `roots` and `faces`. */
  readonly meshes: Mesh[];
  /** What the sun sees: the same, but for `faces` where all of it are strips. */
  readonly casters: Mesh[];
  /** Where branches were cut. */
  readonly faces: Mesh;
  /** What spreads from trunks over the ground. */
  readonly roots: Mesh;
  private readonly fine: BlockGeometry[];
  private readonly quick: BlockGeometry[];
  private readonly shadow: BlockGeometry[];
  private readonly bins: BranchBin[];
  private readonly ends: BranchBin;
  private readonly feet = new Roots(BEGINS_LIMB | FROM_SEED | ROOT);
  private readonly bark: Bark | null;
  private readonly coarsest: number;
  private level = new Int8Array(0);
  private slot = new Int32Array(0);
  private endSlot = new Int32Array(0);
  private known = 0;
  /** The least radius code of a living row, as ends were judged by it last. */
  private thinnest = 0;
  /** Whether it may be another by now. */
  private changed = false;
  private onlooker: Onlooker | null = null;
  private readonly seen: Seen = new Float64Array(2);
  private nextSeen = 0;
  private unseen = 0;

  constructor(materials: WoodMaterials, { bark, strips = true }: Options = {}) {
    this.bark = bark ?? null;
    const levels = LEVELS.filter(({ sides }) => strips || sides > 0);
    this.coarsest = levels.length - 1;
    const shape = (sides: number, segments: number) => (sides > 0 ? tube(sides, segments) : ribbon(segments));
    this.fine = levels.map(({ sides, segments }) => shape(sides, segments));
    this.quick = levels.map(({ quick }) => shape(...quick));
    this.shadow = levels.map(({ sides, segments }) => ribbon(sides > 0 ? CASTER_SEGMENTS : segments));
    const ends = face(FACE_SIDES);
    this.ends = new BranchBin([ends]);
    this.bins = levels.map((_, i) => new BranchBin([this.fine[i]!, this.quick[i]!, this.shadow[i]!]));
    this.meshes = levels.map(({ sides }, i) =>
      mesh(this.fine[i]!, this.bins[i]!.materialLike(sides > 0 ? materials.bark : materials.twig)),
    );
    this.faces = mesh(ends, this.ends.materialLike(materials.bark));
    this.roots = mesh(this.feet.shape(true), this.feet.materialLike(materials.bark));
    this.meshes.push(this.roots, this.faces);
    this.casters = levels.map((_, i) =>
      mesh(strips ? this.shadow[i]! : this.quick[i]!, this.bins[i]!.materialLike(materials.branchDepth)),
    );
    const strip = strips ? this.feet.strip : this.feet.shape(false);
    this.casters.push(mesh(strip, this.feet.materialLike(materials.branchDepth)));
    if (strips) return;
    this.casters.push(mesh(ends, this.ends.materialLike(materials.branchDepth)));
  }

  /** One tube, one strip and one shadow: what nearly every tree has. */
  get essential(): readonly Mesh[] {
    const { meshes, casters, coarsest } = this;
    return [meshes[0]!, meshes[coarsest]!, casters[0]!];
  }

  /** What it is drawn with: copies, one for each list of metamers. */
  get materials(): readonly RawShaderMaterial[] {
    return this.meshes.map(({ material }) => material as RawShaderMaterial);
  }

  /** Gives all wood a bark. */
  setBark(look: BarkLook): void {
    this.bark?.setLook(look);
  }

  /** Rows from `rows` on are gone. */
  truncate(rows: number): void {
    for (let row = rows; row < this.known; row += 1) this.leave(row);
    this.known = Math.min(this.known, rows);
    this.changed = true;
  }

  /** Draws a row as thick as it is now. */
  update(table: TreeTable, row: number): void {
    if (row >= this.known) this.welcome(table, row);
    this.changed = true;
    const parent = table.parent[row]!;
    const code = table.radiusCode[row]!;
    if (parent < 0 || code === 0) {
      this.leave(row);
      return;
    }
    if (this.thinnest === 0) this.thinnest = thinnestOf(table);
    const fromSeed = table.parent[parent]! < 0;
    const origin = table.limbOrigin[row]!;
    const begins = table.limbs.begins[row] === 1 || fromSeed;
    const cut = this.isCut(table, row);
    const level = this.fitting(table, row);
    const flags =
      this.jointAt(table, row, level) |
      (begins ? BEGINS_LIMB : 0) |
      (fromSeed ? FROM_SEED : 0) |
      (table.parent[origin]! < 0 ? TRUNK : 0) |
      (cut ? CUT : 0) |
      (slopeCode(begins ? 0 : table.girth.slope[parent]!) << SLOPE_BELOW) |
      (slopeCode(table.girth.slope[row]!) << SLOPE_ABOVE);
    const changed = this.level[row] !== level;
    this.place(row, level, parent, origin, flags);
    if (changed) this.rejoin(table, table.limbs.onward[row]!);
    this.showFace(row, cut, parent, origin, flags);
    // One that stands with others on its seed leaves the roots to the first of them.
    const stands =
      fromSeed && table.limbs.onward[parent] === row && Math.abs(table.position[3 * parent + 1]!) < ON_GROUND;
    if (stands) this.feet.plant(row, parent);
    else this.feet.leave(row);
  }

  /** From now on rows are looked at from there; those known already by and by. */
  lookFrom(onlooker: Onlooker): void {
    const before = this.onlooker;
    const same =
      before !== null &&
      before.pixels === onlooker.pixels &&
      before.eye.every((place, axis) => Math.abs(place - onlooker.eye[axis]!) < 1e-3);
    if (same) return;
    this.onlooker = { eye: [...onlooker.eye], pixels: onlooker.pixels };
    this.unseen = this.known;
  }

  /**
   * Chooses for some of the rows how finely they are drawn from there, or for all of them at once; says whether some
   * are left for the next frame.
   */
  see(table: TreeTable, onlooker: Onlooker, atOnce: boolean): boolean {
    this.lookFrom(onlooker);
    this.unseen = Math.min(this.unseen, this.known);
    if (this.unseen === 0) return false;
    let left = atOnce ? Number.POSITIVE_INFINITY : ROWS_A_FRAME;
    while (this.unseen > 0 && left > 0) {
      this.nextSeen = this.nextSeen + 1 < this.known ? this.nextSeen + 1 : 0;
      left -= this.level[this.nextSeen]! >= 0 && this.lookAgain(table, this.nextSeen) ? ROWS_A_MOVE : 1;
      this.unseen -= 1;
    }
    this.upload(table);
    return this.unseen > 0;
  }

  /** Whether branches are as round and smooth as they can be, and how many metamers are drawn as strips at most. */
  detail(detailed: boolean, twigs = Number.POSITIVE_INFINITY): void {
    const strips = this.bins.filter((_, i) => LEVELS[i]!.sides === 0);
    const count = strips.reduce((sum, bin) => sum + bin.count, 0);
    for (const bin of strips) bin.thin(Math.max(1, Math.ceil(count / twigs)));
    for (const [i, geometry] of (detailed ? this.fine : this.quick).entries()) this.meshes[i]!.geometry = geometry;
    this.roots.geometry = this.feet.shape(detailed);
  }

  /** Uploads what was written since the last call; ends are judged by the table, where rows are left. */
  upload(table?: TreeTable): void {
    if (table && this.changed) this.judgeEnds(table);
    this.feet.spread();
    const bins = this.lists;
    for (const [i, bin] of bins.entries()) {
      bin.upload();
      this.meshes[i]!.visible = bin.count > 0;
      const caster = this.casters[i];
      if (caster) caster.visible = bin.count > 0;
    }
  }

  /** A restored context has lost every texture. */
  restored(): void {
    for (const bin of this.lists) bin.restored();
    this.bark?.restored();
  }

  dispose(): void {
    for (const bin of this.lists) bin.dispose();
    this.bark?.dispose();
  }

  /** Whether a row is where a limb was cut off. */
  private isCut(table: TreeTable, row: number): boolean {
    return table.limbs.onward[row]! < 0 && table.radiusCode[row]! > this.thinnest + THICK_END;
  }

  /** What is thick for an end depends on every twig, so that all ends are looked at again once the thinnest is another. */
  private judgeEnds(table: TreeTable): void {
    this.changed = false;
    const thinnest = thinnestOf(table);
    if (thinnest === this.thinnest) return;
    this.thinnest = thinnest;
    for (let row = 0; row < this.known; row += 1) {
      const level = this.level[row]!;
      if (level === NOWHERE || table.limbs.onward[row]! >= 0) continue;
      const [, parent, origin, before] = this.bins[level]!.read(this.slot[row]!);
      const cut = this.isCut(table, row);
      const flags = (cut ? before | CUT : before & ~CUT) >>> 0;
      if (flags === before) continue;
      this.bins[level]!.write(this.slot[row]!, row, parent, origin, flags);
      this.showFace(row, cut, parent, origin, flags);
    }
  }

  private welcome(table: TreeTable, row: number): void {
    const capacity = table.parent.length;
    this.level = grown(this.level, capacity);
    this.slot = grown(this.slot, capacity);
    this.endSlot = grown(this.endSlot, capacity);
    this.level.fill(NOWHERE, this.known, row + 1);
    this.endSlot.fill(NOWHERE, this.known, row + 1);
    this.known = row + 1;
  }

  private place(row: number, level: number, parent: number, origin: number, flags: number): void {
    if (this.level[row] !== level) {
      this.leaveLevel(row);
      this.level[row] = level;
      this.slot[row] = this.bins[level]!.add(row, parent, origin, flags);
    } else {
      this.bins[level]!.write(this.slot[row]!, row, parent, origin, flags);
    }
  }

  /** A cut end has a face where it is large enough to be seen. */
  private showFace(row: number, cut: boolean, parent: number, origin: number, flags: number): void {
    const slot = this.endSlot[row]!;
    if (!cut || LEVELS[this.level[row]!]!.sides === 0) this.leaveEnds(row);
    else if (slot === NOWHERE) this.endSlot[row] = this.ends.add(row, parent, origin, flags);
    else this.ends.write(slot, row, parent, origin, flags);
  }

  /** Of all meshes, in their order. */
  private get lists(): readonly BranchBin[] {
    return [...this.bins, this.feet.bin, this.ends];
  }

  private leave(row: number): void {
    this.feet.leave(row);
    this.leaveLevel(row);
    this.leaveEnds(row);
  }

  private leaveLevel(row: number): void {
    const level = this.level[row]!;
    if (level === NOWHERE) return;
    const slot = this.slot[row]!;
    const moved = this.bins[level]!.remove(slot);
    if (moved >= 0) this.slot[moved] = slot;
    this.level[row] = NOWHERE;
  }

  private leaveEnds(row: number): void {
    const slot = this.endSlot[row]!;
    if (slot === NOWHERE) return;
    const moved = this.ends.remove(slot);
    if (moved >= 0) this.endSlot[moved] = slot;
    this.endSlot[row] = NOWHERE;
  }

  /** Says whether the row is drawn otherwise. */
  private lookAgain(table: TreeTable, row: number): boolean {
    const before = this.level[row]!;
    const level = this.fitting(table, row);
    if (level === before) return false;
    const slot = this.slot[row]!;
    const moved = this.bins[before]!.moveTo(this.bins[level]!, slot);
    if (moved >= 0) this.slot[moved] = slot;
    this.level[row] = level;
    const at = this.bins[level]!.count - 1;
    this.slot[row] = at;
    this.rejoin(table, row);
    this.rejoin(table, table.limbs.onward[row]!);
    if (this.bins[level]!.flagsOf(at) & CUT) {
      const [, parent, origin, flags] = this.bins[level]!.read(at);
      this.showFace(row, true, parent, origin, flags);
    }
    return true;
  }

  /** Where a limb passes from one level to another its tubes have to overlap: rings with other sides leave gaps. */
  private jointAt(table: TreeTable, row: number, level: number): number {
    if (table.limbs.begins[row] === 1) return 0;
    const below = this.level[table.parent[row]!] ?? NOWHERE;
    return below !== NOWHERE && below !== level ? OVERLAPS : 0;
  }

  private rejoin(table: TreeTable, row: number): void {
    const level = row >= 0 && row < this.known ? this.level[row]! : NOWHERE;
    if (level === NOWHERE) return;
    const [bin, slot] = [this.bins[level]!, this.slot[row]!];
    bin.setFlags(slot, ((bin.flagsOf(slot) & ~OVERLAPS) | this.jointAt(table, row, level)) >>> 0);
  }

  private fitting(table: TreeTable, row: number): number {
    const { onlooker, seen } = this;
    const { radius: drawn } = table.girth;
    let radius = drawn[row]!;
    // A twig that goes on from a limb begins with the limb's end.
    if (table.limbs.begins[row] !== 1) radius = Math.max(radius, 0.5 * drawn[table.parent[row]!]!);
    // Its foot has ribs, of which each needs as many sides as a limb.
    const seed = table.limbOrigin[row]!;
    if (table.parent[seed]! < 0 && table.arc[row]! < RIBBED * drawn[seed]!) radius *= RIBS;
    seen[1] = UNSEEN_PIXELS;
    if (onlooker) {
      const { position } = table;
      const dx = position[3 * row]! - onlooker.eye[0];
      const dy = position[3 * row + 1]! - onlooker.eye[1];
      const dz = position[3 * row + 2]! - onlooker.eye[2];
      seen[1] = onlooker.pixels / Math.max(NEAREST, Math.sqrt(dx * dx + dy * dy + dz * dz));
    }
    seen[0] = radius * seen[1];
    return Math.min(levelFor(seen, this.level[row]!), this.coarsest);
  }
}

function thinnestOf({ rows, radiusCode }: TreeTable): number {
  let least = 0;
  for (let row = 0; row < rows; row += 1) {
    const code = radiusCode[row]!;
    if (code !== 0 && (least === 0 || code < least)) least = code;
  }
  return least;
}

function mesh(geometry: BlockGeometry, material: RawShaderMaterial): Mesh {
  const made = new Mesh(geometry, material);
  made.frustumCulled = false;
  return made;
}
