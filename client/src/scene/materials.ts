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
import { OBSTACLE_FRAGMENT, OBSTACLE_VERTEX } from "./glsl/obstacle";
import { PLANE_SHOWN } from "./obstacle-meshes";

/** Uniforms by name; materials share the objects, so one assignment reaches all of them. */
export type Uniforms = Record<string, IUniform>;

export type Materials = ReturnType<typeof makeMaterials>;

/** Every material of the scene. */
export function makeMaterials(uniforms: Uniforms) {
  const shader = (vertexShader: string, fragmentShader: string, options: object = {}) =>
    new RawShaderMaterial({ glslVersion: GLSL3, uniforms, vertexShader, fragmentShader, ...options });
  const clay = (defines: object, options: object = {}) =>
    shader(OBSTACLE_VERTEX, OBSTACLE_FRAGMENT, { defines, side: DoubleSide, ...options });
  // A plane often lies in the very ground; it then shows, and its soft edge with it.
  const over = {
    transparent: true,
    depthWrite: false,
    polygonOffset: true,
    polygonOffsetFactor: -1,
    polygonOffsetUnits: -4,
  };
  const plane = { PLANE: PLANE_SHOWN.toFixed(1) };
  return {
    bark: shader(BRANCH_VERTEX, BRANCH_FRAGMENT, { defines: { FURROWED: "" }, side: FrontSide }),
    twig: shader(BRANCH_VERTEX, BRANCH_FRAGMENT, { side: FrontSide }),
    branchDepth: shader(BRANCH_VERTEX, DEPTH_FRAGMENT, { side: DoubleSide, colorWrite: false }),
    leaf: shader(LEAF_VERTEX, LEAF_FRAGMENT, { side: DoubleSide }),
    leafDepth: shader(LEAF_VERTEX, DEPTH_FRAGMENT, { side: DoubleSide, colorWrite: false }),
    sky: shader(SKY_VERTEX, SKY_FRAGMENT, { depthWrite: false }),
    ground: shader(GROUND_VERTEX, GROUND_FRAGMENT),
    clay: clay({}),
    clayChosen: clay({ CHOSEN: "" }),
    clayPlane: clay(plane, over),
    clayPlaneChosen: clay({ ...plane, CHOSEN: "" }, over),
    clayDepth: shader(OBSTACLE_VERTEX, DEPTH_FRAGMENT, { side: DoubleSide, colorWrite: false }),
    brush: shader(BRUSH_VERTEX, BRUSH_FRAGMENT, { transparent: true, depthTest: false, depthWrite: false }),
  };
}
