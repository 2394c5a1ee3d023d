import { DITHER, HEAD, LIGHT, NOISE } from "./common";
import { GROUND_SUN } from "./shadow";

/** Trunks at whose feet the ground is shaded. */
export const MOST_FEET = 24;

/** A triangle over the whole picture, as far away as can be. */
export const SKY_VERTEX = /* glsl */ `${HEAD}
in vec3 position;
uniform mat4 uWorldFromClip;
out vec3 vSight;
void main() {
  vec4 far = uWorldFromClip * vec4(position.xy, 1.0, 1.0);
  vSight = far.xyz / far.w - cameraPosition;
  gl_Position = vec4(position.xy, 1.0, 1.0);
}
`;

/** The studio's backdrop as the screen shows it: a sheet of paper that curves from the floor up to the wall. */
const PAPER = /* glsl */ `
uniform vec3 uPaper;
uniform vec4 uSkyParts; // clouds, stars, hills, studio
/** The lamp's pool of light is brightest where one looks. */
vec3 paper(vec3 sight) {
  float aside = 1.0 + dot(sight, vec3(viewMatrix[0].z, viewMatrix[1].z, viewMatrix[2].z));
  return uPaper * (1.01 - min(0.8 * aside, 0.13) - 0.06 * smoothstep(0.05, 0.9, sight.y));
}
`;

/** The ground as a whole, and how the air before it pales it. */
export const DISTANCE = /* glsl */ `
uniform vec3 uMiddleColour;
uniform int uGround;
const int GRASS = 0;
const int EARTH = 1;
const int SAND = 2;
const int SNOW = 3;
const int PLAIN = 4;
const vec3 UP = vec3(0, 1, 0);
const vec3 MEAN[4] = vec3[4](vec3(0.116, 0.130, 0.050), vec3(0.190, 0.143, 0.103), vec3(0.480, 0.380, 0.270), vec3(0.860, 0.880, 0.910));
/** Blades stand up and catch a sun that grazes the ground. */
float facingSun(vec3 normal) {
  float upright = uGround == GRASS ? 0.22 : 0.06;
  return max((dot(normal, uSun) + upright) / (1.0 + upright), 0.0);
}
/** What the ground is on the whole. */
vec3 farGround() {
  if (uGround == PLAIN) return HORIZON_COLOUR * 0.92;
  return MEAN[uGround] * (ambient(UP) + SUN_COLOUR * facingSun(UP));
}
/** Land pales by how far it is, and never beyond the hills behind it. */
vec3 inAir(vec3 land, float distance) {
  return mix(land, AIR_COLOUR, 0.42 * (1.0 - exp(-0.45 * uAir.y * distance)));
}
`;

/** The ground and nothing on it. */
const BARE = /* glsl */ `
Surface surfaceAt(vec3 world, vec3 eye, float foot, inout float open) {
  open *= underCrown(world.xz);
  return Surface(MEAN[uGround], UP);
}
`;

/** A sky and nothing before it. */
const EMPTY = /* glsl */ `
vec3 before(vec3 sky, vec3 sight) { return sky; }
vec3 landAt(float distance, vec3 sight) { return farGround(); }
vec3 standing(vec3 behind, vec3 sight) { return behind; }
`;

/** Pale at the horizon and deeper above; before it what \`scene\` has, which is loaded after the first picture. */
export const skyFragment = (scene = EMPTY) => /* glsl */ `${HEAD}${NOISE}${LIGHT}${DITHER}
uniform vec3 uZenithColour;
uniform vec3 uGlowColour;
uniform vec3 uCloudColour;
in vec3 vSight;
out vec4 colour;
${PAPER}${DISTANCE}${scene}
void main() {
  vec3 sight = normalize(vSight);
  if (uSkyParts.w > 0.5) {
    colour = vec4(dithered(paper(sight)), 1.0);
    return;
  }
  float up = max(sight.y, 0.0);
  // Away from a low sun the horizon is cooler; \`sky-harmonics.ts\` has the same.
  float aside = 0.5 - 0.5 * dot(normalize(sight.xz + 1e-5), normalize(uSun.xz + 1e-5));
  vec3 rim = mix(HORIZON_COLOUR, uMiddleColour, 0.55 * aside * (1.0 - smoothstep(0.02, 0.36, uSun.y)));
  vec3 sky = mix(rim, uMiddleColour, smoothstep(-0.02, 0.26, up));
  sky = mix(sky, uZenithColour, smoothstep(0.12, 0.9, up));
  float towards = max(dot(sight, uSun), 0.0);
  sky += uGlowColour * (0.5 * pow(towards, 5.0) + 1.2 * pow(towards, 60.0));
  sky = before(sky, sight);
  // The ground's own edge lies a little below where land without end would meet the sky.
  float distance = cameraPosition.y / max(-sight.y, 1e-4);
  vec3 land = inAir(landAt(distance, sight), distance);
  colour = vec4(dithered(finished(standing(mix(land, sky, smoothstep(-0.0024, 0.0012, sight.y)), sight))), 1.0);
}
`;

/** The ground, a disc around the trees. */
export const GROUND_VERTEX = /* glsl */ `${HEAD}
in vec3 position;
uniform float uGroundReach;
out vec3 vWorld;
void main() {
  vWorld = position * uGroundReach;
  gl_Position = projectionMatrix * viewMatrix * vec4(vWorld, 1.0);
}
`;

