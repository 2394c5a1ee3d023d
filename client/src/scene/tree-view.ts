import { Group, type InstancedBufferGeometry, Mesh, type RawShaderMaterial } from "three";
import type { Appearance } from "../wire/generated";
import { Foliage } from "./foliage/foliage";
import type { Materials, Uniforms } from "./materials";
import type { DrawMode, Legend } from "./mode/draw-mode";
import { type Shown, USUAL } from "./mode/shown";
import { SkeletonLines } from "./mode/skeleton-lines";
import { TraitTexture } from "./mode/trait-texture";
import { Overlays } from "./overlay/overlays";
import type { GradualTextures } from "./painting/gradual-textures";
import type { Sort } from "./painting/paint";
import type { Painter } from "./painting/painter";
import type { Fineness } from "./rendering/fineness";
import { NodeTexture } from "./table/node-texture";
import { PlaceEase } from "./table/place-ease";
import { RadiusEase } from "./table/radius-ease";
import { type Dyed, RowDyes } from "./table/row-dyes";
import { Dirty, type TreeTable } from "./table/tree-table";
import { Bark } from "./wood/bark";
import { Branches } from "./wood/branches";

/** Metamers of a sketch at most. */
const SKETCHED = 120_000;

/** The tree as it is drawn: its table on the graphics card, its bark and leaves, or the lines of a draw mode. */
export class TreeView {
  readonly overlays = new Overlays();
  /** Drawn into the picture. */
  readonly group = new Group();
  /** Drawn into the shadow map. */
  readonly casters = new Group();
  private readonly textures: readonly GradualTextures<Sort>[];
  private readonly solid = new Group();
  private readonly dyes = new RowDyes();
  private readonly nodes = new NodeTexture(this.dyes);
  private readonly radii = new RadiusEase();
  private readonly places = new PlaceEase();
  private readonly traits: TraitTexture;
  private readonly branches: Branches;
  private readonly foliage: Foliage;
  private readonly skeleton: SkeletonLines;
  private mode: DrawMode = "lit";
  private shown: Shown = USUAL;
  private tableChanged = true;
  private overlaysChanged = false;

  constructor(
    private readonly table: TreeTable,
    materials: Materials,
    uniforms: Uniforms,
    painter: Painter,
  ) {
    uniforms.uNodes = this.nodes.uniform;
    uniforms.uOverlays = this.overlays.uniform;
    uniforms.uDyes = this.dyes.uniform;
    this.traits = new TraitTexture(uniforms);
    const bark = new Bark(uniforms, painter);
    this.branches = new Branches(materials, { bark });
    this.foliage = new Foliage(materials, uniforms, painter);
    this.textures = [bark.textures, ...this.foliage.textures];
    this.skeleton = new SkeletonLines(materials);
    this.solid.add(...this.branches.meshes, ...this.foliage.meshes);
    this.group.add(this.solid, this.skeleton.mesh);
    this.casters.add(...this.branches.casters, ...this.foliage.casters);
  }

  /** What wood is drawn with. */
  get wood(): readonly RawShaderMaterial[] {
    return this.branches.materials;
  }

  /** What the draw mode's colours mean. */
  get legend(): Legend | null {
    return this.traits.legend;
  }

  /** When the last radius or place that glides will have arrived, in the table's seconds. */
  get glidesUntil(): number {
    return Math.max(this.radii.until, this.places.until);
  }

  /** Has the whole textures of what nearly every tree has painted, before they are drawn with. */
  paint(): void {
    for (const textures of this.textures) textures.paint();
  }

  /** Whether whole textures are there and coarse ones still shown. */
  get ripe(): boolean {
    return this.textures.some(({ ripe }) => ripe);
  }

  /** Whether textures are still being painted, or not yet shown. */
  get unfinished(): boolean {
    return this.textures.some(({ unfinished }) => unfinished);
  }

  /** Whether textures are still being painted. */
  get awaited(): boolean {
    return this.textures.some(({ awaited }) => awaited);
  }

  /** Shows whole textures in place of coarse ones. */
  ripen(): void {
    for (const textures of this.textures) textures.ripen();
  }

  /** What nearly every tree has, for all it takes on the graphics card to be made before there is one. */
  get essential(): readonly Mesh[] {
    return [...this.branches.essential, ...this.foliage.essential];
  }

  /** The axes as lines. */
  get lines(): Mesh {
    return this.skeleton.mesh;
  }

  /** Has the axes drawn as lines, however large the tree is; what has changed is still to be taken over after that. */
  sketch(draw: (lines: Mesh) => void): void {
    const { table, nodes, skeleton } = this;
    nodes.reserve(table.rows);
    for (let row = 0; row < table.rows; row += 1) nodes.write(table, row);
    nodes.upload();
    skeleton.show(table, true, SKETCHED);
    draw(skeleton.mesh);
    // As long as nothing else has been shown of a row, it does not glide from what it was to what it is.
    nodes.truncate(0);
    nodes.uploadWhole();
    skeleton.changed();
    skeleton.show(table, false);
  }

  /** How far leaves have given way to sprigs, 0 to 1. */
  get merged(): number {
    return this.foliage.merged;
  }

  /** The table has changed. */
  changed(): void {
    this.tableChanged = true;
  }

