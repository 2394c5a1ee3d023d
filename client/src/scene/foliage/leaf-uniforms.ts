import { Vector2, Vector3, Vector4 } from "three";
import { DEFAULT_APPEARANCE, type LeafKind, type LeafLook } from "../../wire/generated";
import { linear } from "../light/colours";
import type { Uniforms } from "../materials";
import { GradualTextures } from "../painting/gradual-textures";
import { isSpray } from "../painting/lamina";
import { reachOf } from "../painting/leaf-pictures";
import type { Painter } from "../painting/painter";
import { seasonOf } from "./leaf-season";

/** Colours that a kind of leaf turns into: first, at last, and dead, as the screen shows them. */
const AUTUMN: Record<LeafKind, readonly [number[], number[], number[]]> = {
  ovate: [
    [222, 176, 50],
    [192, 96, 34],
    [124, 82, 50],
  ],
  round: [
    [236, 194, 54],
    [220, 152, 38],
    [120, 88, 50],
  ],
  lanceolate: [
    [224, 200, 84],
    [206, 160, 62],
    [124, 98, 58],
  ],
  lobed: [
    [190, 142, 60],
    [142, 80, 42],
    [116, 78, 48],
  ],
  palmate: [
    [240, 164, 38],
    [190, 44, 28],
    [130, 70, 44],
  ],
  fan: [
    [246, 208, 54],
    [242, 188, 40],
    [150, 112, 56],
  ],
  compound: [
    [232, 182, 50],
    [208, 92, 36],
    [122, 82, 48],
  ],
  needle: [
    [170, 140, 60],
    [160, 110, 50],
    [122, 96, 60],
  ],
  scale: [
    [150, 140, 66],
    [150, 120, 60],
    [112, 96, 62],
  ],
};
/** How far sprays lie along their twig, of the way from the direction of a single leaf. */
const LEAN: Partial<Record<LeafKind, number>> = { needle: 0.6, scale: 0.72 };
/** How much a blade bows and folds; long and heavy ones hang. */
const BEND: Partial<Record<LeafKind, number>> = { lanceolate: 1.3, compound: 1.4, palmate: 0.9, fan: 0.5, needle: 0.3 };

/** The textures of leaves and the uniforms that carry their look to the shaders. */
export class LeafUniforms {
  private readonly form = { value: new Vector4() };
  private readonly season = { value: new Vector4() };
  private readonly traits = { value: new Vector4() };
  private readonly tint = { value: new Vector3() };
  private readonly autumn = { value: [new Vector3(), new Vector3(), new Vector3()] };
  /** Single leaves, and sprigs of them. */
  readonly textures: GradualTextures<"leaf">;

  constructor(uniforms: Uniforms, painter: Painter) {
    this.textures = new GradualTextures("leaf", painter, { pictures: 2 });
    const [single, sprig] = this.textures.drawn;
    Object.assign(uniforms, {
      uLeafLevel: { value: new Vector2(2, 1) },
      uLeafBand: { value: new Vector3(0, 0, 1) },
      uLeafForm: this.form,
      uLeafSeason: this.season,
      uLeafTraits: this.traits,
      uLeafTint: this.tint,
      uLeafAutumn: this.autumn,
      uLeafColour: single!.colour,
      uLeafRelief: single!.relief,
      uSprigColour: sprig!.colour,
      uSprigRelief: sprig!.relief,
      uSprigSpan: sprig!.span,
    });
    this.setLook(DEFAULT_APPEARANCE.leaves);
  }

  /** Shows another look. */
  setLook(look: LeafLook): void {
    this.textures.choose(look.shape);
    const { unfolded, present, fresh, turned, withered } = seasonOf(look.shape, look.season);
    const reach = reachOf(look.shape);
    this.form.value.set(reach, isSpray(look.shape) ? 1 : 0, LEAN[look.shape] ?? 0, BEND[look.shape] ?? 1);
    this.season.value.set(unfolded, present, fresh, turned);
    this.traits.value.set(look.vigor_shift, look.orientation, withered, 0);
    this.tint.value.set(...linear(look.tint));
    for (const [i, colour] of AUTUMN[look.shape].entries()) this.autumn.value[i]!.set(...linear(colour));
  }

  /** A restored context has lost the textures. */
  restored(): void {
    this.textures.restored();
  }

  dispose(): void {
    this.textures.dispose();
  }
}
