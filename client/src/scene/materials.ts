import { DoubleSide, FrontSide, GLSL3, type IUniform, RawShaderMaterial } from "three";
import { BRANCH_FRAGMENT, BRANCH_VERTEX, DEPTH_FRAGMENT } from "./glsl/branch";
import {
  BRUSH_FRAGMENT,
  BRUSH_VERTEX,
  GROUND_FRAGMENT,
  GROUND_VERTEX,
  SKY_FRAGMENT,
  SKY_VERTEX,
} from "./glsl/environment";
import { LEAF_FRAGMENT, LEAF_VERTEX } from "./glsl/leaf";

/** Uniforms by name; materials share the objects, so one assignment reaches all of them. */
export type Uniforms = Record<string, IUniform>;

export type Materials = ReturnType<typeof makeMaterials>;

/** Every material of the scene. */
export function makeMaterials(uniforms: Uniforms) {
  const shader = (vertexShader: string, fragmentShader: string, options: object = {}) =>
    new RawShaderMaterial({ glslVersion: GLSL3, uniforms, vertexShader, fragmentShader, ...options });
  return {
    bark: shader(BRANCH_VERTEX, BRANCH_FRAGMENT, { defines: { FURROWED: "" }, side: FrontSide }),
    twig: shader(BRANCH_VERTEX, BRANCH_FRAGMENT, { side: FrontSide }),
    branchDepth: shader(BRANCH_VERTEX, DEPTH_FRAGMENT, { side: DoubleSide, colorWrite: false }),
    leaf: shader(LEAF_VERTEX, LEAF_FRAGMENT, { side: DoubleSide }),
    leafDepth: shader(LEAF_VERTEX, DEPTH_FRAGMENT, { side: DoubleSide, colorWrite: false }),
    sky: shader(SKY_VERTEX, SKY_FRAGMENT, { depthWrite: false }),
    ground: shader(GROUND_VERTEX, GROUND_FRAGMENT),
    brush: shader(BRUSH_VERTEX, BRUSH_FRAGMENT, { transparent: true, depthTest: false, depthWrite: false }),
  };
}