  /** The content of an overlay has changed. */
  overlayChanged(): void {
    this.overlaysChanged = true;
  }

  /** The colours that branches have of their own. */
  setDyes(dyed: Dyed): void {
    this.dyes.tell(dyed);
  }

  /** What bark, leaves, flowers and fruits look like. */
  setAppearance({ bark, leaves, flowers, fruits }: Appearance): void {
    this.branches.setBark(bark);
    if (this.table.shape(bark.root_flare, bark.smoothing > 0)) this.changed();
    this.foliage.setLook(leaves, flowers, fruits);
    this.foliage.upload(this.table);
  }

  /** What is shown of it, and how. */
  show(mode: DrawMode, shown: Shown): void {
    this.mode = mode;
    this.shown = shown;
    this.traits.show(mode);
    for (const { material } of this.solids()) material.wireframe = this.net;
    this.skeleton.over(mode !== "skeleton");
  }

  /** Whether triangles are drawn as their edges. */
  private get net(): boolean {
    return this.mode === "wireframe" || this.shown.wireframe;
  }

  /** Takes over what changed, to be seen from there; says whether rows did. */
  sync(fineness: Fineness): boolean {
    const { table, tableChanged } = this;
    this.branches.lookFrom(fineness);
    if (tableChanged) this.syncTable();
    this.dyes.assign(table, (row) => this.nodes.dyed(table, row), tableChanged);
    this.traits.upload(table);
    if (tableChanged || this.overlaysChanged) this.syncOverlays(tableChanged);
    this.places.step(table.now(), table.rows, (row, from, at, left) => this.nodes.glide(table, row, from, at, left));
    this.nodes.upload();
    this.showMode();
    return tableChanged;
  }

  /** Chooses how finely everything is drawn, for a picture that stays at once; says whether some is left to the next frame. */
  detail(fineness: Fineness, stays: boolean): boolean {
    const unsettled = this.branches.see(this.table, fineness, stays);
    this.branches.detail(fineness.detailed, fineness.twigs);
    this.foliage.detail(fineness, this.table.bounds());
    this.showMode();
    return unsettled;
  }

  /** A restored context has lost every texture. */
  restored(): void {
    this.nodes.uploadWhole();
    this.branches.restored();
    this.overlays.uploadWhole();
    this.traits.restored();
    this.skeleton.restored();
    this.foliage.restored();
  }

  dispose(): void {
    for (const part of [this.branches, this.foliage, this.skeleton, this.nodes, this.overlays, this.traits])
      part.dispose();
  }

  private syncTable(): void {
    this.tableChanged = false;
    const { table } = this;
    const now = table.now();
    this.nodes.reserve(table.rows);
    table.drain(
      (rows) => {
        this.nodes.truncate(rows);
        this.dyes.truncate(rows);
        this.branches.truncate(rows);
        this.foliage.truncate(rows);
        this.traits.truncate(rows);
      },
      (row, bits) => {
        const moved = (bits & Dirty.Shape) !== 0;
        this.noteRadius(row, this.overlays.slotOf(row), now);
        if (!moved) this.nodes.notePlace(this.places, row);
        this.nodes.write(table, row);
        this.branches.update(table, row);
        this.traits.update(row, moved);
        this.foliage.update(table, row, bits);
      },
    );
    this.places.begin(now, table.course.placed);
    this.branches.upload(table);
    this.foliage.upload(table);
    this.skeleton.changed();
  }

  private syncOverlays(tableChanged: boolean): void {
    const { table } = this;
    this.overlaysChanged = false;
    const now = table.now();
    if (tableChanged) this.overlays.settle(table);
    const assigned = this.overlays.assign(
      table,
      (row, slot, before) => {
        this.noteRadius(row, before, now);
        this.nodes.setSlot(table, row, slot);
      },
      tableChanged,
    );
    if (!assigned) this.overlays.write(table);
    this.radii.begin(
      now,
      (row) => this.overlays.radiusIn(this.overlays.slotOf(row), table.girth.radius[row]!),
      (row, from) => this.nodes.ease(row, from, now),
    );
  }

  /** A row is about to change; until now it was drawn with what this slot makes of its radius. */
  private noteRadius(row: number, slot: number, now: number): void {
    if (!this.nodes.shows(row)) return;
    const shown = (radius: number) => this.overlays.radiusIn(slot, radius);
    this.radii.note(row, this.nodes.shownRadius(row, now, shown));
  }

  /** Axes alone are lines, and cast no shadow as wide as the branches they stand for. */
  private showMode(): void {
    const bare = this.mode === "skeleton";
    this.solid.visible = !bare;
    this.casters.visible = !bare;
    this.skeleton.show(this.table, bare || this.shown.skeleton);
    if (!this.net) return;
    // three.js makes the lines of triangles only where there is an attribute of this name.
    for (const { geometry } of this.solids()) {
      const any = Object.values(geometry.attributes).find((attribute) => !("isInstancedBufferAttribute" in attribute));
      if (any && !geometry.hasAttribute("position")) geometry.setAttribute("position", any);
    }
  }

  private *solids(): Iterable<Mesh<InstancedBufferGeometry, RawShaderMaterial>> {
    for (const mesh of this.solid.children) {
      if (mesh instanceof Mesh) yield mesh;
    }
  }
}
