import { DRAW_MODES } from "../mode/draw-mode";
import { RAMP_COLOURS } from "../mode/ramps";

const WIREFRAME = DRAW_MODES.indexOf("wireframe");

/** For vertex shaders: the number that the draw mode shows of a row; see `trait-texture.ts`. */
export const TRAITS = /* glsl */ `
uniform sampler2D uTraits;
uniform int uMode;
float traitOf(int row) { return uMode > ${WIREFRAME} ? texelFetch(uTraits, ivec2(row & 255, row >> 8), 0).r : 0.0; }
`;

/** For fragment shaders: the last word on a colour; after \`LIGHT\`. */
export const MODES = /* glsl */ `
/** Where the very triangle looks, on the side of the eye. */
vec3 facet(vec3 world, vec3 sight) {
  vec3 face = cross(dFdx(world), dFdy(world));
  face = dot(face, face) > 0.0 ? normalize(face) : sight;
  return dot(face, sight) < 0.0 ? -face : face;
}
uniform int uMode;
uniform vec2 uTraitEnds; // numbers with the first and the last colour
uniform vec3 uRamp[${RAMP_COLOURS}]; // as the screen shows them
vec3 onRamp(float trait) {
  float at = clamp((trait - uTraitEnds.x) / (uTraitEnds.y - uTraitEnds.x), 0.0, 1.0) * ${RAMP_COLOURS - 1}.0;
  int below = min(int(at), ${RAMP_COLOURS - 2});
  return mix(uRamp[below], uRamp[below + 1], at - float(below));
}
/** A finished colour, or what the draw mode has in its place; \`facing\` is how far the surface looks at the eye. */
vec3 shownAs(vec3 lit, vec3 albedo, float trait, float facing) {
  if (uMode == 0 && uShown.x > 0.5) return lit;
  if (uMode <= ${WIREFRAME}) return unlit(albedo);
  // Shaded just enough to tell form from form: a colour must still be found in the legend.
  return onRamp(trait) * mix(1.0, mix(0.72, 1.0, clamp(facing, 0.0, 1.0)), uShown.x);
}
`;
