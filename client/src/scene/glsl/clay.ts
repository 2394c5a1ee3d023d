import { CHANCES } from "./chances";
import { MOST_FEET } from "./environment";

/** What bodies are made of, close by: clay that hands have spread; out of doors moss, soil and gravel lie on it, and rain has run down it. */
export const CLAY = /* glsl */ `${CHANCES}
/** Turns a place out of the axes of boxes, or the lattice of noise would show on their faces. */
const mat3 ASKEW = mat3(0.670, 0.470, -0.575, -0.662, 0.735, -0.170, 0.336, 0.489, 0.800);
/** How high the clay stands, in internodes: marks of the user that spread it, and its grain. Details finer than a pixel are left out. */
float relief(vec3 at, float pixel) {
  vec4 wave = vec4(0.9, 2.7, 6.7, 16.0);
  vec4 shown = 1.0 - smoothstep(vec4(0.2), vec4(0.6), wave * pixel);
  at = ASKEW * at;
  vec4 parts = vec4(noise(at * wave.x + 3.0), noise(at * wave.y + 9.0), noise(at * wave.z + 5.0), noise(at * wave.w));
  return dot(vec4(0.13, 0.065, 0.05, 0.022) * shown, parts - 0.5);
}
/** The normal of a surface that rises by so much over its pixels, after M. Mikkelsen. */
vec3 raised(vec3 normal, vec3 place, float height) {
  vec3 right = dFdx(place);
  vec3 up = dFdy(place);
  vec3 across = cross(up, normal);
  float area = dot(right, across);
  vec3 slope = sign(area) * (dFdx(height) * across + dFdy(height) * cross(normal, right));
  return normalize(max(abs(area), 1e-9) * normal - slope);
}
uniform vec4 uFeet[${MOST_FEET}]; // where trunks stand (x and z), the numbers of their trees, and how thick they are
/** How much earth lies on what looks up: all around a trunk that stands there, and out of doors in patches. */
float earthOn(vec3 place, vec3 normal, float patches) {
  float level = smoothstep(0.86, 0.97, normal.y);
  if (level <= 0.0) return 0.0;
  float foot = 0.0;
  for (int i = 0; i < ${MOST_FEET}; i++) {
    if (uFeet[i].w <= 0.0) break;
    foot = max(foot, smoothstep(11.0, 8.0, distance(place.xz, uFeet[i].xz) / (uFeet[i].w + 0.4) + 7.0 * (patches - 0.5)));
  }
  float outside = (1.0 - uSkyParts.w) * smoothstep(0.6, 2.5, place.y) * smoothstep(0.42, 0.60, patches);
  return level * max(foot, outside);
}
/** Moss in cushions, and soil between them. */
vec3 overgrown(vec3 place, float pixel) {
  float cushions = noise(place * 1.9 + 4.0) * 0.6 + noise(place * 5.3) * 0.4;
  float fine = (noise(place * 17.0) - 0.5) * (1.0 - smoothstep(0.02, 0.07, pixel));
  vec3 moss = mix(vec3(0.055, 0.078, 0.022), vec3(0.125, 0.150, 0.040), smoothstep(0.35, 0.75, cushions + 0.3 * fine));
  vec3 soil = vec3(0.088, 0.064, 0.045) * (1.0 + 0.8 * fine);
  return mix(soil, moss, smoothstep(0.36, 0.48, cushions + 0.2 * fine));
}
/** Stones of a path, pressed into the ground: their colour, how high they stand, and what lies between them. */
vec4 gravel(vec3 place, float pixel) {
  vec4 all = vec4(vec3(0.215, 0.172, 0.130), 0.0);
  vec2 worn = vec2(noise(place * 0.16 + 3.0), noise(place * 0.55));
  vec2 grain = (vec2(noise(place * 2.3), noise(place * 8.0)) - 0.5) * (1.0 - smoothstep(vec2(0.12, 0.03), vec2(0.4, 0.12), vec2(pixel)));
  all.rgb *= 0.78 + 0.5 * worn.x + 0.25 * (worn.y - 0.5) + 0.30 * grain.x + 0.35 * grain.y;
  for (int size = 0; size < 3; size++) {
    float side = size == 0 ? 0.62 : size == 1 ? 0.27 : 0.12;
    float shown = 1.0 - smoothstep(0.25, 0.8, pixel / side);
    if (shown <= 0.0) continue;
    vec2 at = place.xz / side + 17.0 * float(size);
    vec2 cell = floor(at);
    for (int i = 0; i < 9; i++) {
      vec2 other = cell + vec2(float(i % 3) - 1.0, float(i / 3) - 1.0);
      vec3 own = chances(other);
      if (own.z > (size == 0 ? 0.06 : size == 1 ? 0.35 : 0.75) + 0.35 * (worn.y - 0.5)) continue;
      vec2 from = at - other - 0.2 - 0.6 * own.xy;
      float turn = 40.0 * own.z;
      from = vec2(from.x * cos(turn) + from.y * sin(turn), from.y * cos(turn) - from.x * sin(turn)) * vec2(1.0, 1.25 + own.x);
      float far = dot(from, from) / (0.05 + 0.10 * own.y);
      if (far >= 1.0) continue;
      float high = (1.0 - far * far) * side * 0.045 * shown;
      if (high < all.a) continue;
      all = vec4(mix(all.rgb, mix(vec3(0.185, 0.160, 0.132), vec3(0.290, 0.245, 0.195), own.x) * (0.8 + 0.4 * own.y), 0.75 * shown), high);
    }
  }
  return all;
}
/** Planed wood, its grain along the length of a rod, which is upright or level. */
vec3 timber(float pixel) {
  vec3 along = vec3(vOwn.xz * 6.0, vOwn.y * 0.35).xzy;
  float grain = noise(along) * 0.6 + noise(along * vec3(3.1, 2.0, 3.1) + 7.0) * 0.4;
  return clay() * mix(1.0, 0.55 + 0.9 * grain, 1.0 - smoothstep(0.08, 0.3, pixel));
}
/** How far a place on a path is from its edges, which wander: what is below 0 is overgrown. */
float fromEdge(vec2 at) {
  vec2 in_ = 0.5 * vBody.xz - abs(vOwn.xz);
  float wander = noise(at * 0.13, 5.0) * 1.3 + noise(at * 0.6, 6.0) * 0.9 + noise(at * 2.3, 7.0) * 0.6 + noise(at * 6.7, 8.0) * 0.3;
  return min(in_.x, in_.y) - wander + 0.35;
}
vec3 surfaced(float pixel, inout vec3 normal) {
  if (uShown.z < 0.5) return clay();
  if (vBody.x < 0.0) return timber(pixel);
  float outside = 1.0 - uSkyParts.w;
  float path = outside * smoothstep(0.9, 0.97, normal.y) * smoothstep(0.9, 0.5, vPlace.y);
  float edge_ = 10.0;
  if (outside > 0.5 && vBody.y > 0.0 && vBody.y < 0.9 && vPlace.y < 0.5) {
    edge_ = fromEdge(vPlace.xz);
    if (edge_ < 0.0) discard;
  }
  float wall = vBody.x > 0.0 ? 1.0 : 0.0;
  // Stoneware is smoother than what hands have spread.
  float height = relief(vOwn, pixel) * mix(0.30, mix(1.0, 0.7, wall), outside);
  float stain = noise(vOwn * 0.13 + 2.0) * 0.6 + noise(vOwn * 0.35) * 0.4;
  // What lies low is darker: dust and wet stay there.
  vec3 albedo = clay() * (0.84 + 0.32 * stain) * clamp(1.0 + 1.7 * height, 0.7, 1.25);
  float steep = outside * smoothstep(0.6, 0.2, abs(normal.y));
  if (steep > 0.0) {
    // It lies in layers, harder and softer ones in turn: they wave, and the soft ones are worn back.
    float level = vPlace.y * 0.55 + 1.1 * noise(vPlace * 0.11) + 0.25 * noise(vPlace * 0.6);
    float layer = noise(vec3(level, 0.3 * noise(vPlace * 0.05), 3.0)) * 0.6 + noise(vec3(level * 3.7, 1.0, 7.0)) * 0.4;
    float edge = 1.0 - smoothstep(0.10, 0.45, 0.55 * pixel * 3.7);
    height += mix(0.22, 0.05, wall) * steep * (layer - 0.5) * edge;
    albedo *= mix(vec3(1.0), mix(vec3(0.74, 0.70, 0.68), vec3(1.16, 1.12, 1.06), layer), steep * mix(1.0, 0.35, wall));
    // Rain leaves streaks, and algae where it stays; lichen grows in rounds.
    vec3 run = vec3(vPlace.xz * 1.1, vPlace.y * 0.07).xzy;
    float streak = smoothstep(0.46, 0.72, noise(run) * 0.62 + noise(run * 2.7 + 5.0) * 0.38);
    albedo *= 1.0 - mix(0.30, 0.16, wall) * steep * streak;
    float low = smoothstep(3.2, 0.0, vPlace.y + 2.4 * (stain - 0.5));
    albedo = mix(albedo, vec3(0.115, 0.120, 0.062), 0.62 * steep * low * smoothstep(0.3, 0.65, noise(vPlace * 1.3)));
    // A wall is damp where it stands in the ground.
    albedo *= mix(1.0, mix(0.62, 1.0, smoothstep(0.0, 3.6, vPlace.y + 3.0 * (stain - 0.5))), wall);
    float round_ = noise(vPlace * 0.9 + 7.0) * 0.6 + noise(vPlace * 2.9) * 0.4;
    albedo = mix(albedo, mix(vec3(0.42, 0.42, 0.36), vec3(0.40, 0.31, 0.13), step(0.6, stain)), mix(0.4, 0.14, wall) * steep * smoothstep(0.60, 0.66, round_));
  }
  albedo = mix(albedo, overgrown(vPlace, pixel), earthOn(vPlace, normal, stain) * (1.0 - path));
  if (path > 0.0) {
    vec4 stones = gravel(vPlace, pixel);
    // Its middle is worn pale by feet, its edges are earth in which grass takes root.
    float verge = smoothstep(3.2, 0.2, edge_ + 1.6 * (stain - 0.5));
    stones.rgb *= mix(1.10, 0.66, verge) * mix(vec3(1.0), vec3(0.92, 1.0, 0.80), verge);
    albedo = mix(albedo, stones.rgb, path);
    height = mix(height, stones.a, path);
  }
  normal = raised(normal, vWorld, height);
  return albedo;
}
`;
