/** Three random numbers of each cell of a plane, from 0 to 1. */
export const CHANCES = /* glsl */ `
vec3 chances(vec2 cell) {
  vec3 p = fract(vec3(cell.xyx) * vec3(0.1031, 0.1030, 0.0973));
  p += dot(p, p.yxz + 33.33);
  return fract((p.xxy + p.yzz) * p.zyx);
}
`;
