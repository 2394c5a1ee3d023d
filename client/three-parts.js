// Parts of three.js that a scene without lights, fog, backgrounds, headsets, clipping planes, compressed textures, textures of
// six sides and materials of three.js's own does not use, each with the methods that the renderer calls all the same. `three-plugin.ts` puts them in place.
import {
  DepthFormat,
  FloatType,
  HalfFloatType,
  RedFormat,
  RGBAFormat,
  RGBAIntegerFormat,
  UnsignedByteType,
  UnsignedIntType,
} from "three/src/constants.js";
import { Color } from "three/src/math/Color.js";

export const ShaderChunk = {};
export const ShaderLib = {};
export const getDFGLUT = () => null;

/** Clears to opaque black, or to nothing where the canvas is transparent. */
export function WebGLBackground(_renderer, _environments, state, _objects, alpha, premultipliedAlpha) {
  const black = new Color(0x000000);
  const clearAlpha = alpha === true ? 0 : 1;
  return {
    getClearColor: () => black,
    getClearAlpha: () => clearAlpha,
    render: () => state.buffers.color.setClear(0, 0, 0, clearAlpha, premultipliedAlpha),
    addToRenderList() {},
    dispose() {},
  };
}

/** What a sampler of six sides or of layers would have until it gets its own. */
export const CubeTexture = Object;
export const CubeDepthTexture = Object;

/** The view of several cameras at once. */
export const FrustumArray = Object;

/** What a mesh would have that is made without a material. */
export const MeshBasicMaterial = Object;

export function WebGLClipping() {
  return { uniform: { value: null }, numPlanes: 0, numIntersection: 0, init: () => false };
}

export function WebGLEnvironments() {
  return { get: () => null, dispose() {} };
}

export function WebGLLights() {
  const state = { version: 0, numSpotLightShadowsWithMaps: 0, numLightProbes: 0 };
  for (const kind of ["sun", "directional", "point", "spot", "rectArea", "hemi", "spotLightMap"]) {
    state[kind] = [];
  }
  for (const kind of ["sun", "directional", "point", "spot"]) {
    state[`${kind}ShadowMap`] = [];
  }
  return { state, setup() {}, setupView() {} };
}

export function WebGLMaterials() {
  return {
    refreshFogUniforms() {},
    refreshMaterialUniforms(_uniforms, material) {
      material.uniformsNeedUpdate = false;
    },
  };
}

export function WebGLMorphtargets() {
  return { update() {} };
}

export function WebGLOutput() {
  throw new Error("The renderer draws to the canvas in 8 bits a channel only.");
}

export function WebGLShadowMap() {
  return { enabled: false, autoUpdate: false, needsUpdate: false, render() {} };
}

export function WebGLUniformsGroups() {
  return { bind() {}, update() {}, dispose() {} };
}

/** WebGL's names of the formats and types of textures that are used here: three.js knows many compressed ones besides. */
export function WebGLUtils(gl) {
  const names = {
    [UnsignedByteType]: "UNSIGNED_BYTE",
    [UnsignedIntType]: "UNSIGNED_INT",
    [FloatType]: "FLOAT",
    [HalfFloatType]: "HALF_FLOAT",
    [RGBAFormat]: "RGBA",
    [DepthFormat]: "DEPTH_COMPONENT",
    [RedFormat]: "RED",
    [RGBAIntegerFormat]: "RGBA_INTEGER",
  };
  return {
    convert(format) {
      const name = names[format];
      if (name === undefined) throw new Error(`three-parts.js has no textures of the format or type ${format}.`);
      return gl[name];
    },
  };
}

export function WebXRManager() {
  return {
    enabled: false,
    isPresenting: false,
    addEventListener() {},
    removeEventListener() {},
    setAnimationLoop() {},
    dispose() {},
  };
}
