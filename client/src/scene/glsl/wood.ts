import type { WoodLook } from "./branch";
import { CHANCES } from "./chances";
import { CROWN_FIELD } from "./crown";

/** What settles on wood and dyes it as it ages: moss where it is damp and dark, lichen in patches where it is light. */
const OVERGROWN = /* glsl */ `
/** No two parts of a trunk are quite of one colour. None of it on bare paper. */
vec3 overgrown(vec3 albedo, vec3 smoothed, float radius, float light, Bark bark) {
  float wide = 0.6 + radius;
  float patches = noise(vWorld * 3.0 / wide + 11.0);
  float drift = 0.6 * noise(vWorld * 0.9 / wide + 5.0) + 0.4 * patches;
  albedo *= mix(vec3(0.84, 0.86, 0.92), vec3(1.14, 1.12, 1.04), smoothstep(0.2, 0.8, drift));
  float age = smoothstep(0.2, 1.1, radius);
  if (age <= 0.0 || uGround == 4) return albedo;
  vec3 away = vec3(-uSun.x, 0.0, -uSun.z);
  float side = 0.5 + 0.5 * dot(smoothed, away / max(length(away), 1e-3));
  float foot = exp(-max(vWorld.y, 0.0) / (1.5 * radius));
  float fine = noise(vWorld * 9.0);
  float damp = 0.45 * (1.0 - light) + 0.30 * side + 0.5 * max(0.0, smoothed.y) + 0.3 * (1.0 - bark.cavity) + 0.45 * foot;
  float moss = 0.62 * age * smoothstep(0.78, 1.12, damp + 0.6 * (patches - 0.5) + 0.3 * (fine - 0.5));
  float grown = 0.5 * noise(vWorld * 1.3 + 3.0) + 0.3 * patches + 0.2 * fine;
  float lichen = 0.42 * age * (1.0 - moss) * smoothstep(0.57, 0.63, grown) * (0.4 + 0.6 * light) * smoothstep(0.35, 0.75, bark.height);
  albedo = mix(albedo, vec3(0.070, 0.082, 0.026) * (0.7 + 0.6 * fine), moss);
  return mix(albedo, mix(vec3(0.30, 0.32, 0.26), vec3(0.33, 0.26, 0.12), step(0.64, noise(vWorld * 0.35))), lichen);
}
`;

/** What years have left on old wood: it swells here and there, and bears scars where limbs were shed. */
const GNARLED = /* glsl */ `${CHANCES}
/** How far the surface leans, and in \`albedo\` how dark it is inside a scar. */
vec3 gnarled(vec3 crosswise, vec3 upwards, vec3 smoothed, inout vec3 albedo) {
  float radius = vBark.z;
  float old = smoothstep(0.22, 0.8, radius) * (1.0 - vBearing.w);
  if (old <= 0.0) return vec3(0.0);
  vec3 lean = vec3(0.0);
  for (int i = 0; i < 2; i++) {
    float wave = (i == 0 ? 0.75 : 1.7) / (0.5 + radius);
    vec3 at = vWorld * wave + 5.0 * float(i);
    float here = noise(at);
    vec3 rises = vec3(noise(at + vec3(0.1, 0.0, 0.0)), noise(at + vec3(0.0, 0.1, 0.0)), noise(at + vec3(0.0, 0.0, 0.1))) - here;
    lean -= (i == 0 ? 1.5 : 0.8) * rises;
  }
  lean -= smoothed * dot(lean, smoothed);
  float octave = log2(radius / THINNEST);
  float thick = THINNEST * exp2(floor(octave));
  float whole_ = smoothstep(0.0, 0.12, fract(octave)) * smoothstep(1.0, 0.88, fract(octave));
  vec2 place = vec2(vBark.x * 3.0, vBark.y / (6.5 * thick));
  vec2 cell = floor(place);
  vec2 own = chances(vec2(mod(cell.x, 3.0), cell.y) + 17.0 * floor(octave)).xy;
  vec2 more = chances(vec2(mod(cell.x, 3.0), cell.y) + 91.0).xy;
  if (more.x > 0.34) return lean * old;
  float wide = mix(0.30, 0.55, more.y) * thick;
  vec2 from = (place - cell - mix(vec2(0.3), vec2(0.7), own)) * vec2(2.0944 * radius, 6.5 * thick) / (wide * vec2(1.0, 1.25));
  float far = length(from);
  if (far > 2.2) return lean * old;
  // A lip of younger wood around it, and a hollow within.
  float lip = exp(-pow((far - 0.85) / 0.42, 2.0));
  float steep = -2.0 * (far - 0.85) / 0.1764 * lip * 0.34 * whole_;
  lean -= steep * (crosswise * from.x + upwards * from.y) / max(far, 0.15);
  albedo *= mix(1.0, mix(0.34, 1.0, smoothstep(0.15, 0.75, far + 0.25 * (noise(vWorld * 5.0 / thick) - 0.5))), 0.85 * whole_ * old);
  albedo *= 1.0 + 0.12 * lip * whole_ * old;
  return lean * old;
}
`;

