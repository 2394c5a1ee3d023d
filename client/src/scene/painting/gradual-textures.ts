import { DataTexture, LinearFilter, LinearMipmapLinearFilter, RepeatWrapping, RGBAFormat, type Texture } from "three";
import type { Levels } from "./leaf-atlas";
import { type Kinds, type Order, paint, type Sort } from "./paint";
import type { Painter } from "./painter";

/** For a shader's uniforms: painted when it is first drawn with. */
export interface Drawn {
  readonly colour: { readonly value: Texture };
  readonly relief: { readonly value: Texture };
  /** How many leaves long the picture is. */
  readonly span: { readonly value: number };
}

interface Pair {
  readonly colour: DataTexture;
  readonly relief: DataTexture;
  readonly span: number;
}

const BLANK: Levels = { colour: [new Uint8Array(4)], relief: [new Uint8Array(4)] };

interface Options {
  /** Whether the picture goes on without a seam beyond its edges. */
  readonly tiling?: boolean;
  /** How much sharper it is kept where it is seen at a slant. */
  readonly anisotropy?: number;
  /** Pictures that belong together. */
  readonly pictures?: number;
}

/**
 * Pictures of one kind as textures: blank ones until the painter begins, coarse ones the moment they are drawn with, and
 * the whole ones in their place once they have been painted and the time is right. A restored context gets them from
 * memory again.
 */
export class GradualTextures<S extends Sort> {
  readonly drawn: readonly Drawn[];
  private readonly tiling: boolean;
  private readonly anisotropy: number;
  private kind: Kinds[S] | null = null;
  private pairs: Pair[] | null = null;
  private finer: Levels[] | null = null;
  /** Blank textures until the picture is visible, so that the graphics card can prepare its programs. */
  private blank: Pair[] | null = null;
  private callOff: (() => void) | null = null;

  constructor(
    private readonly sort: S,
    private readonly painter: Painter,
    { tiling = false, anisotropy = 4, pictures = 1 }: Options = {},
  ) {
    this.tiling = tiling;
    this.anisotropy = anisotropy;
    this.drawn = Array.from({ length: pictures }, (_, i) => this.uniforms(i));
  }

  /** Shows another kind from the next frame on. */
  choose(kind: Kinds[S]): void {
    if (kind === this.kind) return;
    this.dispose();
    this.kind = kind;
  }

  /** Whether the whole pictures are there and not yet shown. */
  get ripe(): boolean {
    return this.finer !== null;
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
    };
  }

  private painted(): Pair[] {
    if (!this.painter.begun) {
      this.blank ??= this.drawn.map(() => this.pairOf(BLANK));
      return this.blank;
    }
    if (!this.pairs) {
      this.pairs = paint(this.order(true)).map((levels) => this.pairOf(levels));
      this.callOff = this.painter.order(this.order(false), (finer) => {
        this.callOff = null;
        this.finer = finer;
      });
    }
    return this.pairs;
  }

  private order(coarse: boolean): Order {
    const { sort, kind } = this;
    if (kind === null) throw new Error(`No kind of ${sort} has been chosen.`);
    return { sort, kind, coarse } as unknown as Order;
  }

  private pairOf({ colour, relief, span = 1 }: Levels): Pair {
    return { colour: this.textureOf(colour), relief: this.textureOf(relief), span };
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
