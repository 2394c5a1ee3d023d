import { DataTexture, LinearFilter, LinearMipmapLinearFilter, RepeatWrapping, RGBAFormat, type Texture } from "three";
import type { Levels } from "./leaf-atlas";
import { MOST_SHADE } from "./measures";
import type { Kinds, Order, Sort } from "./paint";
import type { Painter } from "./painter";

/** For a shader's uniforms: painted when it is first drawn with. */
export interface Drawn {
  readonly colour: { readonly value: Texture };
  readonly relief: { readonly value: Texture };
  /** How many leaves long the picture is. */
  readonly span: { readonly value: number };
  /** Half the width of its card, in the length of a leaf. */
  readonly reach: { readonly value: number };
}

interface Pair {
  readonly colour: DataTexture;
  readonly relief: DataTexture;
  readonly span: number;
  readonly reach: number;
}

/** Even wood, in the middle of its shades; and no leaf, flower or fruit at all. */
const BLANK: Levels = {
  colour: [new Uint8Array([Math.round(255 / MOST_SHADE), 0, 0, 0])],
  relief: [new Uint8Array([128, 128, 255, 128])],
};

interface Options {
  /** Whether the picture goes on without a seam beyond its edges. */
  readonly tiling?: boolean;
  /** How much sharper it is kept where it is seen at a slant. */
  readonly anisotropy?: number;
  /** Pictures that belong together. */
  readonly pictures?: number;
  /** Whether the coarse picture is painted before it is first drawn with, as of what nearly every tree has. */
  readonly early?: boolean;
}

/**
 * Pictures of one kind as textures: blank ones at first, coarse ones as soon as they have been painted, and the whole
 * ones in their place once those have and the time is right. A restored context gets them from memory again.
 */
export class GradualTextures<S extends Sort> {
  readonly drawn: readonly Drawn[];
  private readonly tiling: boolean;
  private readonly anisotropy: number;
  private readonly early: boolean;
  private kind: Kinds[S] | null = null;
  private pairs: Pair[] | null = null;
  private finer: Levels[] | null = null;
  /** Drawn with until there is more, so that the graphics card can prepare its programs. */
  private blank: Pair[] | null = null;
  /** Whether the whole picture has been ordered. */
  private asked = false;
  private callOff: (() => void) | null = null;

  constructor(
    private readonly sort: S,
    private readonly painter: Painter,
    { tiling = false, anisotropy = 4, pictures = 1, early = false }: Options = {},
  ) {
    this.tiling = tiling;
    this.anisotropy = anisotropy;
    this.early = early;
    this.drawn = Array.from({ length: pictures }, (_, i) => this.uniforms(i));
  }

  /** Shows another kind from the next frame on. */
  choose(kind: Kinds[S]): void {
    if (kind === this.kind) return;
    this.dispose();
    this.kind = kind;
    if (this.early) this.orderCoarse();
  }

  /** Has the whole picture painted before it is first drawn with, if the coarse one was. */
  paint(): void {
    if (this.early && this.kind !== null) this.painted();
  }

  /** Whether the whole pictures are there and not yet shown. */
  get ripe(): boolean {
    return this.finer !== null;
  }

  /** Whether a picture of them is still being painted. */
  get awaited(): boolean {
    return this.callOff !== null;
  }

  /** Whether they are still to come. */
  get unfinished(): boolean {
    return this.callOff !== null || this.finer !== null;
  }

  /** Shows the whole pictures in place of the coarse ones. */
  ripen(): void {
    const { finer, pairs } = this;
    if (!finer) return;
    this.finer = null;
    this.pairs = finer.map((levels) => this.pairOf(levels));
    for (const pair of pairs ?? []) letGo(pair);
  }

  /** A restored context has lost them. */
  restored(): void {
    for (const { colour, relief } of this.held()) {
      colour.needsUpdate = true;
      relief.needsUpdate = true;
    }
  }

  /** Lets go of them; what is drawn next is painted again. */
  dispose(): void {
    this.callOff?.();
    this.callOff = null;
    this.finer = null;
    for (const pair of this.held()) letGo(pair);
    this.pairs = null;
    this.blank = null;
    this.asked = false;
  }

  private held(): Pair[] {
    return [...(this.pairs ?? []), ...(this.blank ?? [])];
  }

  private uniforms(i: number): Drawn {
    const pair = () => this.painted()[i]!;
    return {
      colour: {
        get value() {
          return pair().colour;
        },
      },
      relief: {
        get value() {
          return pair().relief;
        },
      },
      span: {
        get value() {
          return pair().span;
        },
      },
      reach: {
        get value() {
          return pair().reach;
        },
      },
    };
  }

  private painted(): Pair[] {
    if (this.painter.begun) {
      if (!this.pairs && !this.callOff) this.orderCoarse();
      if (this.pairs && !this.asked) this.orderWhole();
    }
    this.blank ??= this.pairs ? null : this.drawn.map(() => this.pairOf(BLANK));
    return this.pairs ?? this.blank!;
  }

  private orderCoarse(): void {
    this.callOff = this.painter.order(this.order(true), (coarse) => {
      this.callOff = null;
      this.pairs = coarse.map((levels) => this.pairOf(levels));
      for (const pair of this.blank ?? []) letGo(pair);
      this.blank = null;
      if (this.painter.begun) this.orderWhole();
    });
  }

  private orderWhole(): void {
    this.asked = true;
    this.callOff = this.painter.order(this.order(false), (finer) => {
      this.callOff = null;
      this.finer = finer;
    });
  }

  private order(coarse: boolean): Order {
    const { sort, kind } = this;
    if (kind === null) throw new Error(`No kind of ${sort} has been chosen.`);
    return { sort, kind, coarse } as unknown as Order;
  }

  private pairOf({ colour, relief, span = 1, reach = 1 }: Levels): Pair {
    return { colour: this.textureOf(colour), relief: this.textureOf(relief), span, reach };
  }

  private textureOf(levels: readonly Uint8Array<ArrayBuffer>[]): DataTexture {
    const side = Math.sqrt(levels[0]!.length / 4);
    const texture = new DataTexture(levels[0]!, side, side, RGBAFormat);
    if (levels.length > 1) texture.mipmaps = levels.map((data, i) => ({ data, width: side >> i, height: side >> i }));
    else texture.generateMipmaps = true;
    if (this.tiling) {
      texture.wrapS = RepeatWrapping;
      texture.wrapT = RepeatWrapping;
    }
    texture.magFilter = LinearFilter;
    texture.minFilter = LinearMipmapLinearFilter;
    texture.anisotropy = this.anisotropy;
    texture.needsUpdate = true;
    return texture;
  }
}

function letGo({ colour, relief }: Pair): void {
  colour.dispose();
  relief.dispose();
}
