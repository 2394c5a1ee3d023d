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

/** Reads the node table and what its rows wear; see \`node-texture.ts\` and \`guises.ts\` for what stands where. */
export const NODES = /* glsl */ `
uniform sampler2D uNodes;
uniform sampler2D uGuises;
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
  float look;
};
const float MARKED = 1.0;
const float HIDDEN = 2.0;
vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
vec4 product(vec4 a, vec4 b) { return vec4(a.w * b.xyz + b.w * a.xyz + cross(a.xyz, b.xyz), a.w * b.w - dot(a.xyz, b.xyz)); }
vec4 whole(vec3 q) { return vec4(q, sqrt(max(0.0, 1.0 - dot(q, q)))); }
/** Draws a node as its slot says. */
void wear(inout Node node, int slot, bool own) {
  ivec2 at = ivec2((slot & 15) * 4, slot >> 4);
  vec4 rotation = texelFetch(uGuises, at, 0);
  vec4 offset = texelFetch(uGuises, at + ivec2(1, 0), 0);
  vec4 mine = texelFetch(uGuises, at + ivec2(2, 0), 0);
  vec4 swelling = texelFetch(uGuises, at + ivec2(3, 0), 0);
  node.position = turned(rotation, node.position) + offset.xyz;
  node.look = offset.w;
  node.turn = own ? whole(mine.xyz) : product(rotation, node.turn);
  if (swelling.x != 1.0) node.radius = swelling.y * pow(max(node.radius, 1e-4), swelling.x);
  if (own && mine.w > 0.0) node.radius = mine.w;
}
Node nodeAt(int row) {
  ivec2 at = ivec2((row & 255) * 3, row >> 8);
  vec4 a = texelFetch(uNodes, at, 0);
  vec4 b = texelFetch(uNodes, at + ivec2(1, 0), 0);
  vec4 c = texelFetch(uNodes, at + ivec2(2, 0), 0);
  float slot = floor(abs(b.w));
  float light = (abs(b.w) - slot) * (256.0 / 255.0);
  Node node = Node(a.xyz, a.w, whole(b.xyz), light, c.x, c.y, c.z, c.w, 0.0);
  if (slot > 0.0) wear(node, int(slot), b.w < 0.0);
  return node;
}
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
/** What is about to be cut glows red, as far as it is lit. */
vec3 condemned(vec3 albedo) {
  return mix(vec3(0.62, 0.05, 0.03), albedo, 0.15);
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
