import {
  DataTexture,
  FloatType,
  NearestFilter,
  type RawShaderMaterial,
  RGBAFormat,
  RGBAIntegerFormat,
  type ShaderMaterial,
  UnsignedIntType,
} from "three";
import { ITEMS_A_LINE } from "./glsl/items";
import { grown } from "./table/column";

/** Numbers a texel holds. */
const TEXEL = 4;

/**
 * Many things of one kind that are drawn with one shape, so many texels of numbers each. Shaders fetch them by number
 * (`glsl/items.ts`), so that one instance can draw a block of things: where the processor draws in place of a graphics card,
 * an instance takes as long as a hundred vertices, whatever it is.
 */
export class ItemTexture<Numbers extends Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>> {
  /** Numbers of each thing, one after the other; another array once there are more of them. */
  numbers: Numbers;
  private readonly stride: number;
  private readonly texture: { value: DataTexture };
  private readonly drawn = { value: [0, 1] };
  private readonly stale = new Set<number>();
  /** Whether the graphics card has yet to get all of it: parts of a new texture would leave the others empty. */
  private whole = true;

  /** `array` makes the numbers, `texels` is how many each thing has. */
  constructor(
    array: new (length: number) => Numbers,
    private readonly texels: number,
  ) {
    this.stride = TEXEL * texels;
    this.numbers = new array(ITEMS_A_LINE * this.stride);
    this.texture = { value: this.allocate() };
  }

  /** How many are drawn. */
  get count(): number {
    return this.drawn.value[0]!;
  }

  /** Gives a material these things besides the uniforms that it shares with others. */
  enter<Material extends ShaderMaterial>(material: Material): Material {
    material.uniforms = Object.assign(Object.create(material.uniforms), {
      uItems: this.texture,
      uItemsDrawn: this.drawn,
    });
    return material;
  }

  /** The same for another material like this one. */
  copyOf(material: RawShaderMaterial): RawShaderMaterial {
    const { uniforms } = material;
    // Copied with it, each texture in them would become another one.
    material.uniforms = {};
    const copy = material.clone();
    material.uniforms = uniforms;
    copy.uniforms = uniforms;
    return this.enter(copy);
  }

  /** Reserves capacity for so many. */
  reserve(items: number): void {
    const line = ITEMS_A_LINE * this.stride;
    let lines = this.numbers.length / line;
    if (items <= lines * ITEMS_A_LINE) return;
    while (lines * ITEMS_A_LINE < items) lines *= 2;
    this.numbers = grown(this.numbers, lines * line);
    this.texture.value.dispose();
    this.texture.value = this.allocate();
    this.uploadWhole();
  }

  /** Numbers of these have changed. */
  touch(first: number, count = 1): void {
    const last = Math.floor((first + count - 1) / ITEMS_A_LINE);
    for (let line = Math.floor(first / ITEMS_A_LINE); line <= last; line += 1) this.stale.add(line);
  }

  /** Has three.js upload what has changed; so many are drawn. */
  upload(count: number): void {
    this.drawn.value[0] = count;
    if (this.stale.size === 0) return;
    const texture = this.texture.value;
    const line = ITEMS_A_LINE * this.stride;
    if (!this.whole) for (const each of this.stale) texture.addUpdateRange(each * line, line);
    texture.needsUpdate = true;
    this.stale.clear();
  }

  /** Draws only every so manieth. */
  thin(step: number): void {
    this.drawn.value[1] = step;
  }

  /** A new texture, or one of a restored context, needs all of it. */
  uploadWhole(): void {
    this.whole = true;
    this.texture.value.clearUpdateRanges();
    this.texture.value.needsUpdate = true;
  }

  dispose(): void {
    this.texture.value.dispose();
  }

  private allocate(): DataTexture {
    const { numbers, texels } = this;
    const height = numbers.length / (ITEMS_A_LINE * this.stride);
    const texture =
      numbers instanceof Uint32Array
        ? new DataTexture(numbers, ITEMS_A_LINE * texels, height, RGBAIntegerFormat, UnsignedIntType)
        : new DataTexture(numbers, ITEMS_A_LINE * texels, height, RGBAFormat, FloatType);
    if (numbers instanceof Uint32Array) texture.internalFormat = "RGBA32UI";
    texture.minFilter = NearestFilter;
    texture.magFilter = NearestFilter;
    texture.generateMipmaps = false;
    texture.onUpdate = () => {
      this.whole = false;
    };
    texture.needsUpdate = true;
    return texture;
  }
}
