import { CHANCES } from "./chances";
import { COPSES } from "./copses";

/** Fields and meadows of far land: how much lighter or darker, where they can still be told apart. After \`CHANCES\`. */
export const FIELDS = /* glsl */ `
vec3 fieldsAt(vec2 at, float distance) {
  // How deep a pixel is on the ground: what is smaller runs together.
  float deep = distance * distance / max(cameraPosition.y * uView.w, 1.0);
  vec2 shown = 1.0 - smoothstep(vec2(20.0, 60.0), vec2(110.0, 420.0), vec2(deep));
  float much = uGround == GRASS ? 1.0 : 0.35;
  vec3 fields = vec3(1.0) + much * (noise(at * 0.0058, 4.0) - 0.5) * shown.y * vec3(0.40, 0.26, 0.32);
  if (shown.x <= 0.0) return fields;
  // Parcels side by side in strips: meadows, hay, and what grows darker.
  vec2 place = mat2(0.80, 0.60, -0.60, 0.80) * at / vec2(250.0, 135.0);
  place += 0.5 * (vec2(noise(place * 0.6, 11.0), noise(place * 0.6, 12.0)) - 0.5);
  float strip = floor(place.y);
  vec3 own = chances(vec2(floor(place.x + 0.37 * strip) + 31.0, strip + 57.0));
  vec3 parcel = own.x < 0.24 ? vec3(1.62, 1.28, 1.20) : own.x < 0.50 ? vec3(0.60, 0.80, 0.70) : mix(vec3(0.82, 0.91, 0.86), vec3(1.24, 1.10, 1.06), own.y);
  // A pixel that is as deep as an edge is near shows both sides of it.
  vec2 edge = abs(fract(place + vec2(0.37 * strip, 0.0)) - 0.5);
  float within = smoothstep(0.5, 0.44 - min(0.3, deep / 300.0), max(edge.x, edge.y));
  return fields * mix(vec3(1.0), parcel, much * shown.x * within);
}
`;

