import { HEAD, LIGHT, NODES, NOISE } from "./common";
import { GHOST_COLOUR, GHOST_PLACE } from "./ghost";

/** Sweeps a ring along one metamer, from its parent's frame to its own. */
export const BRANCH_VERTEX = /* glsl */ `${HEAD}${NODES}${GHOST_PLACE}
in vec3 ring; // cosine, place along the metamer 0 to 1, sine
in uvec4 metamer; // row, parent's row, row where the axis begins, flags
const uint BEGINS_AXIS = 1u;
const uint FROM_SEED = 2u;
const uint TRUNK = 4u;
out vec3 vWorld;
out vec3 vNormal;
out vec3 vTangent;
out vec4 vBark; // around (cosine, sine), along, radius
out float vLight; // below 0 for what is marked

void main() {
  Node end = nodeAt(int(metamer.x));
  if (end.look == HIDDEN) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  Node start = nodeAt(int(metamer.y));
  bool begins = (metamer.w & BEGINS_AXIS) != 0u;
  float grown = eased(uTime - end.birth, end.growing);
  vec3 chord = end.position - start.position;
  float len = length(chord);
  vec3 heading = len > 1e-5 ? chord / len : vec3(0, 1, 0);

  vec3 t1 = turned(end.turn, vec3(0, 1, 0));
  vec3 t0 = turned(start.turn, vec3(0, 1, 0));
  vec3 n1 = turned(end.turn, vec3(1, 0, 0));
  vec3 n0 = turned(start.turn, vec3(1, 0, 0));
  if (begins) {
    // A lateral leaves along its bearing axis and bends away; one from the ground comes straight up.
    t0 = (metamer.w & FROM_SEED) != 0u ? normalize(heading + vec3(0, 0.6, 0)) : normalize(heading + 0.55 * t0);
    n0 = n1;
  }
  float u = ring.y;
  float u2 = u * u;
  float u3 = u2 * u;
  // Cubic Hermite curve through both nodes along their tangents.
  vec3 centre = start.position + grown * (
    (u3 - 2.0 * u2 + u) * len * t0 + (3.0 * u2 - 2.0 * u3) * chord + (u3 - u2) * len * t1);
  vec3 tangent = normalize((3.0 * u2 - 4.0 * u + 1.0) * t0 + (6.0 * u - 6.0 * u2) * heading + (3.0 * u2 - 2.0 * u) * t1);
  vec3 normal = mix(n0, n1, u);
  normal = normalize(normal - tangent * dot(tangent, normal));
  vec3 binormal = cross(normal, tangent);

  float r1 = radiusNow(end) * mix(0.25, 1.0, grown);
  float r0 = begins ? radiusNow(end) : radiusNow(start);
  float radius = mix(r0, r1, u) * smoothstep(0.0, 0.02, grown);
  float slope = (r1 - r0) / max(len, 1e-3);
  // Tubes overlap a little: where their numbers of sides differ, a joint would otherwise show gaps.
  float overlap = u == 0.0 ? 0.35 * r0 : 0.0;
  centre -= tangent * overlap;
  float along = end.arc - len * (1.0 - u) - overlap;
  if ((metamer.w & TRUNK) != 0u) {
    // Roots spread where the trunk meets the ground.
    float foot = end.radius > start.radius && begins ? end.radius : max(end.radius, start.radius);
    float flare = exp(-max(along, 0.0) / (0.85 * foot + 0.05));
    float lobes = 0.5 + 0.5 * sin(atan(ring.z, ring.x) * 5.0 + 1.3 * sin(atan(ring.z, ring.x) * 2.0));
    radius *= 1.0 + flare * (0.35 + 0.65 * lobes);
    slope -= flare * 0.55;
    if (begins) centre.y -= (1.0 - u) * (1.0 - u) * 0.5 * foot;
  } else {
    // A collar swells where a lateral leaves the axis that bears it.
    float bearing = texelFetch(uNodes, ivec2((int(metamer.z) & 255) * 3, int(metamer.z) >> 8), 0).w;
    float collar = (min(bearing, 1.8 * end.radius) - end.radius)
      * exp(-max(0.0, along - 0.5 * bearing) / (0.8 * min(bearing, 2.5 * end.radius) + 1e-3));
    radius += max(0.0, collar) * grown;
  }
  vec3 outward = normal * ring.x + binormal * ring.z;
  vec3 world = centre + outward * radius;
  vWorld = world;
  vNormal = normalize(outward - tangent * slope);
  vTangent = tangent;
  vBark = vec4(ring.x, ring.z, along, max(radius, 0.02));
  vLight = end.look == MARKED ? -1.0 : mix(start.light, end.light, u);
#ifdef GHOST
  vWorld = world = ghostPlace(world);
  vNormal = turned(uGhostTurn, vNormal);
  vTangent = turned(uGhostTurn, vTangent);
#endif
  gl_Position = projectionMatrix * viewMatrix * vec4(world, 1.0);
}
`;

