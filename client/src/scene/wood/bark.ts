import {
  DataTexture,
  LinearFilter,
  LinearMipmapLinearFilter,
  NearestFilter,
  RepeatWrapping,
  RGBAFormat,
  Vector3,
  Vector4,
} from "three";
import type { BarkKind, BarkLook } from "../../wire/generated";
import type { Uniforms } from "../materials";
import { barkPalette } from "./bark-palette";
import { BARK_SIDE, barkTexels } from "./bark-relief";

/** Sharper where a surface is seen at a slant, as most of a limb is. */
const ANISOTROPY = 2;

/** The bark that all wood wears, as uniforms. Its textures are made when a kind is first worn. */
export class Bark {
  private kind: BarkKind | null = null;
  private readonly colours = { value: texture(new Uint8Array([204, 0, 0, 128]), 1) };
  private readonly relief = { value: texture(new Uint8Array([128, 128, 255, 128]), 1) };
  private readonly palette = { value: Array.from({ length: 5 }, () => new Vector3()) };
  /** Relief, root flare, collar, smoothing. */
  private readonly shape = { value: new Vector4(1, 1, 1, 1) };

  constructor(
    uniforms: Uniforms,
    private readonly side = BARK_SIDE,
  ) {
    uniforms.uBarkColours = this.colours;
    uniforms.uBarkRelief = this.relief;
    uniforms.uBarkPalette = this.palette;
    uniforms.uBarkShape = this.shape;
  }

  /** Whether a bark has been made. */
  get worn(): boolean {
    return this.kind !== null;
  }

  wear(look: BarkLook): void {
    this.shape.value.set(look.relief, look.root_flare, look.collar, look.smoothing);
    for (const [i, colour] of barkPalette(look.kind, look.tint).entries()) this.palette.value[i]!.set(...colour);
    if (look.kind === this.kind) return;
    this.kind = look.kind;
    const texels = barkTexels(look.kind, this.side);
    this.dispose();
    this.colours.value = texture(texels.colours, this.side);
    this.relief.value = texture(texels.relief, this.side);
  }

  /** A restored context has lost the textures. */
  restored(): void {
    this.colours.value.needsUpdate = true;
    this.relief.value.needsUpdate = true;
  }

  dispose(): void {
    this.colours.value.dispose();
    this.relief.value.dispose();
  }
}

function texture(texels: Uint8Array<ArrayBuffer>, side: number): DataTexture {
  const made = new DataTexture(texels, side, side, RGBAFormat);
  made.wrapS = RepeatWrapping;
  made.wrapT = RepeatWrapping;
  made.magFilter = side > 1 ? LinearFilter : NearestFilter;
  made.minFilter = side > 1 ? LinearMipmapLinearFilter : NearestFilter;
  made.generateMipmaps = side > 1;
  made.anisotropy = side > 1 ? ANISOTROPY : 1;
  made.needsUpdate = true;
  return made;
}