/** What trunks keep from the ground they stand on, and how far it is trodden there. */
export const FEET = /* glsl */ `
uniform vec4 uFeet[${MOST_FEET}]; // where trunks stand (x and z), the numbers of their trees, and how thick they are
uniform vec4 uCrown; // centre x z, radius, how dense
/** How much of the sky a crown leaves, taken as a whole. */
float underCrown(vec2 at) {
  float under = distance(at, uCrown.xy) / max(uCrown.z, 0.1);
  return 1.0 - uCrown.w * 0.55 * exp(-under * under * 1.4);
}
/** How much of the sky is seen, and how near a foot is: 1 at its rim. */
vec2 aroundFeet(vec2 at, float wander) {
  vec2 around = vec2(1.0, 0.0);
  for (int i = 0; i < ${MOST_FEET}; i++) {
    float thick = uFeet[i].w;
    if (thick <= 0.0) break;
    // Roots spread: the wood meets the ground further out.
    float from = distance(at, uFeet[i].xz) - 1.35 * thick;
    // What is near a trunk sees half of the sky at most, and next to it hardly any; limbs and roots shade further around.
    around.x *= 1.0 - 0.52 * exp(-max(0.0, from) / (thick * 1.7 + 0.15)) - 0.52 * exp(-max(0.0, from) / (thick * 0.65 + 0.06));
    around.x *= 1.0 - 0.26 * exp(-max(0.0, from) / (thick * 4.5 + 0.3));
    around.y = max(around.y, smoothstep(thick * 3.4 + 1.2, 0.0, from + wander * (thick * 2.5 + 0.6)));
  }
  return around;
}
`;

/** What trees stand on, in their shade, paling with distance; \`surface\` says what it is made of. */
export const groundFragment = (surface = BARE) => /* glsl */ `${HEAD}${NOISE}${LIGHT}${GROUND_SUN}${DITHER}
uniform float uGroundReach;
in vec3 vWorld;
out vec4 colour;
${PAPER}${DISTANCE}${FEET}
/** What light comes back from, and which way it faces. */
struct Surface {
  vec3 albedo;
  vec3 normal;
};
${surface}
void main() {
  vec3 eye = cameraPosition - vWorld;
  float away = length(eye);
  vec2 feet = aroundFeet(vWorld.xz, noise(vWorld.xz * 1.7, 12.0) - 0.5);
  float open = uShadowTaps == 0 ? 1.0 : feet.x;
  float sun = groundSun(vWorld);
  float rim = smoothstep(0.10, 0.97, length(vWorld.xz) / uGroundReach);
  bool studio = uSkyParts.w > 0.5;
  if (uGround == PLAIN) {
    if (uShadowTaps > 0) open *= underCrown(vWorld.xz);
    // Paper that goes on into the backdrop: nothing shows but what keeps light from it.
    vec3 most = SUN_COLOUR * uSun.y + SKY_COLOUR;
    vec3 lit = (SUN_COLOUR * uSun.y * sun + SKY_COLOUR * open) / max(most, 1e-3);
    if (studio) {
      colour = vec4(dithered(paper(-eye / away) * mix(pow(lit, vec3(0.6)), vec3(1.0), rim)), 1.0);
      return;
    }
    lit = mix(lit * HORIZON_COLOUR * 0.9, farGround(), rim);
    colour = vec4(dithered(finished(inAir(lit, away))), 1.0);
    return;
  }
  Surface surface = surfaceAt(vWorld, eye, feet.y, open);
  if (uShown.z < 0.5) surface = Surface(MEAN[uGround], UP);
  if (uShadowTaps == 0) open = 1.0;
  // Some light always comes from one piece of ground to another, and what is left in the shade is cool.
  open = mix(0.22, 1.0, open);
  vec3 lit = surface.albedo * (ambient(surface.normal) * open * mix(vec3(0.90, 0.97, 1.12), vec3(1.0), open) + SUN_COLOUR * facingSun(surface.normal) * sun * mix(0.30, 1.0, open));
  vec3 seen = finished(studio ? hazed(lit, away) : inAir(mix(lit, farGround(), rim), away));
  if (uShown.x < 0.5) seen = mix(unlit(surface.albedo), seen, rim);
  colour = vec4(dithered(studio ? mix(seen, paper(-eye / away), rim) : seen), 1.0);
}
`;

/** At so many places at once the brush can be shown. */
export const MOST_BRUSHES = 16;

/** The brush's outline: a shell that shows at its rim. */
export const BRUSH_VERTEX = /* glsl */ `${HEAD}
in vec3 position;
uniform vec4 uBrush[${MOST_BRUSHES}]; // centre and radius of each
out vec3 vNormal;
out vec3 vEye;
void main() {
  vec4 brush = uBrush[gl_InstanceID];
  vec3 world = brush.xyz + position * brush.w;
  vNormal = position;
  vEye = cameraPosition - world;
  gl_Position = projectionMatrix * viewMatrix * vec4(world, 1.0);
}
`;

export const BRUSH_FRAGMENT = /* glsl */ `precision highp float;
uniform float uSolid;
in vec3 vNormal;
in vec3 vEye;
out vec4 colour;
void main() {
  float rim = 1.0 - abs(dot(normalize(vNormal), normalize(vEye)));
  // A dark line inside the bright one keeps the rim visible before sky and leaves alike.
  float bright = smoothstep(0.76, 0.88, rim);
  float dark = smoothstep(0.58, 0.72, rim) * (1.0 - bright);
  vec3 tone = mix(vec3(0.16, 0.24, 0.18), vec3(1.0, 0.99, 0.94), max(bright, uSolid));
  colour = vec4(tone, mix(0.04 + 0.38 * dark + 0.85 * bright, 0.9, uSolid));
}
`;
