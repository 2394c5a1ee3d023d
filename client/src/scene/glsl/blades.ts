import { HEAD, LIGHT, NOISE } from "./common";
import { CROWN_FIELD } from "./crown";
import { DISTANCE, FEET } from "./environment";
import { GRASS_COLOUR } from "./ground";
import { itemsOf } from "./items";
import { GROUND_SUN } from "./shadow";

/** Blades of a tuft of grass. */
export const TUFT_BLADES = 5;

/** Tufts of grass: each blade is a strip that bends over. */
export const BLADE_VERTEX = /* glsl */ `${HEAD}${itemsOf("sampler2D", 1)}${NOISE}${LIGHT}${GROUND_SUN}
${DISTANCE}${FEET}${CROWN_FIELD}${GRASS_COLOUR}
/** What grows on earth, sand and snow is dry. */
const vec3 DRY[5] = vec3[5](vec3(0), vec3(0.150, 0.140, 0.062), vec3(0.300, 0.235, 0.115), vec3(0.105, 0.084, 0.060), vec3(0));
uniform vec4 uLeafSeason; // size, presence, fresh, turned
in vec3 blade; // which one of its tuft, side −1 to 1, along 0 to 1
out vec3 vColour;
void main() {
  int number = itemNumber();
  vec4 tuft = number < uItemsDrawn[0] ? texelFetch(uItems, itemPlace(number), 0) : vec4(0.0);
  // Place, a random number, how tall and wide it is for its distance.
  if (tuft.w <= 0.0) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  vec4 own = fract((tuft.z + 0.137 * blade.x) * vec4(57.31, 131.7, 313.3, 709.9) + blade.x * 0.618);
  vec2 clump = vec2(noise(tuft.xy * 0.55, 31.0), noise(tuft.xy * 0.33, 37.0));
  vec2 at = tuft.xy + 0.8 * (own.xy - 0.5);
  vec2 feet = aroundFeet(at, noise(at * 1.7, 12.0) - 0.5);
  // Around a trunk the ground is trodden, but against it tufts stand that nothing reaches, and they are taller.
  float hem = smoothstep(0.66, 0.94, feet.y) * smoothstep(0.22, 0.46, clump.x + 0.3 * (own.x - 0.5));
  float grows = tuft.w * mix(1.0 - smoothstep(0.35, 0.95, feet.y), 1.0, hem);
  vec4 crown = crownAt(vec3(at.x, max(0.4, uCrownFrom.y + 2.6), at.y));
  vec2 within = abs(2.0 * (at - uCrownFrom.xz) / uCrownSize.xz - 1.0);
  float shelter = (1.0 - crown.w) * smoothstep(1.0, 0.45, max(max(within.x, within.y), 0.8 * length(within)));
  // In the shade of a crown it is short and thin, and where leaves have fallen they lie over it.
  grows *= 1.0 - (1.0 - hem) * smoothstep(0.15, 0.75, shelter) * mix(0.35, 0.88, uLeafSeason.w) * (0.7 + 0.6 * own.z);
  grows = max(grows, 0.0);
  // In drifts it was never mown: there it is taller, and some of its stalks bear seeds.
  float unmown = uGround == GRASS ? unmownAt(at) : DRY_UNMOWN;
  float stalk = blade.x < 0.5 ? step(0.62, own.w) * unmown : 0.0;
  float tall = grassTall(max(unmown, 0.62 * hem)) * (0.55 + 0.90 * own.z) * (0.35 + 1.35 * smoothstep(0.25, 0.85, clump.x)) * grows;
  tall = mix(tall, max(1.25 * tall, grassTall(1.0) * (0.94 + 0.38 * own.x)) * min(grows * 1.2, 1.0), stalk);
  float turn = 6.2832 * own.w;
  vec2 lean = 0.55 * vec2(cos(turn), sin(turn)) + 0.7 * (vec2(clump.y, noise(tuft.xy * 0.33, 41.0)) - 0.5);
  float t = blade.z;
  float away = distance(cameraPosition, vec3(at.x, 0.0, at.y));
  // Never thinner than most of a pixel.
  float half_ = max(0.019 * (0.6 + 0.8 * own.x), 0.45 * away / max(uView.w, 1.0)) * (1.0 - 0.92 * t) * step(1e-3, grows);
  vec3 bend = vec3(lean.x, 0.0, lean.y) * tall * t * t;
  vec3 world = vec3(at.x, -0.02, at.y) + vec3(0.0, tall * (t - 0.22 * t * t * length(lean)), 0.0) + bend;
  vec3 eye = normalize(cameraPosition - world);
  vec3 side = normalize(cross(eye, vec3(0.0, 1.0, 0.0)) + 0.6 * vec3(cos(turn * 3.0), 0.0, sin(turn * 3.0)) * 0.5);
  world += side * blade.y * half_;
  vec3 normal = normalize(mix(cross(side, normalize(vec3(lean.x * t, 1.0, lean.y * t))), UP, 0.7) + 0.35 * blade.y * side);
  float open = mix(0.20, 1.0, feet.x) * (1.0 - 0.58 * shelter);
  open = mix(open, 1.0, 0.3 * t);
  // Where blades are about as thin as pixels they run together, as they do in the ground behind them.
  float apart = 1.0 - 0.65 * smoothstep(0.015, 0.07, away / max(uView.w, 1.0));
  float sun = groundSun(vec3(at.x, 0.0, at.y));
  vec3 albedo = (uGround == GRASS ? grassAt(at, cameraPosition.y / max(away, 1e-3)) : DRY[uGround]) * (1.0 + apart * 0.56 * (own.y - 0.5)) * mix(1.0, mix(0.52, 1.58, t), apart);
  albedo = mix(albedo, (uGround == GRASS ? vec3(0.205, 0.175, 0.088) : DRY[uGround]) * mix(0.7, 1.35, t), max(stalk * 0.55, 0.12 * unmown * t));
  if (uGround == GRASS) albedo = mix(albedo, vec3(0.19, 0.165, 0.085), 0.22 * t * smoothstep(0.55, 0.95, own.w * 0.5 + clump.y * 0.6));
  // What shines through a blade that stands against the sun is yellower than what it reflects.
  float against = pow(max(0.0, -dot(eye, uSun)), 3.0);
  vec3 lit = albedo * (ambient(normal) * open * mix(0.95, 1.2, t) + SUN_COLOUR * mix(facingSun(UP), facingSun(normal), 0.45) * sun * mix(0.38, 1.0, open));
  lit += albedo * vec3(1.25, 1.4, 0.5) * SUN_COLOUR * (0.10 + 0.6 * against) * t * sun * smoothstep(0.02, 0.3, uSun.y + 0.15);
  float far = length(cameraPosition - world);
  vColour = finished(inAir(lit, far));
  gl_Position = projectionMatrix * viewMatrix * vec4(world, 1.0);
}
`;

export const BLADE_FRAGMENT = /* glsl */ `precision highp float;
in vec3 vColour;
out vec4 colour;
void main() { colour = vec4(vColour, 1.0); }
`;
