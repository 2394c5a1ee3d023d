import {
  CustomBlending,
  DoubleSide,
  FrontSide,
  GLSL3,
  type IUniform,
  OneFactor,
  RawShaderMaterial,
  ZeroFactor,
} from "three";
import { BRANCH_VERTEX, branchFragment } from "./glsl/branch";
import {
  BRUSH_FRAGMENT,
  BRUSH_VERTEX,
  GROUND_VERTEX,
  groundFragment,
  SKY_VERTEX,
  skyFragment,
} from "./glsl/environment";
import { LEAF_DEPTH_FRAGMENT, leafFragment, leafVertex } from "./glsl/leaf";
import { OBSTACLE_VERTEX, obstacleFragment, PLANE_SHOWN } from "./glsl/obstacle";
import { ornamentDepthFragment, ornamentFragment, ornamentVertex } from "./glsl/ornament";
import { DEPTH_FRAGMENT } from "./glsl/shadow";
import { SKELETON_FRAGMENT, SKELETON_VERTEX } from "./glsl/skeleton";

/** Uniforms by name; materials share the objects, so one assignment reaches all of them. */
export type Uniforms = Record<string, IUniform>;

export type Materials = ReturnType<typeof makeMaterials>;

/** What is thinner than a pixel covers some of its samples; the picture itself stays opaque. */
const COVERAGE = {
  alphaToCoverage: true,
  blending: CustomBlending,
  blendSrc: OneFactor,
  blendDst: ZeroFactor,
  blendSrcAlpha: ZeroFactor,
  blendDstAlpha: OneFactor,
};

/** Every material of the scene. */
export function makeMaterials(uniforms: Uniforms) {
  const shader = (vertexShader: string, fragmentShader: string, options: object = {}) =>
    new RawShaderMaterial({ glslVersion: GLSL3, uniforms, vertexShader, fragmentShader, ...options });
  const clay = (defines: object, options: object = {}) =>
    shader(OBSTACLE_VERTEX, obstacleFragment(), { defines, side: DoubleSide, ...options });
  // A plane often lies in the very ground; it then shows, and its soft edge with it.
  const over = {
    transparent: true,
    depthWrite: false,
    polygonOffset: true,
    polygonOffsetFactor: -1,
    polygonOffsetUnits: -4,
  };
  // What a picture leaves out is cut away, as finely as the screen has samples.
  const cutOut = { side: DoubleSide, ...COVERAGE };
  const caster = { side: DoubleSide, defines: { CASTER: "" } };
  const plane = { PLANE: PLANE_SHOWN.toFixed(1) };
  return {
    bark: shader(BRANCH_VERTEX, branchFragment(), { side: FrontSide }),
    twig: shader(BRANCH_VERTEX, branchFragment(), { defines: { RIBBON: "" }, side: DoubleSide, ...COVERAGE }),
    branchDepth: shader(BRANCH_VERTEX, DEPTH_FRAGMENT, { defines: { RIBBON: "", CASTER: "" }, side: DoubleSide }),
    leaf: shader(leafVertex(), leafFragment(), cutOut),
    leafDepth: shader(leafVertex(), LEAF_DEPTH_FRAGMENT, caster),
    sprig: shader(leafVertex(), leafFragment(), { ...cutOut, defines: { SPRIG: "" } }),
    sprigDepth: shader(leafVertex(), LEAF_DEPTH_FRAGMENT, { ...caster, defines: { CASTER: "", SPRIG: "" } }),
    flower: shader(ornamentVertex("Flower"), ornamentFragment("Flower"), cutOut),
    flowerDepth: shader(ornamentVertex("Flower"), ornamentDepthFragment("Flower"), caster),
    fruit: shader(ornamentVertex("Fruit"), ornamentFragment("Fruit"), cutOut),
    fruitDepth: shader(ornamentVertex("Fruit"), ornamentDepthFragment("Fruit"), caster),
    sky: shader(SKY_VERTEX, skyFragment(), { depthWrite: false }),
    ground: shader(GROUND_VERTEX, groundFragment()),
    clay: clay({}),
    clayChosen: clay({ CHOSEN: "" }),
    // Faces that look away would shine through where they end at an outline.
    clayClosed: clay({}, { side: FrontSide }),
    clayClosedChosen: clay({ CHOSEN: "" }, { side: FrontSide }),
    clayPlane: clay(plane, over),
    clayPlaneChosen: clay({ ...plane, CHOSEN: "" }, over),
    clayDepth: shader(OBSTACLE_VERTEX, DEPTH_FRAGMENT, { side: DoubleSide }),
    skeleton: shader(SKELETON_VERTEX, SKELETON_FRAGMENT, { transparent: true, side: DoubleSide }),
    brush: shader(BRUSH_VERTEX, BRUSH_FRAGMENT, { transparent: true, depthTest: false, depthWrite: false }),
  };
}