/** Ridges keep the sun from the furrow behind them. */
const SELF_SHADE = /* glsl */ `
float ridged(vec3 crosswise, vec3 upwards, vec3 smoothed, float height) {
  float relief = uBarkShape.x * smoothstep(0.15, 0.5, vBark.z);
  if (relief <= 0.0 || vBark.w >= 0.0 || vBearing.w > 0.5) return 1.0;
  vec2 towards = vec2(dot(uSun, crosswise), dot(uSun, upwards));
  float squares = squaresAround(clamp(log2(vBark.z / THINNEST), 0.0, 6.0));
  float side = 6.2831853 * vBark.z / squares;
  vec2 dx = dFdx(vBark.xy);
  vec2 dy = dFdy(vBark.xy);
  float rises = max(dot(uSun, smoothed), 0.05);
  float shade = 0.0;
  for (int i = 1; i <= 2; i++) {
    float step_ = 0.018 * float(i) * side;
    vec4 shares;
    vec4 other;
    vec2 to = vBark.xy + towards * step_ * vec2(1.0 / (6.2831853 * vBark.z), 1.0);
    skinAt(to, vBark.z, dx, dy, shares, other);
    // Heights are shares of a square's side.
    shade = max(shade, (other.a - height) * 0.05 * side * relief - step_ * rises);
  }
  return 1.0 - smoothstep(0.0, 0.010 * side, shade);
}
`;

/** Wood as it looks when there is time: in the shade of its crown, overgrown, furrowed by its own shadows. */
export const OLD_WOOD: WoodLook = {
  declared: `${CROWN_FIELD}${OVERGROWN}
#ifndef RIBBON
${GNARLED}
${SELF_SHADE}
#endif
`,
  covered: /* glsl */ `
  vec4 crown = crownAt(vWorld + smoothed * min(1.4 * vBark.z + 0.3, 3.0));
#ifndef RIBBON
  if (vBark.w < 0.0 && uShown.z > 0.5) {
    albedo = overgrown(albedo, smoothed, vBark.z, abs(vLight), bark);
    if (rounded) normal = normalize(normal + gnarled(crosswise, cross(crosswise, smoothed), smoothed, albedo));
  }
#endif
`,
  lit: /* glsl */ `
  float open = mix(1.0, bark.cavity, 0.6);
#ifndef RIBBON
  if (sun > 0.0 && uShadowTaps > 1 && uShown.z > 0.5) sun *= mix(0.35, 1.0, ridged(crosswise, cross(crosswise, smoothed), smoothed, bark.height));
#endif
  // Light that has come into a furrow goes from side to side in it: its ground is dark, and never black.
  float within = mix(0.34, 1.0, bark.cavity);
  // Leaves and limbs keep the sky from what they stand around, and dye what comes through.
  float sky = mix(0.33, 1.06, smoothstep(0.0, 0.85, crown.w));
  vec3 deep = mix(vec3(0.90, 1.0, 0.74), vec3(1.0), smoothstep(0.0, 0.6, crown.w));
  vec3 around = ambient(normalize(mix(smoothed, normal, 0.75))) * deep * sky * exposure;
  vec3 lit = albedo * (around * within * grounded + SUN_COLOUR * max(facing, 0.0) * sun * open);
  vec3 between = normalize(sight + uSun);
  float gloss = mix(0.10, 0.035, smoothstep(0.05, 0.6, vBark.z)) * open;
  lit += SUN_COLOUR * gloss * pow(max(dot(normal, between), 0.0), 14.0) * sun * max(facing, 0.0);
  lit += SKY_COLOUR * 0.05 * pow(1.0 - max(dot(sight, normal), 0.0), 4.0) * sky * exposure * within;
`,
};