/** Bark: furrowed plates on thick limbs, smooth and greenish on twigs. */
export const BRANCH_FRAGMENT = /* glsl */ `${HEAD}${NOISE}${LIGHT}${GHOST_COLOUR}
in vec3 vWorld;
in vec3 vNormal;
in vec3 vTangent;
in vec4 vBark;
in float vLight;
out vec4 colour;

#ifdef FURROWED
/** Height of the bark, 0 in a furrow to 1 on a plate. */
float bark(vec3 p) {
  float warp = (noise(p * vec3(1.1, 0.45, 1.1)) - 0.5) * 1.6;
  vec3 q = vec3(p.x + 0.25 * warp, p.y * 0.2, p.z - 0.25 * warp) * 4.6;
  float ridge = abs(noise(q) * 2.0 - 1.0);
  float finer = abs(noise(q * 2.2 + 7.1) * 2.0 - 1.0);
  float cracks = smoothstep(0.0, 0.22, abs(noise(vec3(p.x * 3.0, p.y * 2.2 + warp, p.z * 3.0) + 3.7) - 0.5));
  return smoothstep(0.02, 0.42, ridge) * 0.62 + smoothstep(0.0, 0.5, finer) * 0.23 + cracks * 0.15;
}
#endif

void main() {
  vec3 smoothed = normalize(vNormal);
  vec3 normal = smoothed;
  vec3 eye = cameraPosition - vWorld;
  float away = length(eye);
  float age = smoothstep(0.09, 0.55, vBark.w);
  vec3 albedo = mix(vec3(0.100, 0.078, 0.047), vec3(0.140, 0.108, 0.082), age);
  float cavity = 1.0;
#ifdef FURROWED
  // Young bark is finer; the pattern is laid around a cylinder, so that it has no seam.
  float scale = mix(2.6, 1.55, age);
  vec3 p = vec3(vBark.x * vBark.w, vBark.z, vBark.y * vBark.w) * scale;
  float height = bark(p);
  // Far away the furrows are finer than a pixel and would only flicker.
  float near = exp(-away * 0.010);
  const float STEP = 0.03;
  vec3 around = vec3(-vBark.y, 0.0, vBark.x);
  float aroundSlope = bark(p + around * STEP) - height;
  float alongSlope = bark(p + vec3(0.0, STEP, 0.0)) - height;
  vec3 lengthwise = normalize(vTangent);
  vec3 crosswise = normalize(cross(smoothed, lengthwise));
  float relief = mix(0.35, 1.0, age) * near * 0.15 / STEP;
  normal = normalize(smoothed + relief * (crosswise * aroundSlope - lengthwise * alongSlope));
  float tone = noise(p * vec3(0.8, 0.35, 0.8) + 11.0);
  float depth = mix(0.35, 1.0, age);
  albedo *= mix(1.0, mix(0.24, 1.2, smoothstep(0.08, 0.92, height)), depth) * (0.82 + 0.36 * tone);
  float lichen = smoothstep(0.6, 0.8, noise(p * 1.7 + 20.0)) * age * smoothstep(0.3, 0.8, height);
  albedo = mix(albedo, vec3(0.150, 0.170, 0.105), lichen * 0.5);
  cavity = mix(1.0, mix(0.5, 1.0, height), depth);
#endif
  if (vLight < 0.0) albedo = condemned(albedo);
  float exposure = mix(0.6, 1.3, abs(vLight));
  float facing = dot(normal, uSun);
  float sun = facing > 0.0 ? sunlit(vWorld, smoothed, 1.0) * smoothstep(-0.1, 0.2, dot(smoothed, uSun)) : 0.0;
  // Soil and moss climb the foot of the trunk, and the ground keeps the sky from it.
  float soil = smoothstep(0.55, 0.0, vWorld.y - 0.25 * noise(vWorld * 3.0));
  albedo = mix(albedo, vec3(0.062, 0.066, 0.026), soil * 0.8);
  float grounded = mix(0.45, 1.0, smoothstep(0.0, 1.4, vWorld.y));
  vec3 lit = albedo * (ambient(normal) * exposure * cavity * grounded + SUN_COLOUR * max(facing, 0.0) * sun);
  vec3 sight = eye / max(away, 1e-4);
  lit += SKY_COLOUR * 0.05 * pow(1.0 - max(dot(sight, normal), 0.0), 4.0) * exposure * cavity;
  colour = vec4(finished(hazed(lit, away)), 1.0);
#ifdef GHOST
  colour = ghostly(colour);
#endif
}
`;

/** Writes nothing but depth. */
export const DEPTH_FRAGMENT = /* glsl */ `precision highp float;
out vec4 colour;
void main() { colour = vec4(1.0); }
`;
