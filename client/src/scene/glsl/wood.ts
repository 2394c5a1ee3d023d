import { MOST_SLOPE } from "../painting/measures";
import type { WoodLook } from "./branch";
import { CHANCES } from "./chances";
import { CROWN_FIELD } from "./crown";

/** What years in the weather do to the colour of bark, and what settles on it: moss where it is damp and dark, lichen where it is light. */
const OVERGROWN = /* glsl */ `
vec3 overgrown(vec3 albedo, vec3 smoothed, float radius, float light, Bark bark) {
  // No two parts of a trunk are quite of one colour.
  float wide = 0.6 + radius;
  float patches = noise(vWorld * 3.0 / wide + 11.0);
  float fine = noise(vWorld * 9.0);
  float drift = 0.5 * noise(vWorld * 0.9 / wide + 5.0) + 0.35 * patches + 0.15 * fine;
  albedo *= mix(vec3(0.74, 0.77, 0.82), vec3(1.20, 1.16, 1.05), smoothstep(0.25, 0.75, drift));
  float age = smoothstep(0.12, 0.9, radius);
  if (age <= 0.0) return albedo;
  // The weather bleaches ridges; furrows keep their colour.
  float grey = dot(albedo, vec3(0.35, 0.45, 0.20));
  float bleached = (0.2 + 0.35 * smoothstep(0.3, 0.8, bark.height)) * smoothstep(0.25, 0.6, noise(vWorld * 1.7 / wide + 31.0) + 0.15 * patches);
  albedo = mix(albedo, vec3(1.06, 1.04, 0.98) * grey, smoothstep(0.05, 0.5, radius) * bleached);
  // Rain runs down where it always has, and leaves dark stains.
  float runs = noise(vWorld * vec3(6.0, 0.5, 6.0) / wide + 23.0) + 0.35 * (noise(vWorld * vec3(13.0, 1.1, 13.0) / wide + 41.0) - 0.5);
  albedo *= mix(1.0, mix(0.70, 1.0, smoothstep(0.20, 0.44, runs)), age);
  // Paper is dry: nothing grows from it.
  float wild = uGround == 4 ? 0.4 : 1.0;
  vec3 away = vec3(-uSun.x, 0.0, -uSun.z);
  float side = 0.5 + 0.5 * dot(smoothed, away / max(length(away), 1e-3));
  float foot = exp(-max(vWorld.y, 0.0) / (1.5 * radius));
  float damp = 0.45 * (1.0 - light) + 0.30 * side + 0.5 * max(0.0, smoothed.y) + 0.3 * (1.0 - bark.cavity) + 0.45 * foot;
  float moss = 0.62 * wild * age * smoothstep(0.78, 1.12, damp + 0.6 * (patches - 0.5) + 0.3 * (fine - 0.5));
  float grown = 0.5 * noise(vWorld * 1.3 + 3.0) + 0.3 * patches + 0.2 * fine;
  float lichen = 0.42 * wild * age * (1.0 - moss) * smoothstep(0.57, 0.63, grown) * (0.4 + 0.6 * light) * smoothstep(0.35, 0.75, bark.height);
  // A bloom of algae greens the side away from the sun, thickest near the ground.
  float algae = 0.5 * wild * age * side * side * exp(-max(vWorld.y, 0.0) / (5.0 * radius)) * smoothstep(0.3, 0.7, patches + 0.2 * fine);
  albedo = mix(albedo, albedo * vec3(0.80, 0.98, 0.50), algae);
  albedo = mix(albedo, vec3(0.070, 0.082, 0.026) * (0.7 + 0.6 * fine), moss);
  return mix(albedo, mix(vec3(0.30, 0.32, 0.26), vec3(0.33, 0.26, 0.12), step(0.64, noise(vWorld * 0.35))), lichen);
}
`;

