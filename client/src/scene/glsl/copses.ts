/** Trees and bushes that stand in the fields beyond the ground's disc: in woods, in hedges along fields, and alone. After \`CHANCES\`. */
export const COPSES = /* glsl */ `
uniform float uGroundReach;
/** The tallest are so much of how far away they are. */
const float COPSE_TALL = 0.027;
/** How far inside its outline a place in a picture of a tree lies; the tree is as high as the unit. */
float treeAt(vec2 at, int sort, vec3 own) {
  // A conifer, a poplar, a bush, or a broad crown of three boughs.
  if (sort == 0) return min(1.0 - at.y - abs(at.x) / mix(0.20, 0.30, own.z), 9.0 * (at.y - 0.05));
  if (sort == 1) return 1.0 - length(vec2(at.x / 0.14, (at.y - 0.52) / 0.49));
  if (sort == 2) return 1.0 - length(vec2(at.x / 0.95, (at.y - 0.30) / 0.66));
  vec2 wide = vec2(mix(0.36, 0.46, own.z), mix(0.30, 0.36, own.x));
  float thick = 1.0 - length((at - vec2(0.12 * (own.x - 0.5), 0.62)) / wide);
  thick = max(thick, 1.0 - length((at - vec2(-0.10 - 0.14 * own.y, 0.36 + 0.16 * own.z)) / (wide * vec2(0.72, 0.66))));
  return max(thick, 1.0 - length((at - vec2(0.10 + 0.14 * own.z, 0.34 + 0.20 * own.x)) / (wide * vec2(0.70, 0.72))));
}
/** One row of them, so many times as far away as the ground reaches; \`dense\` is how many of its places are taken. */
vec3 rowOfTrees(vec3 behind, vec3 sight, float times, float seed, float dense, vec3 hue, vec3 air, float haze) {
  float away = uGroundReach * times;
  float level = max(length(sight.xz), 1e-3);
  vec2 towards = sight.xz / level;
  vec2 land = landwards(sight);
  float up = sight.y / level + cameraPosition.y / away;
  float tall = COPSE_TALL / times;
  if (up < -0.12 * tall || up > 1.25 * tall) return behind;
  float places = floor(6.2831853 / (0.52 * tall));
  float place = fract(atan(sight.x, sight.z) / 6.2831853 + uLandTurn) * places;
  float wood = smoothstep(0.52, 0.66, noise(land * 4.3, seed) * 0.62 + noise(land * 11.0, seed + 3.0) * 0.38);
  vec3 colour = behind;
  // A hedge, which goes on as undergrowth where there are woods.
  float hedge = smoothstep(0.44, 0.56, noise(land * 6.1, seed + 11.0)) * (0.5 + 0.7 * noise(land * 31.0 / times, seed + 12.0));
  float rough = noise(vec2(place * 1.9, 0.0), seed + 13.0) * 0.6 + noise(vec2(place * 6.3, up / tall * 9.0), seed + 14.0) * 0.4;
  float top = tall * (0.20 * hedge * (0.35 + rough) + 0.26 * wood * (0.4 + rough));
  float low = smoothstep(0.0, -0.05 * tall, up - top) * smoothstep(-0.05, 0.0, up / tall) * step(0.012 * tall, top);
  float lifted = smoothstep(0.1, 1.0, up / max(top, 1e-5)) * (0.4 + rough);
  vec3 shady = hue * (ambient(UP) * mix(0.45, 1.0, lifted) + SUN_COLOUR * 0.55 * lifted * (0.55 - 0.45 * dot(towards, uSun.xz)));
  colour = mix(colour, mix(shady, air, haze), low);
  for (int i = -1; i <= 1; i++) {
    float cell = floor(place) + float(i);
    vec3 own = chances(vec2(mod(cell, places), seed));
    vec3 more = chances(vec2(mod(cell, places) + 0.5, seed + 7.0));
    if (own.x > mix(0.05, 1.0, wood) * dense) continue;
    // Conifers stand among themselves, and poplars are few.
    float firs = (0.10 + 0.65 * smoothstep(0.50, 0.62, noise(land * 3.1, seed + 21.0))) * wood;
    int sort = own.z < firs ? 0 : own.z < firs + 0.05 ? 1 : own.z > 0.84 ? 2 : 3;
    float size = tall * (sort == 2 ? mix(0.20, 0.36, more.x) : sort == 3 ? mix(0.50, 0.95, more.x) : mix(0.55, 1.05, more.x));
    vec2 at = vec2((place - cell - mix(0.2, 0.8, own.y)) / places * 6.2831853, up) / size;
    vec2 lump = at * (sort == 0 ? vec2(3.0, 7.0) : vec2(3.4)) + 19.0 * more.xy;
    vec4 waves = vec4(noise(lump, seed + 1.0), noise(lump * 2.7, seed + 5.0), noise(lump * 6.1, seed + 6.0), noise(lump * 14.0, seed + 8.0));
    float lumps = dot(waves, vec4(0.36, 0.30, 0.20, 0.14));
    float thick = treeAt(at, sort, more) + (sort == 3 ? 1.25 : 0.8) * (lumps - 0.54);
    float cover = smoothstep(0.0, 0.14, thick) * smoothstep(-0.03, 0.02, at.y);
    // What it stands on lies in its shade.
    float under = exp(-pow(at.x / 0.42, 2.0) - pow(at.y / 0.035, 2.0));
    colour = mix(colour, colour * 0.6, under * step(at.y, 0.03) * (1.0 - haze));
    if (sort != 2 && abs(at.x) < 0.022 && at.y > -0.01 && at.y < 0.34) colour = mix(mix(mix(hue * 0.35, air, haze), colour, 0.25), colour, cover);
    if (cover <= 0.0) continue;
    // Round as a whole, and each of its boughs again: the side to the sun is light, and what is low is dark.
    vec2 rises = vec2(noise(lump + vec2(0.12, 0.0), seed + 1.0), noise(lump + vec2(0.0, 0.12), seed + 1.0)) - waves.x;
    vec2 facing = (at - vec2(0.0, 0.5)) * vec2(1.7, 1.5) - 2.3 * rises;
    float front = sqrt(max(0.08, 1.0 - dot(facing, facing)));
    vec3 normal = normalize(vec3(towards.y, 0.0, -towards.x) * facing.x + UP * facing.y - vec3(towards.x, 0.0, towards.y) * front);
    float deep = mix(0.42, 1.0, smoothstep(0.0, 0.8, at.y)) * mix(0.35, 1.4, smoothstep(0.3, 0.72, lumps));
    vec3 own_ = hue * (sort == 0 ? vec3(0.50, 0.66, 0.95) : mix(vec3(0.74, 0.82, 0.80), vec3(1.30, 1.10, 0.95), more.z));
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
  vec3 all = rowOfTrees(behind, sight, 3.3, 61.0, 1.0, hue, air, 0.42);
  all = rowOfTrees(all, sight, 2.0, 67.0, 0.90, hue, air, 0.30);
  return rowOfTrees(all, sight, 1.12, 73.0, 0.50, hue, air, 0.17);
}
`;
