/** Puts what is no part of the tree, or not yet, elsewhere than its rows say; only where `GHOST` is defined. */
export const GHOST_PLACE = /* glsl */ `
#ifdef GHOST
uniform vec4 uGhostTurn;
uniform vec3 uGhostFrom;
uniform vec3 uGhostTo;
vec3 ghostPlace(vec3 place) { return turned(uGhostTurn, place - uGhostFrom) + uGhostTo; }
#endif
`;

/** Makes it pale and lets what is behind it through. */
export const GHOST_COLOUR = /* glsl */ `
#ifdef GHOST
uniform vec4 uGhostTint; // colour, and how solid it is
vec4 ghostly(vec4 colour) {
  float grey = dot(colour.rgb, vec3(0.30, 0.59, 0.11));
  vec3 pale = mix(mix(vec3(grey), colour.rgb, 0.55), uGhostTint.rgb, 0.22);
  return vec4(pale, uGhostTint.a);
}
#endif
`;
