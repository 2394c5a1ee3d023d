import { DITHER, HEAD, LIGHT, NOISE } from "./common";
import { GROUND_SUN } from "./shadow";

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
vec3 paper(float up) { return uPaper * (1.0 - 0.10 * smoothstep(0.05, 0.9, up)); }
`;

/** The ground as a whole, and land too far off for more than its colour to be seen. */
const DISTANCE = /* glsl */ `
uniform vec3 uMiddleColour;
uniform int uGround;
const int GRASS = 0;
const int EARTH = 1;
const int SAND = 2;
const int SNOW = 3;
const int PLAIN = 4;
const vec3 MEAN[4] = vec3[4](vec3(0.092, 0.108, 0.045), vec3(0.190, 0.143, 0.103), vec3(0.480, 0.380, 0.270), vec3(0.860, 0.880, 0.910));
/** Blades stand up and catch a sun that grazes the ground. */
float facingSun(vec3 normal) {
  float upright = uGround == GRASS ? 0.22 : 0.06;
  return max((dot(normal, uSun) + upright) / (1.0 + upright), 0.0);
}
/** The ground where it meets the sky: what it is on the whole, and the air before it. */
vec3 farGround() {
  if (uGround == PLAIN) return HORIZON_COLOUR * 0.92;
  const vec3 UP = vec3(0, 1, 0);
  vec3 lit = MEAN[uGround] * (ambient(UP) + SUN_COLOUR * facingSun(UP));
  return mix(lit, HORIZON_COLOUR * 0.8, 0.16);
}
/** Land fades into haze towards the horizon, so that the horizon is soft and no sharp line. */
vec3 inHaze(vec3 land, float elevation) {
  return mix(land, HORIZON_COLOUR * 0.92, 0.5 * smoothstep(-0.035, 0.002, elevation));
}
vec3 farLand() { return mix(uMiddleColour, HORIZON_COLOUR, 0.35) * 0.84; }
vec3 nearLand() { return mix(farLand(), farGround(), 0.55) * 0.86; }
`;

/** Pale at the horizon, deeper above; clouds, hills and stars as the sky has them. */
export const SKY_FRAGMENT = /* glsl */ `${HEAD}${NOISE}${LIGHT}${DITHER}
uniform vec3 uZenithColour;
uniform vec3 uGlowColour;
uniform vec3 uCloudColour;
in vec3 vSight;
out vec4 colour;
${PAPER}${DISTANCE}
/** Colour of a range of hills where its crest is above the line of sight, else what is behind it. */
vec3 hills(vec3 behind, vec3 sight, float seed, float low, float high, vec3 hue) {
  vec2 towards = normalize(sight.xz);
  float crest = noise(towards * 2.3, seed) * 0.6 + noise(towards * 6.0, seed + 5.0) * 0.28
    + noise(towards * 17.0, seed + 9.0) * 0.12;
  float top = mix(low, high, crest);
  float inside = smoothstep(top + 0.0015, top - 0.0015, sight.y);
  // A little mist gathers at the feet of the hills.
  return mix(behind, mix(mix(hue, HORIZON_COLOUR, 0.06), hue, smoothstep(-0.01, 0.7 * top, sight.y)), inside);
}
float star(vec3 sight) {
  vec3 cell = floor(sight * 90.0);
  vec3 within = fract(sight * 90.0) - 0.5;
  float chance = fract(sin(dot(cell, vec3(12.9898, 78.233, 37.719))) * 43758.5453);
  return chance > 0.985 ? smoothstep(0.22, 0.0, length(within)) * fract(chance * 913.0) : 0.0;
}