/** Bark is rough at every size: its own pattern once more, finer, on what it has. */
const FINE_BARK = /* glsl */ `
void roughened(inout Bark bark, inout vec3 albedo) {
  float octave = clamp(log2(vBark.z / THINNEST), 0.0, 6.0) + 0.5;
  // The finer pattern is changed where an octave begins, and fades away before.
  float much = smoothstep(0.0, 0.15, fract(octave)) * smoothstep(1.0, 0.85, fract(octave)) * smoothstep(0.15, 0.5, vBark.z) * (1.0 - vBearing.w);
  float squares = squaresAround(floor(octave) - 0.5);
  vec2 scale = 3.0 * vec2(squares, squares / (6.2831853 * THINNEST * exp2(floor(octave))));
  vec2 at = vBark.xy * scale;
  vec4 relief = textureGrad(uBarkRelief, at, dFdx(vBark.xy) * scale, dFdy(vBark.xy) * scale);
  albedo *= mix(1.0, mix(0.72, 1.14, relief.a) * mix(0.8, 1.0, relief.b), much);
  bark.slope += 0.45 * much * uBarkShape.x * (relief.rg * 2.0 - 1.0) * ${MOST_SLOPE.toFixed(1)};
}
/** Where a limb comes out of another one, bark is pushed together into a dark, wrinkled ridge. */
float pleated(vec3 smoothed) {
  float nook = vBark.y > 0.0 ? smoothstep(0.25, 0.7, vBearing.w) * smoothstep(1.0, 0.85, vBearing.w) : 0.0;
  if (nook <= 0.0) return 0.0;
  float wrinkles = noise(vec3(vBearing.w * 9.0, vWorld.xz * 3.0 / vBark.z + vWorld.y));
  return nook * mix(0.4, 1.0, wrinkles) * (0.6 + 0.4 * smoothed.y);
}
`;

/** What years have left on old wood: it swells here and there, and bears scars where limbs were shed. */
const GNARLED = /* glsl */ `${CHANCES}
/** How far the surface leans, and in \`albedo\` how dark it is inside a scar. */
vec3 gnarled(vec3 crosswise, vec3 upwards, vec3 smoothed, inout vec3 albedo) {
  float radius = vBark.z;
  float old = smoothstep(0.12, 0.6, radius) * (1.0 - vBearing.w);
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
  vec2 more = chances(vec2(mod(cell.x, 3.0), cell.y) + 37.0).xy;
  if (more.x > 0.2) return lean * old;
  float wide = mix(0.24, 0.5, more.y) * thick;
  vec2 from = (place - cell - mix(vec2(0.3), vec2(0.7), own)) * vec2(2.0944 * radius, 6.5 * thick) / (wide * vec2(1.35, 0.9));
  float far = length(from);
  if (far > 2.2) return lean * old;
  // A lip of younger wood around it, and a hollow within.
  float ragged = 0.5 * (noise(vWorld * 4.0 / thick) - 0.5);
  far += ragged;
  float lip = exp(-pow((far - 0.85) / 0.42, 2.0));
  float steep = -2.0 * (far - 0.85) / 0.1764 * lip * 0.24 * whole_;
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
${FINE_BARK}
#endif
`,
  covered: /* glsl */ `
  vec4 crown = crownAt(vWorld + smoothed * min(1.4 * vBark.z + 0.3, 3.0));
  // Twigs are of this year and the last: darker and greener than bark, the more so among leaves.
  float twig = 1.0 - smoothstep(0.04, 0.35, vBark.z);
  float pale = dot(albedo, vec3(0.35, 0.45, 0.20));
  albedo = mix(albedo, mix(albedo, vec3(1.0, 1.0, 0.72) * pale, 0.5) * mix(0.5, 0.86, crown.w), twig);
  float nook = 0.0;
#ifndef RIBBON
  if (vBark.w < 0.0 && uShown.z > 0.5) {
    nook = pleated(smoothed);
    roughened(bark, albedo);
    if (rounded) normal = normalize(smoothed - crosswise * bark.slope.x - cross(crosswise, smoothed) * bark.slope.y);
    albedo *= 1.0 - 0.45 * nook;
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
  float sky = mix(0.42, 1.1, smoothstep(0.0, 0.85, crown.w));
  vec3 deep = mix(vec3(0.90, 1.0, 0.74), vec3(1.0), smoothstep(0.0, 0.6, crown.w));
  // What bears a limb stands close to its lower side, and in a fork there is wood all around.
  float under = mix(1.0, 0.68, smoothstep(0.25, -0.85, smoothed.y) * smoothstep(0.1, 0.5, vBark.z)) * (1.0 - 0.5 * nook);
  vec3 around = ambient(normalize(mix(smoothed, normal, 0.75))) * deep * sky * under * exposure;
  vec3 lit = albedo * (around * within * grounded + SUN_COLOUR * max(facing, 0.0) * sun * open);
  vec3 between = normalize(sight + uSun);
  float gloss = mix(0.06, 0.035, smoothstep(0.05, 0.6, vBark.z)) * open;
  lit += SUN_COLOUR * gloss * pow(max(dot(normal, between), 0.0), 14.0) * sun * max(facing, 0.0);
  lit += SKY_COLOUR * 0.05 * pow(1.0 - max(dot(sight, normal), 0.0), 4.0) * sky * exposure * within;
`,
};
