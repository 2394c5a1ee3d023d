import { HEAD, LIGHT, NOISE } from "./common";

/** How far an endless plane is drawn, in internodes. */
export const PLANE_SHOWN = 45;

export const OBSTACLE_VERTEX = /* glsl */ `${HEAD}
in vec3 position;
in vec3 normal;
in vec3 body; // how long the sides of a box are; −1 for a frame of rods; 0 for all others
uniform mat4 modelMatrix;
flat out vec3 vBody;
out vec3 vWorld;
centroid out vec3 vPlace; // the same, but never beyond the edge of a face that is seen from its side
out vec3 vNormal;
out vec3 vOwn;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  vWorld = world.xyz;
  vPlace = world.xyz;
  vOwn = position;
  vBody = body;
  vNormal = mat3(modelMatrix) * normal;
  gl_Position = projectionMatrix * viewMatrix * world;
}
`;

/** The surface of a body in the first picture. */
const SMOOTH = /* glsl */ `
vec3 surfaced(float pixel, inout vec3 normal) { return clay(); }
`;

/**
 * Unfired clay out of doors, matt and of no colour that a plant has; in a studio dark stoneware, and frames of wood. A
 * little darker where it meets the ground; \`surface\` says what it is like close by.
 */
export const obstacleFragment = (surface = SMOOTH) => /* glsl */ `${HEAD}${NOISE}${LIGHT}
in vec3 vWorld;
centroid in vec3 vPlace;
in vec3 vNormal;
in vec3 vOwn;
flat in vec3 vBody;
uniform vec4 uSkyParts; // clouds, stars, hills, studio
out vec4 colour;
vec3 clay() {
  return vBody.x < 0.0 ? vec3(0.080, 0.043, 0.026) : mix(vec3(0.335, 0.275, 0.225), vec3(0.080, 0.066, 0.058), uSkyParts.w);
}
${surface}void main() {
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
  vec3 albedo = surfaced(pixel, normal);
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
