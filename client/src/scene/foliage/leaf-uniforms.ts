import { Vector3, Vector4 } from "three";
import { DEFAULT_APPEARANCE, LEAF_NATURES, type LeafLook } from "../../wire/generated";
import { linear } from "../light/colours";
import type { Uniforms } from "../materials";
import { GradualTextures } from "../painting/gradual-textures";
import type { Painter } from "../painting/painter";
import { seasonOf } from "./leaf-season";

/** The textures of leaves and the uniforms that carry their look to the shaders. */
export class LeafUniforms {
  /** How far the picture in use reaches to the sides; whether it is a spray, how far it leans and bends. */
  private readonly form = { value: new Vector4() };
  private readonly season = { value: new Vector4() };
  private readonly traits = { value: new Vector4() };
  private readonly blades = { value: 1 };
  private readonly tint = { value: new Vector3() };
  private readonly autumn = [{ value: new Vector3() }, { value: new Vector3() }, { value: new Vector3() }] as const;
  /** Single leaves, and sprigs of them. */
  readonly textures: GradualTextures<"leaf">;

  constructor(uniforms: Uniforms, painter: Painter) {
    this.textures = new GradualTextures("leaf", painter, { pictures: 2, early: true });
    const [single, sprig] = this.textures.drawn;
    const { form } = this;
    Object.assign(uniforms, {
      uLeafLevel: { value: new Vector3(2, 1, 1) },
      uLeafBlades: this.blades,
      uLeafTwig: { value: 0 },
      uLeafBand: { value: new Vector3(0, 0, 1) },
      uLeafForm: {
        get value() {
          form.value.x = single!.reach.value;
          return form.value;
        },
      },
      uLeafSeason: this.season,
      uLeafTraits: this.traits,
      uLeafTint: this.tint,
      uLeafFirst: this.autumn[0],
      uLeafLast: this.autumn[1],
      uLeafDead: this.autumn[2],
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
    const { is_spray, lean, bend, autumn } = LEAF_NATURES[look.shape];
    this.form.value.set(1, is_spray ? 1 : 0, lean, bend);
    this.season.value.set(unfolded, present, fresh, turned);
    this.blades.value = look.blades;
    this.traits.value.set(look.vigor_shift, look.orientation, withered, 0);
    this.tint.value.set(...linear(look.tint));
    for (const [i, { value }] of this.autumn.entries()) value.set(...linear(autumn[i]!));
  }

  /** A restored context has lost the textures. */
  restored(): void {
    this.textures.restored();
  }

  dispose(): void {
    this.textures.dispose();
  }
}
