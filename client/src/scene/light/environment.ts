import { BufferAttribute, BufferGeometry, CircleGeometry, Mesh, Vector2, Vector3, Vector4 } from "three";
import { type Background, DEFAULT_APPEARANCE, type Ground } from "../../wire/generated";
import { MOST_FEET } from "../glsl/environment";
import type { Materials, Uniforms } from "../materials";
import type { TreeTable } from "../table/tree-table";
import { trunkFeet } from "../table/trunk-feet";
import { harmonicsOf, studioOf } from "./sky-harmonics";
import { skyLight } from "./sky-light";

/** The ground goes on to this far, and further for a tree that is seen from further off. */
const GROUND_RADIUS = 600;
const GROUND_REACH = 7;
const EXPOSURE = 0.98;

const GROUNDS: readonly Ground[] = ["grass", "earth", "sand", "snow", "plain"];
/** The background of false colours: a light grey that is close to none of them. */
const NEUTRAL = { sky: "studio", ground: "plain", backdrop: [232, 232, 230] } as const;

/** Sky and ground, and the colours of their light. */
export class Environment {
  readonly meshes: Mesh[];
  private readonly feet = Array.from({ length: MOST_FEET }, () => new Vector4());
  private readonly crown = new Vector4(0, 0, 1, 0);
  private readonly colours = {
    uSun: { value: new Vector3(0, 1, 0) },
    uSunColour: { value: new Vector3() },
    uSkyColour: { value: new Vector3() },
    uAmbient: { value: Array.from({ length: 9 }, () => new Vector3()) },
    uHorizonColour: { value: new Vector3() },
    uAirColour: { value: new Vector3() },
    uZenithColour: { value: new Vector3() },
    uMiddleColour: { value: new Vector3() },
    uGlowColour: { value: new Vector3() },
    uCloudColour: { value: new Vector3() },
    uSkyParts: { value: new Vector4() },
    uSunSpread: { value: 0 },
    uExposure: { value: EXPOSURE },
    uVivid: { value: 1 },
    uAir: { value: new Vector2() },
    uLandTurn: { value: 0 },
    uGroundReach: { value: GROUND_RADIUS },
    uGround: { value: 0 },
    uPaper: { value: new Vector3() },
  };
  private background: Background = DEFAULT_APPEARANCE.background;
  private neutral = false;
  private isLandKnown = false;

  constructor(materials: Materials, uniforms: Uniforms) {
    Object.assign(uniforms, this.colours);
    uniforms.uFeet = { value: this.feet };
    uniforms.uCrown = { value: this.crown };
    const sky = new Mesh(new BufferGeometry(), materials.sky);
    sky.geometry.setAttribute("position", new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
    const ground = new Mesh(new CircleGeometry(1, 64).rotateX(-Math.PI / 2), materials.ground);
    // After the tree and in this order, so that what is hidden is never shaded.
    ground.renderOrder = 1;
    sky.renderOrder = 2;
    this.meshes = [sky, ground];
    for (const mesh of this.meshes) mesh.frustumCulled = false;
    this.light();
  }

  /** Towards the light that casts shadows. */
  get towardsLight(): Vector3 {
    return this.colours.uSun.value;
  }

  setBackground(background: Background): void {
    this.background = background;
    this.light();
  }

  /** Shows a neutral background for false colours, or the sky again. */
  setNeutral(neutral: boolean): void {
    this.neutral = neutral;
    this.light();
  }

  /** Passes the places of trunks and the extent of the crown to the ground. */
  update(table: TreeTable): void {
    if (!this.isLandKnown && table.rows > 0) {
      // The tree that a page is opened with has land of its own around it, which stays as it is while more grows.
      this.colours.uLandTurn.value = (table.numberOf(0) / 1024) % 1;
      this.isLandKnown = true;
    }
    for (const foot of this.feet) foot.w = 0;
    for (const [i, { seed, radius }] of trunkFeet(table).slice(0, MOST_FEET).entries()) {
      this.feet[i]!.set(table.position[3 * seed]!, table.numberOf(seed), table.position[3 * seed + 2]!, radius);
    }
    const { min, max } = table.bounds();
    const reach = 0.5 * Math.max(max[0] - min[0], max[2] - min[2]);
    this.crown.set((min[0] + max[0]) / 2, (min[2] + max[2]) / 2, Math.max(1, reach), Math.min(1, reach / 8));
  }

  /** Scales ground and haze with the distance of the eye, so that a tall tree is as clear as a seedling. */
  reach(distance: number): void {
    const { uAir, uGroundReach } = this.colours;
    uGroundReach.value = Math.max(GROUND_RADIUS, GROUND_REACH * distance);
    const clear = Math.max(160, 1.6 * distance);
    uAir.value.set(clear, 0.18 / clear);
  }

  private light(): void {
    const background = this.neutral
      ? { ...this.background, ...NEUTRAL, backdrop: [...NEUTRAL.backdrop] as [number, number, number] }
      : this.background;
    const light = skyLight(background);
    const { colours } = this;
    colours.uSun.value.set(...light.towards).normalize();
    colours.uSunColour.value.set(...light.sun);
    colours.uSkyColour.value.set(...light.above);
    const around = background.sky === "studio" ? studioOf(light) : harmonicsOf(light);
    for (const [i, colour] of colours.uAmbient.value.entries()) colour.set(...around[i]!);
    colours.uHorizonColour.value.set(...light.horizon);
    colours.uAirColour.value.set(...light.air);
    colours.uZenithColour.value.set(...light.zenith);
    colours.uMiddleColour.value.set(...light.middle);
    colours.uGlowColour.value.set(...light.glow);
    colours.uCloudColour.value.set(...light.cloud);
    colours.uSkyParts.value.set(light.clouds, light.stars, light.hills, background.sky === "studio" ? 1 : 0);
    colours.uSunSpread.value = light.spread;
    colours.uExposure.value = EXPOSURE * light.opened;
    colours.uVivid.value = light.vivid;
    colours.uPaper.value.set(...background.backdrop).divideScalar(255);
    colours.uGround.value = GROUNDS.indexOf(background.ground);
  }

  dispose(): void {
    for (const mesh of this.meshes) mesh.geometry.dispose();
  }
}
