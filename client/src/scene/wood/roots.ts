import type { RawShaderMaterial } from "three";
import type { BlockGeometry } from "../block-geometry";
import { MOST_ROOTS } from "../glsl/roots";
import { BranchBin } from "./branch-bin";
import { ribbon, tube } from "./branch-shapes";

/** Sides and segments of a root, and while frames must be quick. */
const FINE = [12, 14] as const;
const QUICK = [6, 5] as const;
/** Segments of the strip that casts its shadow. */
const CASTER_SEGMENTS = 6;
/** Where the flags hold which of its seed's roots it is. */
const NUMBER = 24;

/** What trunks spread over the ground, drawn in one call: as many roots for each as there may be, of which the shader draws those it has. */
export class Roots {
  readonly bin: BranchBin;
  /** Of what casts their shadows. */
  readonly strip = ribbon(CASTER_SEGMENTS);
  private readonly shapes: readonly [fine: BlockGeometry, quick: BlockGeometry];
  /** Rows of the seeds that trunks stand on, by those of the first metamers of these. */
  private readonly seeds = new Map<number, number>();
  /** Whether others are drawn. */
  private stale = false;

  /** Flags of each root. */
  constructor(private readonly flags: number) {
    this.shapes = [tube(...FINE), tube(...QUICK)];
    this.bin = new BranchBin([...this.shapes, this.strip]);
  }

  /** Another material like this one, for roots. */
  materialLike(material: RawShaderMaterial): RawShaderMaterial {
    return this.bin.materialLike(material);
  }

  shape(detailed: boolean): BlockGeometry {
    return this.shapes[detailed ? 0 : 1];
  }

  /** The trunk that begins with this row stands on a seed. */
  plant(row: number, seed: number): void {
    if (this.seeds.get(row) === seed) return;
    this.seeds.set(row, seed);
    this.stale = true;
  }

  /** The row is no trunk's that has roots. */
  leave(row: number): void {
    if (this.seeds.delete(row)) this.stale = true;
  }

  /** Writes what is drawn, if that is something else than before. */
  spread(): void {
    if (!this.stale) return;
    this.stale = false;
    this.bin.count = 0;
    for (const [row, seed] of this.seeds) {
      for (let root = 0; root < MOST_ROOTS; root += 1) this.bin.add(row, seed, seed, this.flags | (root << NUMBER));
    }
  }
}
