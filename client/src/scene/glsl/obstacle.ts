import { HEAD, LIGHT, NOISE } from "./common";
import { MOST_FEET } from "./environment";

/** How far an endless plane is drawn, in internodes. */
export const PLANE_SHOWN = 45;

export const OBSTACLE_VERTEX = /* glsl */ `${HEAD}
in vec3 position;
in vec3 normal;
uniform mat4 modelMatrix;
out vec3 vWorld;
centroid out vec3 vPlace; // the same, but never beyond the edge of a face that is seen from its side
out vec3 vNormal;
out vec3 vOwn;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  vWorld = world.xyz;
  vPlace = world.xyz;
  vOwn = position;
  vNormal = mat3(modelMatrix) * normal;
  gl_Position = projectionMatrix * viewMatrix * world;
}
`;

/** Unfired clay: matt, of no colour that a plant has, and a little darker where it meets the ground; moss and soil lie on it. */
export const OBSTACLE_FRAGMENT = /* glsl */ `${HEAD}${NOISE}${LIGHT}
in vec3 vWorld;
centroid in vec3 vPlace;
in vec3 vNormal;
in vec3 vOwn;
out vec4 colour;
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
uniform vec4 uSkyParts; // clouds, stars, hills, studio
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
void main() {
  vec3 toEye = cameraPosition - vPlace;
  float away = length(toEye);
  vec3 face = cross(dFdx(vWorld), dFdy(vWorld));
  face = length(face) > 0.0 ? normalize(face) : vec3(0, 1, 0);
  face *= sign(dot(face, toEye));
  vec3 normal = length(vNormal) > 1e-4 ? normalize(vNormal) : face;
  normal *= dot(normal, face) < 0.0 ? -1.0 : 1.0;
  // Corner normals that are averaged over an edge say nothing of either side.
  normal = normalize(mix(face, normal, uShown.y * smoothstep(0.80, 0.90, dot(face, normal))));
  float pixel = 0.5 * (length(dFdx(vWorld)) + length(dFdy(vWorld)));
  float height = uShown.z > 0.5 ? relief(vOwn, pixel) : 0.0;
  normal = raised(normal, vWorld, height);
  float stain = uShown.z > 0.5 ? noise(vOwn * 0.13 + 2.0) * 0.6 + noise(vOwn * 0.35) * 0.4 : 0.5;
  // What lies low is darker: dust and wet stay there.
  vec3 albedo = vec3(0.335, 0.275, 0.225) * (0.84 + 0.32 * stain) * clamp(1.0 + 1.7 * height, 0.7, 1.25);
  if (uShown.z > 0.5) albedo = mix(albedo, overgrown(vPlace, pixel), earthOn(vPlace, face, stain));
#ifdef PLANE
  float rim = length(vOwn.xz) / PLANE;
  float opacity = 1.0 - smoothstep(0.3, 1.0, rim);
#else
  float opacity = 1.0;
#endif
#ifdef CHOSEN
  vec3 sight = toEye / max(away, 1e-3);
  albedo = mix(albedo, vec3(0.62, 0.36, 0.24), 0.5);
  float edge = pow(1.0 - abs(dot(normal, sight)), 2.5);
#else
  float edge = 0.0;
#endif
  float open = mix(0.62, 1.0, smoothstep(0.0, 2.5, vWorld.y));
  float facing = dot(normal, uSun);
  // What the sun only grazes is as good as in the shade, and its shadows would be all edge.
  float sun = facing > 0.0 ? sunlit(vPlace, face, 1.4) * smoothstep(0.0, 0.1, dot(face, uSun)) : 0.0;
  vec3 lit = albedo * ((0.72 * ambient(normal) + 0.28 * ambient(vec3(0.0, 1.0, 0.0))) * open + SUN_COLOUR * max(facing, 0.0) * sun);
  lit += edge * vec3(0.9, 0.3, 0.16);
  colour = vec4(uShown.x > 0.5 ? finished(hazed(lit, away)) : unlit(albedo), opacity);
}
`;
