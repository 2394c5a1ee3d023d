import { NOISE } from "./common";
import type { Crown } from "./leaf";

/** The crown as a cloud (\`crown-field.ts\`). */
export const CROWN_FIELD = /* glsl */ `
uniform sampler3D uCrownField;
uniform vec3 uCrownFrom;
uniform vec3 uCrownSize;
/** The way out of it, as long as it is sure; how open to the sky. */
vec4 crownAt(vec3 place) {
  vec4 field = textureLod(uCrownField, (place - uCrownFrom) / uCrownSize, 0.0);
  return vec4((field.xyz * 255.0 - 127.5) / 127.5, field.w);
}
`;

/** What a leaf knows of its crown, read in the middle of the blade: sprigs and leaves agree. */
export const IN_CROWN: Crown = {
  declared: /* glsl */ `${CROWN_FIELD}
out vec4 vCrown;
`,
  read: /* glsl */ `
  vCrown = crownAt(place.base + 0.5 * size * place.direction);
`,
};

/**
 * Light on something thin in a crown. Which of its sides the sun is on is told by the crown, which of them is seen by the
 * eye: so the crown is round, and leaves that are seen from below glow.
 */
export const CROWN_LIGHT = /* glsl */ `${NOISE}
in vec4 vCrown;
uniform vec3 uCrownSize;
uniform float uLeafRough;
uniform float uLeafSize;
vec3 thinLit(vec3 albedo, vec3 normal, vec3 sight, vec3 world, float sheer, float gloss, float exposure, float open) {
  // Parts of a crown as large as a bough are lighter or darker than others, and warmer or cooler.
  vec3 bough = world * (7.0 / max(uCrownSize.x, 4.0));
  float drift = smoothstep(0.25, 0.75, noise(bough) * 0.6 + noise(bough * 2.3 + 5.0) * 0.4);
  albedo *= mix(vec3(0.76, 0.84, 0.92), vec3(1.16, 1.11, 0.98), drift);
  float sure = min(1.0, length(vCrown.xyz));
  vec3 out_ = vCrown.xyz / max(sure, 1e-3);
  vec3 upper = dot(normal, out_) < 0.0 ? -normal : normal;
  vec3 soft = normalize(mix(upper, out_, 0.6 * sure));
  float facing = dot(normal, uSun);
  // Some sun always finds its way through a crown, from leaf to leaf.
  float sun = mix(0.05 + 0.07 * vCrown.w, 1.0, sunAt(world + uSun * (0.12 + uShadowSize), 1.4));
  float taken = mix(abs(facing), max(0.0, (dot(soft, uSun) + 0.2) / 1.2), 0.25 + 0.5 * sure);
  float behind = smoothstep(0.12, -0.12, facing);
  vec3 sieved = albedo * (0.35 + 2.4 * albedo / max(max(albedo.r, albedo.g), 0.02)) * vec3(0.62, 0.60, 0.36);
  // Deep in a crown there is little of the sky, and what there is has come through leaves.
  float shade = mix(0.5, 1.08, exposure) * mix(0.2, 1.16, vCrown.w) * open * mix(0.70, 1.08, sunAround(world));
  vec3 deep = mix(vec3(0.80, 1.0, 0.62), vec3(1.0), smoothstep(0.0, 0.6, vCrown.w));
  vec3 lit = albedo * (ambient(normalize(mix(normal, out_, 0.45 * sure))) * deep * 1.35 * shade + SUN_COLOUR * taken * sun * (1.0 - behind));
  float glow = pow(max(0.0, -dot(sight, uSun)), 4.0);
  lit += sieved * sheer * (SUN_COLOUR * (0.9 * behind * taken + 0.5 * glow) * sun + ambient(-normal) * deep * 0.9 * shade);
  // Gloss is that of the blade itself; what is too small to be seen of its bends only widens it.
  vec3 between = normalize(sight + uSun);
  // No derivatives: those of pixels whose neighbours have been cut away are not known.
  float pixel = distance(cameraPosition, world) / max(0.3 * uView.w * uLeafSize, 1e-3);
  float rough = uLeafRough * uLeafRough;
  rough = min(1.0, rough * rough + 0.35 * min(1.0, pixel * pixel));
  float toHalf = max(dot(normal, between), 0.0);
  float spread = toHalf * toHalf * (rough - 1.0) + 1.0;
  float toSun = max(dot(sight, between), 0.15);
  float shine = rough / (3.14159 * spread * spread) * 0.25 / (toSun * toSun) * (0.04 + 0.96 * pow(1.0 - toSun, 5.0)) * max(facing, 0.0);
  float edge = 0.04 + 0.5 * pow(1.0 - max(dot(normal, sight), 0.0), 5.0);
  return lit + (SUN_COLOUR * min(shine, 1.5) * sun + SKY_COLOUR * edge * shade * (1.0 - 0.6 * rough) * 0.5) * gloss;
}
`;