/** Clouds, stars, hills and far trees: what a sky has before it. */
export const LANDSCAPE = /* glsl */ `${CHANCES}${FIELDS}
uniform float uCloudDrift;
uniform float uLandTurn; // by what share of a circle the land is turned
/** Where in that land one looks. */
vec2 landwards(vec3 sight) {
  float turn = 6.2831853 * uLandTurn;
  return mat2(cos(turn), sin(turn), -sin(turn), cos(turn)) * normalize(sight.xz);
}
/** Mist at the feet of what is far off, and how it is lit from one side. */
vec3 range(vec3 behind, vec3 sight, float seed, float low, float high, float rough, vec3 hue, vec3 mist, float lifted) {
  vec2 towards = landwards(sight);
  float crest = noise(towards * 2.3, seed) * 0.58 + noise(towards * 6.0, seed + 5.0) * 0.27
    + noise(towards * 17.0, seed + 9.0) * 0.10 + noise(towards * 61.0, seed + 2.0) * 0.04 * rough + noise(towards * 190.0, seed + 3.0) * 0.025 * rough;
  float top = mix(low, high, crest);
  float inside = smoothstep(top + 0.0009, top - 0.0009, sight.y);
  if (inside <= 0.0) return behind;
  float height = clamp((sight.y - low * 0.3) / max(top, 1e-3), 0.0, 1.0);
  // Woods and clearings, drawn out along the slopes; flanks that look to the sun are lighter.
  vec2 slope = vec2(towards.x * 52.0 + towards.y * 33.0, sight.y * 110.0);
  float woods = smoothstep(0.34, 0.66, noise(slope, seed + 1.0) * 0.65 + noise(slope * vec2(3.7, 3.3), seed + 6.0) * 0.35) - 0.5;
  vec2 aside = 0.02 * sign(dot(uSun.xz, vec2(-sight.z, sight.x))) * vec2(-towards.y, towards.x) * length(uSun.xz);
  float ahead = noise((towards - aside) * 6.0, seed + 5.0);
  float flank = ahead - noise(towards * 6.0, seed + 5.0);
  vec3 land = hue * (1.0 + rough * (0.24 * woods + 2.6 * flank));
  return mix(behind, mix(mist, land, mix(lifted, 1.0, smoothstep(0.0, 0.9, height))), inside);
}
/** A line of trees along the edge of a field. */
vec3 farTrees(vec3 behind, vec3 sight, vec3 hue) {
  vec2 towards = landwards(sight);
  float base = mix(-0.0015, 0.0050, noise(towards * 2.9, 21.0));
  float stands = smoothstep(0.30, 0.55, noise(towards * 5.3, 17.0)) * 0.7 + 0.3 * smoothstep(0.4, 0.55, noise(towards * 13.0, 18.0));
  float crowns = 0.35 + 0.50 * noise(towards * 95.0, 27.0) + 0.40 * noise(towards * 290.0, 28.0) + 0.25 * noise(towards * 760.0, 29.0);
  float top = base + 0.0088 * stands * crowns;
  float inside = smoothstep(0.0006, -0.0006, sight.y - top) * step(0.02, stands);
  float lit = 0.75 + 0.5 * smoothstep(base, top, sight.y) * (0.6 + 0.4 * noise(towards * 290.0, 28.0));
  return mix(behind, hue * lit, inside);
}
float star(vec3 sight, float fine, float rare) {
  vec3 cell = floor(sight * fine);
  vec3 chance = fract(sin(vec3(dot(cell, vec3(12.9898, 78.233, 37.719)), dot(cell, vec3(39.3, 11.13, 83.1)), dot(cell, vec3(73.2, 52.2, 9.15)))) * 43758.5453);
  if (chance.x < rare) return 0.0;
  vec3 within = fract(sight * fine) - 0.5 - 0.5 * (chance - 0.5);
  return smoothstep(0.20, 0.02, length(within)) * (0.25 + 0.75 * chance.y * chance.y * chance.y);
}
// Value noise shows its lattice where all octaves lie along the same axes, as stripes: so each is rotated against the one
// before, by 37° in a plane, and in space by 52° about (2, 1, 3).
const mat2 FLAT_TURN = mat2(0.7986, 0.6018, -0.6018, 0.7986);
const mat3 TURN = mat3(0.7255, 0.6867, -0.0459, -0.5769, 0.6431, 0.5036, 0.3753, -0.3389, 0.8627);
/** How thick clouds are in a plane above: heaped by a noise that warps another. */
float cloudAt(vec2 at) {
  vec2 bent = FLAT_TURN * at + 0.55 * vec2(noise(at * 1.7, 3.0), noise(at * 1.7, 6.0));
  float thick = noise(bent * 1.05, 1.0) * 0.47;
  bent = FLAT_TURN * bent;
  thick += noise(bent * 2.3, 4.0) * 0.25;
  bent = FLAT_TURN * bent;
  thick += noise(bent * 5.1, 9.0) * 0.15;
  bent = FLAT_TURN * bent;
  thick += noise(bent * 11.3, 2.0) * 0.08;
  return thick + noise(FLAT_TURN * bent * 23.0, 5.0) * 0.05;
}
/** How far below its outline a place in a picture of a heap lies; the unit is how high heaps are. An outline that is a height has no loose bits. */
float heapAt(vec2 around, float up, float tall, float seed) {
  vec3 at = TURN * vec3(around, 0.76 * up);
  float lumps = 0.56 * noise(at * 0.8 + seed);
  at = TURN * at;
  lumps += 0.34 * abs(2.0 * noise(at * 1.9 + seed) - 1.0);
  at = TURN * at;
  lumps += 0.19 * abs(2.0 * noise(at * 4.3 - seed) - 1.0);
  at = TURN * at;
  lumps += 0.09 * abs(2.0 * noise(at * 9.7 + seed) - 1.0) + 0.045 * noise(TURN * at * 22.0);
  // The higher a top, the rounder it is.
  up = max(up, 0.0);
  return tall * (1.75 * lumps - 0.06) - up * (0.80 + 0.55 * up);
}
/** Heaps of clouds that stand side by side on one level base, seen from the side. */
vec3 heaps(vec3 sky, vec3 sight, float base, float size, float seed, float share, float haze) {
  vec2 towards = normalize(sight.xz);
  vec2 around = towards / size;
  float up = (sight.y - base) / size + 0.18 * (noise(around * 0.5, seed + 2.0) - 0.5);
  if (up < -0.3 || up > 1.3) return sky;
  float stands = 0.72 * noise(around * 0.30, seed) + 0.28 * noise(around * 0.8, seed + 1.0);
  float tall = smoothstep(0.62 - 0.5 * share, 1.05 - 0.5 * share, stands);
  if (tall <= 0.0) return sky;
  float thick = heapAt(around, up, tall, seed);
  float wisps = noise(vec3(around * 3.0, up * 7.0)) * 0.6 + noise(vec3(around * 8.0, up * 15.0)) * 0.4 - 0.5;
  // Its rim is soft where the air around it is dry, and its base is mist.
  float soft = 0.10 + 0.16 * noise(around * 1.7, seed + 4.0);
  float cover = smoothstep(0.0, soft, thick + 0.10 * wisps * tall) * smoothstep(-0.12, 0.16, up + 0.22 * wisps) * smoothstep(0.0, 0.22, tall);
  if (cover <= 0.0) return sky;
  // Light comes from the sun's side and from above; what lies behind more of a cloud is darker, and its base is darkest.
  vec2 along = vec2(-towards.y, towards.x);
  vec2 toSun = normalize(vec2(dot(uSun.xz, along), 0.45 + uSun.y)) * 0.15;
  float rises = heapAt(around + along * toSun.x, up + toSun.y, tall, seed) + toSun.y - thick;
  float light = smoothstep(0.24, -0.20, rises) * mix(0.30, 1.0, smoothstep(-0.05, 0.55 * tall + 0.15, up));
  float facing = 0.5 + 0.5 * dot(normalize(uSun.xz), -towards);
  vec3 dark = mix(uCloudColour * 0.46, uMiddleColour * 0.74, 0.6);
  vec3 bright = uCloudColour * mix(1.0, 1.18, facing);
  vec3 cloud = mix(dark, bright, light);
  float near = max(dot(sight, uSun), 0.0);
  cloud += uGlowColour * (0.5 * pow(near, 6.0) + 2.0 * pow(near, 24.0) * (1.0 - smoothstep(0.0, 0.35, thick)));
  return mix(sky, mix(cloud, sky, haze), cover * 0.94);
}
vec3 before(vec3 sky, vec3 sight) {
  float up = max(sight.y, 0.0);
  float towards = max(dot(sight, uSun), 0.0);
  if (uSkyParts.y > 0.0) {
    float dark = smoothstep(0.0, 0.5, uSkyParts.y);
    vec3 band = normalize(vec3(0.35, 0.55, -0.76));
    float milky = exp(-18.0 * pow(dot(sight, band), 2.0)) * (0.35 + 0.65 * noise(sight * 6.0) * noise(sight * 15.0 + 3.0) * 2.0);
    float seen = exp(-0.2 / max(up, 0.02));
    sky += (vec3(0.9, 0.95, 1.0) * (1.3 * star(sight, 70.0, 0.988) + 0.55 * star(sight.zxy, 130.0, 0.972)) + vec3(0.020, 0.024, 0.034) * milky) * dark * seen;
  }
  if (uSkyParts.x > 0.0) {
    vec2 plane = 2.7 * sight.xz / (up + 0.24) + 5.0 * uCloudDrift;
    float shown = smoothstep(0.015, 0.16, up);
    // High and thin ones, combed by the wind: strands that part and thin out.
    vec2 combed = FLAT_TURN * plane + 0.9 * vec2(noise(plane * 0.7, 7.0), noise(plane * 0.9, 8.0));
    float thin = noise(combed * vec2(0.30, 1.3), 12.0) * 0.46 + noise(combed * vec2(0.8, 3.9), 14.0) * 0.26
      + noise(combed * vec2(2.1, 9.7), 15.0) * 0.17 + noise(combed * vec2(5.3, 23.0), 19.0) * 0.11;
    thin *= 0.40 + 0.95 * noise(plane * 0.42, 23.0);
    sky = mix(sky, uCloudColour * 0.95, 0.32 * smoothstep(0.47, 0.86, thin) * shown * smoothstep(0.0, 0.3, uSkyParts.x));
    float heaped = 1.0 - smoothstep(0.55, 0.8, uSkyParts.x);
    if (heaped > 0.0) {
      vec3 far = heaps(sky, sight, 0.062, 0.034, 43.0 + uCloudDrift, uSkyParts.x * 1.3, 0.62);
      far = heaps(far, sight, 0.092, 0.066, 47.0 + uCloudDrift, uSkyParts.x * 1.0, 0.40);
      far = heaps(far, sight, 0.150, 0.130, 53.0 + uCloudDrift, uSkyParts.x * 0.55, 0.16);
      sky = mix(sky, far, heaped);
    }
    float thick = cloudAt(plane * 0.8);
    // Heaps that are seen from below are told from those that are seen from the side.
    shown *= mix(1.0, smoothstep(0.38, 0.62, up), heaped);
    // Towards the horizon heaps stand behind each other, and one sees less of what is between them.
    float least = 0.66 - 0.34 * uSkyParts.x + 0.05 * smoothstep(0.25, 0.0, up);
    float cover = smoothstep(least, least + mix(0.11, 0.40, smoothstep(0.5, 1.0, uSkyParts.x)), thick);
    // Towards the sun a cloud thins or thickens: its rim is bright, its heart and its base are not.
    vec2 toSun = normalize(uSun.xz - sight.xz * 0.999 + 1e-4) * 0.10;
    float shade = clamp(1.6 * (cloudAt(plane * 0.8 + toSun) - thick) + 0.9 * (thick - least), 0.0, 0.6);
    vec3 lit = uCloudColour * mix(1.10 - 0.85 * shade, 0.62 + 0.75 * thick, smoothstep(0.6, 1.0, uSkyParts.x));
    vec3 rim = uGlowColour * (0.6 * pow(towards, 8.0) + 1.6 * pow(towards, 24.0) * (1.0 - cover));
    sky = mix(sky, lit + rim, cover * shown * mix(0.82, 0.70, smoothstep(0.6, 1.0, uSkyParts.x)));
  }
  if (uGround == PLAIN) return sky;
  vec3 lit = farGround();
  float snowy = uGround == SNOW ? 1.0 : 0.0;
  float bare = uGround == SAND ? 1.0 : 0.0;
  vec3 air = AIR_COLOUR + uGlowColour * 0.30 * pow(towards, 4.0);
  vec3 leafy = mix(mix(vec3(0.038, 0.062, 0.022), lit, bare), vec3(0.16, 0.17, 0.19), snowy);
  if (bare < 0.5) leafy *= ambient(UP) * 1.1 + SUN_COLOUR * 0.45 * max(uSun.y, 0.15);
  if (uSkyParts.z > 0.0) {
    vec3 far = mix(mix(leafy, lit, 0.25), air, 0.74);
    vec3 near = mix(mix(leafy, lit, 0.35), air, 0.42);
    sky = mix(sky, range(sky, sight, 3.0, 0.024, 0.088, 0.5, far, mix(air, HORIZON_COLOUR, 0.18), 0.55), uSkyParts.z);
    sky = mix(sky, range(sky, sight, 8.0, 0.006, 0.052, 1.0, near, air, 0.5), uSkyParts.z);
  }
  // No land is level to the end: swells in the distance break its edge.
  vec3 swell = mix(lit, air, 0.40);
  sky = range(sky, sight, 13.0, -0.002, 0.0135, 0.7, swell, mix(lit, air, 0.46), 0.3);
  if (bare < 0.5) sky = farTrees(sky, sight, mix(leafy, air, 0.46));
  return range(sky, sight, 31.0, -0.006, 0.0055, 0.5, mix(lit, air, 0.30), mix(lit, air, 0.34), 0.3);
}
vec3 landAt(float distance, vec3 sight) {
  if (uGround == PLAIN) return farGround();
  return farGround() * fieldsAt(cameraPosition.xz + sight.xz * distance, distance);
}
${COPSES}`;