void main() {
  vec3 sight = normalize(vSight);
  float up = max(sight.y, 0.0);
  vec3 sky = mix(HORIZON_COLOUR, uMiddleColour, smoothstep(-0.02, 0.26, up));
  sky = mix(sky, uZenithColour, smoothstep(0.12, 0.9, up));
  if (uSkyParts.w > 0.5) {
    colour = vec4(dithered(paper(sight.y)), 1.0);
    return;
  }
  float towards = max(dot(sight, uSun), 0.0);
  sky += uGlowColour * (0.5 * pow(towards, 5.0) + 1.2 * pow(towards, 60.0));
  if (uSkyParts.y > 0.0) sky += star(sight) * uSkyParts.y * smoothstep(0.02, 0.2, up);
  if (uSkyParts.x > 0.0) {
    vec2 plane = sight.xz / (up + 0.22);
    float cloud = noise(plane * 1.2, 1.0) * 0.52 + noise(plane * 2.9, 4.0) * 0.28
      + noise(plane * 6.1, 9.0) * 0.13 + noise(plane * 13.0, 2.0) * 0.07;
    float cover = smoothstep(0.62 - 0.45 * uSkyParts.x, 1.02 - 0.42 * uSkyParts.x, cloud);
    vec3 lit = uCloudColour * mix(1.0, 0.55 + 0.9 * cloud, smoothstep(0.6, 1.0, uSkyParts.x));
    sky = mix(sky, lit + uGlowColour * 0.6 * pow(towards, 8.0), cover * smoothstep(0.02, 0.22, up) * 0.7);
  }
  // The ground's own edge lies a little below where land without end would meet the sky.
  vec3 land = inHaze(farGround(), sight.y);
  if (uSkyParts.z > 0.0) {
    sky = mix(sky, hills(sky, sight, 3.0, 0.030, 0.085, farLand()), uSkyParts.z);
    sky = mix(sky, hills(sky, sight, 8.0, 0.006, 0.050, nearLand()), uSkyParts.z);
  }
  // No land is level to the end: swells in the distance break its edge.
  vec3 swell = inHaze(farGround(), 0.0);
  if (uGround != PLAIN) sky = hills(sky, sight, 13.0, -0.004, 0.010, mix(swell, HORIZON_COLOUR, 0.25));
  sky = mix(land, sky, smoothstep(-0.0024, 0.0012, sight.y));
  colour = vec4(dithered(finished(sky)), 1.0);
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

/** What trees stand on, in their shade, fading into the horizon. */
export const GROUND_FRAGMENT = /* glsl */ `${HEAD}${NOISE}${LIGHT}${GROUND_SUN}${DITHER}
uniform vec4 uFeet[8]; // where trunks stand, and how thick they are
uniform vec4 uCrown; // centre x z, radius, how dense
uniform float uGroundReach;
in vec3 vWorld;
out vec4 colour;
${PAPER}${DISTANCE}
/** What light comes back from, and which way it faces. */
struct Surface {
  vec3 albedo;
  vec3 normal;
};
/** How high grass stands, about one half; what is smaller than the picture can show is left out. */
float sward(vec2 at, float blurred) {
  vec4 wave = vec4(0.55, 1.3, 2.9, 6.1);
  vec4 shown = 1.0 - smoothstep(vec4(0.25), vec4(0.75), wave * blurred);
  vec4 parts = vec4(noise(at * wave.x, 8.0), noise(at.yx * wave.y, 5.0), noise(at * wave.z, 15.0), noise(at.yx * wave.w, 6.0));
  return 0.5 + dot(vec4(0.22, 0.34, 0.34, 0.30) * shown, parts - 0.5);
}
Surface surfaceAt(vec2 at, float near, float blurred, float bare) {
  float broad = noise(at * 0.021, 11.0) * 0.6 + noise(at * 0.057, 0.5) * 0.4;
  float patches = noise(at * 0.09, 2.0) * 0.45 + noise(at.yx * 0.21 + 3.7, 3.0) * 0.3 + noise(at * 0.47, 13.0) * 0.25;
  float fine = noise(at * vec2(4.1, 2.6), 8.0) * 0.5 + noise(at.yx * vec2(7.0, 11.0), 5.0) * 0.5;
  vec3 soil = vec3(0.128, 0.094, 0.066) * (0.72 + 0.56 * fine);
  if (uGround == EARTH) {
    float clods = noise(at * 1.3, 6.0) * 0.6 + noise(at * 2.9, 7.0) * 0.4;
    vec3 albedo = mix(vec3(0.150, 0.108, 0.076), vec3(0.235, 0.178, 0.130), broad * 0.6 + patches * 0.4);
    albedo *= 1.0 + near * ((clods - 0.5) * 0.35 + (fine - 0.5) * 0.4);
    return Surface(albedo, normalize(vec3((clods - 0.5) * 0.5 * near, 1.0, (fine - 0.5) * 0.4 * near)));
  }
  if (uGround == SAND) {
    float bend = noise(at * 0.07, 4.0) * 9.0;
    float ripple = sin(at.x * 1.9 + at.y * 0.8 + bend + 1.5 * noise(at * 0.45, 9.0));
    vec3 albedo = mix(vec3(0.430, 0.330, 0.225), vec3(0.530, 0.430, 0.310), broad * 0.5 + patches * 0.5);
    albedo *= 1.0 + near * ((fine - 0.5) * 0.14 + ripple * 0.035);
    return Surface(albedo, normalize(vec3(ripple * 0.10 * near, 1.0, (broad - 0.5) * 0.25)));
  }
  if (uGround == SNOW) {
    float drift = noise(at * 0.16, 4.0) + 0.5 * noise(at * 0.42, 9.0);
    vec3 albedo = vec3(0.88, 0.90, 0.93) * (0.95 + 0.05 * fine * near);
    return Surface(albedo, normalize(vec3((drift - 0.75) * 0.10, 1.0, (broad - 0.5) * 0.14)));
  }
  vec3 albedo = mix(vec3(0.066, 0.086, 0.034), vec3(0.104, 0.118, 0.050), smoothstep(0.2, 0.8, broad));
  // Here and there it is dry.
  albedo = mix(albedo, vec3(0.150, 0.138, 0.072), 0.5 * smoothstep(0.35, 0.95, patches));
  float height = sward(at, blurred);
  // A tuft is bright where it looks to the sun, and stands in the shade of the next.
  vec2 towards = uSun.xz / max(length(uSun.xz), 1e-3);
  float shaded = sward(at + 0.28 * towards, blurred) - height;
  float grazed = 1.0 - 0.6 * uSun.y;
  albedo *= max(0.25, 1.0 + 1.5 * (height - 0.5) - 1.3 * grazed * shaded);
  albedo = mix(albedo, vec3(0.128, 0.132, 0.052), 0.35 * smoothstep(0.55, 0.8, height));
  albedo = mix(albedo, soil, bare * (1.0 - 0.55 * smoothstep(0.4, 0.62, height)));
  return Surface(albedo, vec3(0, 1, 0));
}
void main() {
  vec3 eye = cameraPosition - vWorld;
  float away = length(eye);
  float near = exp(-away * 0.010);
  // How wide a pixel is on the ground: less than it is deep, for grass stands up.
  vec2 wide = vec2(length(dFdx(vWorld.xz)), length(dFdy(vWorld.xz)));
  float blurred = mix(min(wide.x, wide.y), max(wide.x, wide.y), 0.25);
  float open = 1.0;
  float bare = 0.0;
  for (int i = 0; i < 8; i++) {
    float thick = uFeet[i].w;
    if (thick <= 0.0) break;
    float from = distance(vWorld.xz, uFeet[i].xz);
    // What is near a trunk sees half of the sky at most.
    open *= 1.0 - 0.7 * exp(-max(0.0, from - thick) / (thick * 1.3 + 0.12));
    bare = max(bare, smoothstep(thick * 4.5 + 1.2, thick, from + (noise(vWorld.xz * 1.7, 12.0) - 0.5) * (thick * 2.5 + 0.6)));
  }
  float under = distance(vWorld.xz, uCrown.xy) / max(uCrown.z, 0.1);
  open *= 1.0 - uCrown.w * 0.42 * exp(-under * under * 1.4);
  float sun = groundSun(vWorld);
  Surface surface = surfaceAt(vWorld.xz, near, blurred, 0.8 * bare);
  float rim = smoothstep(0.10, 0.97, length(vWorld.xz) / uGroundReach);
  bool studio = uSkyParts.w > 0.5;
  vec3 lit;
  if (uGround == PLAIN) {
    // Paper that goes on into the backdrop: nothing shows but what keeps light from it.
    vec3 most = SUN_COLOUR * uSun.y + SKY_COLOUR;
    lit = (SUN_COLOUR * uSun.y * sun + SKY_COLOUR * open) / max(most, 1e-3);
    if (studio) {
      colour = vec4(dithered(paper(0.0) * mix(pow(lit, vec3(0.6)), vec3(1.0), rim)), 1.0);
      return;
    }
    lit *= HORIZON_COLOUR * 0.9;
  } else {
    lit = surface.albedo * (ambient(surface.normal) * open + SUN_COLOUR * facingSun(surface.normal) * sun * mix(0.7, 1.0, open));
  }
  // The ground pales behind the trees, not before them, and its own edge is never seen.
  vec3 seen = finished(studio ? hazed(lit, away) : inHaze(mix(lit, farGround(), rim), -eye.y / away));
  colour = vec4(dithered(studio ? mix(seen, paper(0.0), rim) : seen), 1.0);
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
