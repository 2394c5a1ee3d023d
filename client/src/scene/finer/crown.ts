import { Data3DTexture, LinearFilter, RGBAFormat, Vector3, type Vector4 } from "three";
import type { Uniforms } from "../materials";
import type { TreeTable } from "../table/tree-table";
import { TaskWorker, type WorkerPort } from "../task-worker";
import { CROWN_SIDE, crownField } from "./crown-field";
import { type CrownBox, crownOf } from "./crown-of";

/** Milliseconds without a change of the tree after which its crown is looked at anew; while it grows the old one will do. */
const SETTLED = 150;

export type CrownWorker = WorkerPort<CrownBox["order"], Uint8Array<ArrayBuffer>>;

/** The crown's field for shaders: made beside the page, and shown in place of the one before when the picture is at rest. */
export class Crown {
  private readonly texture = new Data3DTexture(empty(), CROWN_SIDE, CROWN_SIDE, CROWN_SIDE);
  private readonly from = { value: new Vector3() };
  private readonly size = { value: new Vector3(1, 1, 1) };
  private readonly worker: TaskWorker<CrownBox["order"], Uint8Array<ArrayBuffer>>;
  private timer: ReturnType<typeof setTimeout> | undefined;
  /** What is being made, and what has been made and is not shown yet. */
  private making: CrownBox | null = null;
  private made: { readonly box: CrownBox; readonly field: Uint8Array<ArrayBuffer> } | null = null;
  private stale = false;

  /** `told` is called when a field has been made. */
  constructor(
    private readonly table: TreeTable,
    private readonly uniforms: Uniforms,
    private readonly told: () => void,
    start: () => CrownWorker = startWorker,
  ) {
    this.worker = new TaskWorker(
      start,
      (field) => this.finish(field),
      () => this.making && this.finish(crownField(this.making.order)),
    );
    const { texture } = this;
    texture.format = RGBAFormat;
    texture.minFilter = LinearFilter;
    texture.magFilter = LinearFilter;
    texture.needsUpdate = true;
    Object.assign(uniforms, { uCrownField: { value: texture }, uCrownFrom: this.from, uCrownSize: this.size });
  }

  /** Whether a field has been made and is not shown. */
  get ripe(): boolean {
    return this.made !== null;
  }

  /** Whether one is being made, or has to be. */
  get unfinished(): boolean {
    return this.stale || this.making !== null || this.ripe;
  }

  /** The tree or its leaves have changed. */
  changed(): void {
    this.stale = true;
    clearTimeout(this.timer);
    this.timer = setTimeout(this.begin, SETTLED);
  }

  /** Shows what has been made. */
  ripen(): void {
    const { made, texture } = this;
    if (!made) return;
    this.made = null;
    this.from.value.set(...made.box.from);
    this.size.value.set(...made.box.size);
    texture.image.data = made.field;
    texture.needsUpdate = true;
  }

  /** A restored context has lost it. */
  restored(): void {
    this.texture.needsUpdate = true;
  }

  dispose(): void {
    clearTimeout(this.timer);
    this.worker.end();
    this.texture.dispose();
  }

  private readonly begin = (): void => {
    if (this.making) return;
    this.stale = false;
    this.making = crownOf(this.table, this.leaf);
    const { order } = this.making;
    if (!this.worker.send(order)) this.finish(crownField(order));
  };

  /** How long leaves are, as if all of them were there. */
  private get leaf(): number {
    const { uLeafSize, uLeafSeason } = this.uniforms;
    const season = uLeafSeason?.value as Vector4 | undefined;
    return (uLeafSize!.value as number) * (season ? season.x * Math.sqrt(season.y) : 1);
  }

  private finish(field: Uint8Array<ArrayBuffer>): void {
    this.made = { box: this.making!, field };
    this.making = null;
    if (this.stale) this.changed();
    this.told();
  }
}

/** Nothing stands anywhere: no way out, and all of the sky. */
function empty(): Uint8Array<ArrayBuffer> {
  const texels = new Uint8Array(4 * CROWN_SIDE ** 3).fill(128);
  for (let at = 3; at < texels.length; at += 4) texels[at] = 255;
  return texels;
}

function startWorker(): CrownWorker {
  return new Worker(new URL("./crown-worker.ts", import.meta.url), { type: "module" }) as unknown as CrownWorker;
}
