import { HEAD, LIGHT, NOISE } from "./common";

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

/** A clear morning: pale at the horizon, deeper above, a few thin clouds. */
export const SKY_FRAGMENT = /* glsl */ `${HEAD}${NOISE}${LIGHT}
in vec3 vSight;
out vec4 colour;
/** Colour of a range of hills where its crest is above the line of sight, else what is behind it. */
vec3 hills(vec3 behind, vec3 sight, float seed, float low, float high, vec3 hue) {
  vec2 towards = normalize(sight.xz);
  float crest = noise(towards * 2.3, seed) * 0.6 + noise(towards * 6.0, seed + 5.0) * 0.28
    + noise(towards * 17.0, seed + 9.0) * 0.12;
  float top = mix(low, high, crest);
  float inside = smoothstep(top + 0.0015, top - 0.0015, sight.y);
  // Mist gathers at the feet of the hills.
  return mix(behind, mix(HORIZON_COLOUR, hue, smoothstep(-0.01, top, sight.y) * 0.9), inside);
}

void main() {
  vec3 sight = normalize(vSight);
  float up = max(sight.y, 0.0);
  vec3 zenith = vec3(0.15, 0.34, 0.68);
  vec3 middle = vec3(0.42, 0.66, 0.92);
  vec3 sky = mix(HORIZON_COLOUR, middle, smoothstep(-0.02, 0.24, up));
  sky = mix(sky, zenith, smoothstep(0.15, 0.9, up));
  float glow = max(dot(sight, uSun), 0.0);
  sky += vec3(1.0, 0.82, 0.55) * (0.10 * pow(glow, 6.0) + 0.25 * pow(glow, 60.0));
  vec2 plane = sight.xz / (up + 0.22);
  float cloud = noise(plane * 1.2, 1.0) * 0.52 + noise(plane * 2.9, 4.0) * 0.28
    + noise(plane * 6.1, 9.0) * 0.13 + noise(plane * 13.0, 2.0) * 0.07;
  sky = mix(sky, vec3(1.45, 1.38, 1.28), smoothstep(0.46, 0.82, cloud) * smoothstep(0.02, 0.22, up) * 0.62);
  sky = hills(sky, sight, 3.0, 0.030, 0.085, vec3(0.50, 0.63, 0.70));
  sky = hills(sky, sight, 8.0, 0.006, 0.050, vec3(0.36, 0.49, 0.42));
  colour = vec4(finished(sky), 1.0);
}
`;

/** The ground, a disc around the trees. */
export const GROUND_VERTEX = /* glsl */ `${HEAD}
in vec3 position;
out vec3 vWorld;
void main() {
  vWorld = position;
  gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
}
`;

/** A meadow seen from some way off, in the tree's shade, fading into the horizon. */
export const GROUND_FRAGMENT = /* glsl */ `${HEAD}${NOISE}${LIGHT}
uniform vec4 uFeet[8]; // where trunks stand, and how thick they are
uniform vec4 uCrown; // centre x z, radius, how dense
in vec3 vWorld;
out vec4 colour;
void main() {
  vec3 eye = cameraPosition - vWorld;
  float away = length(eye);
  float near = exp(-away * 0.012);
  float patches = noise(vWorld.xz * 0.05, 0.5) * 0.55 + noise(vWorld.xz * 0.23, 3.0) * 0.45;
  float tufts = noise(vWorld.xz * vec2(1.1, 0.8), 8.0);
  float blades = noise(vWorld.xz * vec2(4.1, 2.6), 8.0) * 0.5 + noise(vWorld.zx * vec2(7.0, 11.0), 5.0) * 0.5;
  vec3 albedo = mix(vec3(0.075, 0.120, 0.030), vec3(0.150, 0.175, 0.055), patches);
  albedo *= 1.0 + near * ((blades - 0.5) * 0.7 + (tufts - 0.5) * 0.45);
  vec3 normal = normalize(vec3((blades - 0.5) * 0.3 * near, 1.0, (patches - 0.5) * 0.2));
  float open = 1.0;
  float bare = 0.0;
  for (int i = 0; i < 8; i++) {
    float thick = uFeet[i].w;
    if (thick <= 0.0) break;
    float from = distance(vWorld.xz, uFeet[i].xz);
    open *= 1.0 - 0.75 * exp(-max(0.0, from - thick * 0.8) / (thick * 1.1 + 0.12));
    bare = max(bare, exp(-from / (thick * 2.2 + 0.3)) * (0.6 + 0.6 * blades));
  }
  albedo = mix(albedo, vec3(0.135, 0.098, 0.060) * (0.7 + 0.6 * blades), clamp(bare, 0.0, 0.85));
  float under = distance(vWorld.xz, uCrown.xy) / max(uCrown.z, 0.1);
  open *= 1.0 - uCrown.w * 0.45 * exp(-under * under * 1.4);
  float sun = sunlit(vWorld, vec3(0, 1, 0), 2.6);
  vec3 lit = albedo * (ambient(normal) * open + SUN_COLOUR * max(dot(normal, uSun), 0.0) * sun * mix(0.6, 1.0, open));
  // The ground pales behind the trees, not before them, and its own edge is never seen.
  float behind = away - length(cameraPosition);
  float rim = max(smoothstep(10.0, 420.0, behind), smoothstep(350.0, 590.0, length(vWorld.xz)));
  lit = mix(hazed(lit, away), HORIZON_COLOUR, rim);
  colour = vec4(finished(lit), 1.0);
}
`;

/** The brush's outline: a shell that shows at its rim. */
export const BRUSH_VERTEX = /* glsl */ `${HEAD}
in vec3 position;
uniform vec4 uBrush; // centre and radius
out vec3 vNormal;
out vec3 vEye;
void main() {
  vec3 world = uBrush.xyz + position * uBrush.w;
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
