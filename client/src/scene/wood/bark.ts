import { Vector3, Vector4 } from "three";
import { type BarkLook, DEFAULT_APPEARANCE } from "../../wire/generated";
import type { Uniforms } from "../materials";
import { barkPalette } from "../painting/bark-palette";
import { GradualTextures } from "../painting/gradual-textures";
import type { Painter } from "../painting/painter";

/** Sharper where a surface is seen at a slant, as most of a limb is. */
const ANISOTROPY = 2;

/** The bark of all wood, as uniforms. */
export class Bark {
  readonly textures: GradualTextures<"bark">;
  private readonly palette = { value: Array.from({ length: 5 }, () => new Vector3()) };
  /** Relief, root flare, collar, smoothing. */
  private readonly shape = { value: new Vector4(1, 1, 1, 1) };

  constructor(uniforms: Uniforms, painter: Painter) {
    this.textures = new GradualTextures("bark", painter, { tiling: true, anisotropy: ANISOTROPY, early: true });
    const [{ colour, relief }] = this.textures.drawn as [GradualTextures<"bark">["drawn"][number]];
    uniforms.uBarkColours = colour;
    uniforms.uBarkRelief = relief;
    uniforms.uBarkPalette = this.palette;
    uniforms.uBarkShape = this.shape;
    this.setLook(DEFAULT_APPEARANCE.bark);
  }

  setLook(look: BarkLook): void {
    this.shape.value.set(look.relief, look.root_flare, look.collar, look.smoothing);
    for (const [i, colour] of barkPalette(look.kind, look.tint).entries()) this.palette.value[i]!.set(...colour);
    this.textures.choose(look.kind);
  }

  /** A restored context has lost the textures. */
  restored(): void {
    this.textures.restored();
  }

  dispose(): void {
    this.textures.dispose();
  }
}
