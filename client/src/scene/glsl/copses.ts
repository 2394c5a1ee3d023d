import { CHANCES } from "./chances";

/** Trees and bushes that stand in the fields beyond the ground's disc: in copses, in rows along fields, and alone. */
export const COPSES = /* glsl */ `${CHANCES}
uniform float uGroundReach;
/** The tallest are so much of how far away they are. */
const float COPSE_TALL = 0.034;
/** One row of them, so many times as far away as the ground reaches; \`dense\` is how many of its places are taken. */
vec3 rowOfTrees(vec3 behind, vec3 sight, float times, float seed, float dense, vec3 hue, vec3 air, float haze) {
  float away = uGroundReach * times;
  float level = max(length(sight.xz), 1e-3);
  vec2 towards = sight.xz / level;
  float up = sight.y / level + cameraPosition.y / away;
  float tall = COPSE_TALL / times;
  if (up < -0.12 * tall || up > 1.25 * tall) return behind;
  float places = floor(6.2831853 / (0.52 * tall));
  float place = (atan(sight.x, sight.z) / 6.2831853 + 0.5) * places;
  vec3 colour = behind;
  for (int i = -1; i <= 1; i++) {
    float cell = floor(place) + float(i);
    vec3 own = chances(vec2(mod(cell, places), seed));
    vec3 more = chances(vec2(mod(cell, places) + 0.5, seed + 7.0));
    float copse = smoothstep(0.46, 0.66, noise(towards * 5.0, seed) * 0.65 + noise(towards * 13.0, seed + 3.0) * 0.35);
    if (own.x > mix(0.10, 1.0, copse) * dense) continue;
    // Bushes stand between trees, and some trees are slender.
    float size = tall * (own.z < 0.4 ? mix(0.16, 0.30, more.x) : mix(0.55, 1.1, more.x * more.x));
    bool bush = own.z < 0.4;
    vec2 wide = bush ? vec2(0.95, 0.62) : more.y < 0.14 ? vec2(0.15, 0.49) : vec2(mix(0.34, 0.50, more.z), 0.42);
    vec2 middle = vec2(0.0, bush ? 0.42 : more.y < 0.14 ? 0.51 : 0.55);
    vec2 at = vec2((place - cell - mix(0.2, 0.8, own.y)) / places * 6.2831853, up) / size;
    vec2 across = (at - middle) / wide;
    vec2 lump = at * 3.1 + 19.0 * more.xy;
    float lumps = noise(lump, seed + 1.0) * 0.42 + noise(lump * 2.7, seed + 5.0) * 0.30 + noise(lump * 7.3, seed + 6.0) * 0.16 + noise(lump * 17.0, seed + 8.0) * 0.12;
    float thick = 1.0 - length(across) + 1.25 * (lumps - 0.55);
    float cover = smoothstep(0.0, 0.07, thick);
    // What it stands on lies in its shade.
    float under = exp(-pow(at.x / (0.9 * wide.x), 2.0) - pow(at.y / 0.035, 2.0));
    colour = mix(colour, colour * 0.45, under * step(at.y, 0.03));
    if (!bush && abs(at.x) < 0.026 && at.y > -0.01 && at.y < 0.3) colour = mix(mix(hue * 0.35, air, haze), colour, cover * 0.5);
    if (cover <= 0.0) continue;
    // Round as a whole, and each of its clumps again: the side to the sun is light, and what is low is dark.
    vec2 rises = vec2(noise(lump + vec2(0.12, 0.0), seed + 1.0), noise(lump + vec2(0.0, 0.12), seed + 1.0)) - noise(lump, seed + 1.0);
    vec2 facing = across - 2.3 * rises;
    float front = sqrt(max(0.08, 1.0 - dot(facing, facing)));
    vec3 normal = normalize(vec3(towards.y, 0.0, -towards.x) * facing.x + UP * facing.y - vec3(towards.x, 0.0, towards.y) * front);
    float deep = mix(0.42, 1.0, smoothstep(-0.9, 0.7, across.y)) * mix(0.35, 1.5, smoothstep(0.3, 0.72, lumps));
    vec3 own_ = hue * mix(vec3(0.72, 0.80, 0.80), vec3(1.45, 1.16, 0.95), more.z);
    vec3 lit = own_ * (ambient(normal) * deep + SUN_COLOUR * max(dot(normal, uSun) * 0.9 + 0.1, 0.0) * mix(0.35, 1.0, deep));
    colour = mix(colour, mix(lit, air, haze), cover);
  }
  return colour;
}
/** What stands in the fields before all that lies further off. */
vec3 standing(vec3 behind, vec3 sight) {
  if (uGround == PLAIN || uGround == SAND) return behind;
  vec3 air = AIR_COLOUR + uGlowColour * 0.30 * pow(max(dot(sight, uSun), 0.0), 4.0);
  vec3 hue = uGround == SNOW ? vec3(0.090, 0.088, 0.086) : vec3(0.052, 0.074, 0.022);
  vec3 all = rowOfTrees(behind, sight, 3.1, 61.0, 0.95, hue, air, 0.42);
  all = rowOfTrees(all, sight, 1.9, 67.0, 0.75, hue, air, 0.27);
  return rowOfTrees(all, sight, 1.08, 73.0, 0.46, hue, air, 0.13);
}
`;
