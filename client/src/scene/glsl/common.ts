import { FLAT_NOISE_SIDE, NOISE_SIDE } from "../noise-texture";

/** Start of every shader: precision, and the uniforms that all of them share. */
export const HEAD = /* glsl */ `
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler2DShadow;
precision highp sampler3D;
uniform mat4 projectionMatrix;
uniform mat4 viewMatrix;
uniform vec3 cameraPosition;
uniform float uTime;
`;

/** Reads the node table; see \`node-texture.ts\` for what stands where. */
export const NODES = /* glsl */ `
uniform sampler2D uNodes;
const float TIP_SECONDS = 0.3;
struct Node {
  vec3 position;
  float radius;
  vec4 turn;
  float light;
  float birth;
  float growing;
  float extended;
  float arc;
};
Node nodeAt(int row) {
  ivec2 at = ivec2((row & 255) * 3, row >> 8);
  vec4 a = texelFetch(uNodes, at, 0);
  vec4 b = texelFetch(uNodes, at + ivec2(1, 0), 0);
  vec4 c = texelFetch(uNodes, at + ivec2(2, 0), 0);
  vec4 turn = vec4(b.xyz, sqrt(max(0.0, 1.0 - dot(b.xyz, b.xyz))));
  return Node(a.xyz, a.w, turn, b.w, c.x, c.y, c.z, c.w);
}
vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
float eased(float since, float seconds) {
  float t = clamp(since / max(seconds, 1e-4), 0.0, 1.0);
  return t * (2.0 - t);
}
/** A node's radius now: a tip is slim until its axis goes on. */
float radiusNow(Node node) {
  return node.radius * mix(0.45, 1.0, eased(uTime - node.extended, TIP_SECONDS));
}
`;

/** Smooth noise from the lattices of \`noise-texture.ts\`, one fetch each; the curve between their values is made here. */
export const NOISE = /* glsl */ `
uniform sampler3D uNoise;
uniform sampler2D uFlatNoise;
float noise(vec3 p) {
  vec3 i = floor(p);
  vec3 f = p - i;
  return texture(uNoise, (i + f * f * (3.0 - 2.0 * f) + 0.5) / ${NOISE_SIDE}.0).r;
}
/** Noise in a plane; planes of different seeds have nothing in common. */
float noise(vec2 p, float seed) {
  p += seed * vec2(17.13, 31.71);
  vec2 i = floor(p);
  vec2 f = p - i;
  return texture(uFlatNoise, (i + f * f * (3.0 - 2.0 * f) + 0.5) / ${FLAT_NOISE_SIDE}.0).r;
}
`;

/** Sun, sky and shadow for whatever is lit; all colours are linear until \`finished\`. */
export const LIGHT = /* glsl */ `
uniform vec3 uSun;
uniform mat4 uSunFromWorld;
uniform sampler2DShadow uShadow;
uniform float uShadowTexel;
uniform int uShadowTaps; // 1, or 3 along each side of a square that softens edges
const vec3 SUN_COLOUR = vec3(1.0, 0.88, 0.70) * 3.3;
const vec3 SKY_COLOUR = vec3(0.42, 0.58, 0.82);
const vec3 BOUNCE_COLOUR = vec3(0.42, 0.40, 0.26);
const vec3 HORIZON_COLOUR = vec3(1.02, 1.00, 0.90);

float sunlit(vec3 world, vec3 normal, float softness) {
  vec4 at = uSunFromWorld * vec4(world + normal * 0.03, 1.0);
  vec3 p = at.xyz * 0.5 + 0.5;
  if (p.x <= 0.0 || p.y <= 0.0 || p.x >= 1.0 || p.y >= 1.0) return 1.0;
  p.z = min(p.z, 1.0) - 0.0012;
  if (uShadowTaps == 1) return texture(uShadow, p);
  float sum = 0.0;
  for (int i = 0; i < 9; i++) {
    vec2 offset = vec2(float(i % 3) - 1.0, float(i / 3) - 1.0) * uShadowTexel * softness;
    sum += texture(uShadow, vec3(p.xy + offset, p.z));
  }
  return sum / 9.0;
}
vec3 ambient(vec3 normal) {
  return mix(BOUNCE_COLOUR * 0.55, SKY_COLOUR, normal.y * 0.5 + 0.5) * 0.8;
}
/** Air between the eye and what it sees: what is far behind the trees fades into the horizon. */
vec3 hazed(vec3 colour, float distance) {
  return mix(HORIZON_COLOUR, colour, exp(-max(0.0, distance - 160.0) * 0.0011));
}
/** Filmic shoulder, then sRGB. */
vec3 finished(vec3 colour) {
  colour *= 0.72;
  vec3 c = (colour * (2.51 * colour + 0.03)) / (colour * (2.43 * colour + 0.59) + 0.14);
  c = clamp(c, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}
`;
