import { FLAT_NOISE_SHIFT, FLAT_NOISE_SIDE, NOISE_SIDE } from "../noise-texture";
import { EASE_SECONDS } from "../table/radius-ease";
import { DYES } from "../table/row-dyes";

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
uniform vec4 uView; // eye of the camera, also while the sun draws; pixels of an internode at distance one
uniform float uTime;
`;

/** Reads the node table, the overlay slots of its rows, and their dyes; see \`node-texture.ts\` and \`overlays.ts\` for the layout. */
export const NODES = /* glsl */ `
uniform sampler2D uNodes;
uniform sampler2D uOverlays;
uniform vec3 uDyes[${2 * DYES}]; // factors of colours: of bark, and from ${DYES} on of leaves
const float TIP_SECONDS = 0.3;
struct Node {
  vec3 position;
  float radius;
  vec4 turn;
  float light;
  float birth;
  float growing;
  float extended;
  float arc; // of a seed, the number of its tree
  float look;
  int dye;
};
const float MARKED = 1.0;
const float HIDDEN = 2.0;
vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
vec4 product(vec4 a, vec4 b) { return vec4(a.w * b.xyz + b.w * a.xyz + cross(a.xyz, b.xyz), a.w * b.w - dot(a.xyz, b.xyz)); }
vec4 whole(vec3 q) { return vec4(q, sqrt(max(0.0, 1.0 - dot(q, q)))); }
/** Draws a node as its slot says. */
void applyOverlay(inout Node node, int slot, bool own) {
  ivec2 at = ivec2((slot & 15) * 4, slot >> 4);
  vec4 rotation = texelFetch(uOverlays, at, 0);
  vec4 offset = texelFetch(uOverlays, at + ivec2(1, 0), 0);
  vec4 mine = texelFetch(uOverlays, at + ivec2(2, 0), 0);
  vec4 swelling = texelFetch(uOverlays, at + ivec2(3, 0), 0);
  node.position = turned(rotation, node.position) + offset.xyz;
  node.look = offset.w;
  node.turn = own ? whole(mine.xyz) : product(rotation, node.turn);
  if (swelling.x != 1.0) node.radius = swelling.y * pow(max(node.radius, 1e-4), swelling.x);
  if (own && mine.w > 0.0) node.radius = mine.w;
}
float eased(float since, float seconds) {
  float t = clamp(since / max(seconds, 1e-4), 0.0, 1.0);
  return t * (2.0 - t);
}
Node nodeAt(int row) {
  ivec2 at = ivec2((row & 255) * 3, row >> 8);
  vec4 a = texelFetch(uNodes, at, 0);
  vec4 b = texelFetch(uNodes, at + ivec2(1, 0), 0);
  vec4 c = texelFetch(uNodes, at + ivec2(2, 0), 0);
  float packed_ = floor(abs(b.w));
  float light = (abs(b.w) - packed_) * (256.0 / 255.0);
  float slot = floor(packed_ / ${DYES}.0);
  Node node = Node(a.xyz, a.w, whole(b.xyz), light, c.x, c.y, c.z, c.w, 0.0, int(packed_ - ${DYES}.0 * slot));
  if (slot > 0.0) applyOverlay(node, int(slot), b.w < 0.0);
  if (node.growing < 0.0) {
    // It has grown long ago, and its radius glides to what it is.
    node.radius = mix(-node.growing, node.radius, eased(uTime - node.birth, ${EASE_SECONDS.toFixed(2)}));
    node.birth = -1000.0;
    node.growing = 0.0;
  }
  return node;
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
  p += seed * vec2(${FLAT_NOISE_SHIFT.join(", ")});
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
uniform float uShadowSize; // of a texel, in internodes
uniform float uShadowBias;
uniform int uShadowTaps; // 1, or 3 along each side of a square that softens edges; 0 for no shadows
uniform vec3 uSunColour;
uniform vec3 uSkyColour;
uniform vec3 uHorizonColour;
uniform vec3 uAirColour; // of air that is far away
uniform float uExposure;
uniform float uVivid; // how much of colours is seen
uniform vec3 uShown; // 1 where it is: light, rounded surfaces, what is painted on them
#define SUN_COLOUR uSunColour
#define SKY_COLOUR uSkyColour
#define HORIZON_COLOUR uHorizonColour
#define AIR_COLOUR uAirColour

/** How much of the sun comes to a place, which lies a little before what it lights. */
float sunAt(vec3 place, float softness) {
  if (uShadowTaps == 0) return 1.0;
  vec4 at = uSunFromWorld * vec4(place, 1.0);
  vec3 p = at.xyz * 0.5 + 0.5;
  if (p.x <= 0.0 || p.y <= 0.0 || p.x >= 1.0 || p.y >= 1.0) return 1.0;
  p.z = min(p.z, 1.0) - uShadowBias;
  if (uShadowTaps == 1) return texture(uShadow, p);
  float sum = 0.0;
  for (int i = 0; i < 9; i++) {
    vec2 offset = vec2(float(i % 3) - 1.0, float(i / 3) - 1.0) * uShadowTexel * softness;
    sum += texture(uShadow, vec3(p.xy + offset, p.z));
  }
  return sum / 9.0;
}
/** How much comes to the leaves around a place: whether a part of the crown lies in the sun as a whole. */
float sunAround(vec3 place) {
  if (uShadowTaps == 0) return 1.0;
  const float REACH = 1.7; // internodes
  vec3 p = (uSunFromWorld * vec4(place + uSun * 0.8, 1.0)).xyz * 0.5 + 0.5;
  if (p.x <= 0.0 || p.y <= 0.0 || p.x >= 1.0 || p.y >= 1.0) return 1.0;
  p.z = min(p.z, 1.0);
  vec2 wide = vec2(REACH, 0.45 * REACH) * (uShadowTexel / max(uShadowSize, 1e-4));
  float sum = texture(uShadow, vec3(p.xy + wide, p.z)) + texture(uShadow, vec3(p.xy - wide, p.z));
  if (uShadowTaps == 1) return sum * 0.5;
  wide = vec2(-wide.y, wide.x);
  return (sum + texture(uShadow, vec3(p.xy + wide, p.z)) + texture(uShadow, vec3(p.xy - wide, p.z))) * 0.25;
}
/** How much comes to a surface: its place is moved out of it by what the taps reach over, or it would shade itself. */
float sunlit(vec3 world, vec3 normal, float softness) {
  float facing = dot(normal, uSun);
  float taps = uShadowTaps == 1 ? 1.0 : 1.42 * softness + 0.75;
  float slant = sqrt(max(0.0, 1.0 - facing * facing));
  return sunAt(world + normal * (0.03 + uShadowSize * taps * slant), softness);
}
uniform vec3 uAmbient[9]; // \`sky-harmonics.ts\`
/** What comes from the sky and the ground to a surface that looks that way. */
vec3 ambient(vec3 n) {
  return max(uAmbient[0] + uAmbient[1] * n.y + uAmbient[2] * n.z + uAmbient[3] * n.x + uAmbient[4] * (n.x * n.y) + uAmbient[5] * (n.y * n.z)
    + uAmbient[6] * (3.0 * n.y * n.y - 1.0) + uAmbient[7] * (n.x * n.z) + uAmbient[8] * (n.x * n.x - n.z * n.z), vec3(0.0));
}
/** What is about to be cut glows red, as far as it is lit. */
vec3 condemned(vec3 albedo) {
  return mix(vec3(0.62, 0.05, 0.03), albedo, 0.15);
}
uniform vec2 uAir; // distance up to which it is clear, and how much it takes of a colour beyond
/** Air between the eye and what it sees: what is far behind the trees pales as the land does. */
vec3 hazed(vec3 colour, float distance) {
  return mix(AIR_COLOUR, colour, exp(-max(0.0, distance - uAir.x) * uAir.y));
}
/** A colour as it is, without light. */
vec3 unlit(vec3 albedo) {
  return pow(clamp(albedo * 1.2, 0.0, 1.0), vec3(0.4545));
}
/** Light as a film takes it, after AgX (T. Sobotka) in the polynomial form of B. Wrensch: bright greens stay green, and nothing burns out. */
vec3 finished(vec3 colour) {
  const mat3 INSET = mat3(0.842479, 0.042328, 0.042376, 0.078434, 0.878469, 0.078434, 0.079224, 0.079166, 0.879143);
  const mat3 OUTSET = mat3(1.196879, -0.052897, -0.052972, -0.098021, 1.151903, -0.098043, -0.099030, -0.098961, 1.151074);
  vec3 x = clamp((log2(max(INSET * (colour * uExposure), 1e-6)) + 12.47393) / 16.5, 0.0, 1.0);
  vec3 x2 = x * x;
  vec3 x4 = x2 * x2;
  x = 15.5 * x4 * x2 - 40.14 * x4 * x + 31.96 * x4 - 6.868 * x2 * x + 0.4298 * x2 + 0.1191 * x - 0.00232;
  // The film's own look is flat; a little more contrast brings it back to what the eye remembers.
  x = pow(max(x, 0.0), vec3(1.32));
  x += 0.5 * x * (1.0 - x) * (x - 0.5);
  x = mix(vec3(dot(x, vec3(0.2126, 0.7152, 0.0722))), x, uVivid);
  return clamp(OUTSET * x, 0.0, 1.0);
}
`;

/** What covers a part of a pixel, where pixels have no samples that could be covered one by one. */
export const COVER = /* glsl */ `
uniform int uSamples;
/**
 * A number between 0 and 1 of each place's own, for places a pixel apart (after C. Wyman and M. McGuire, 2017): what covers
 * less of a pixel than its number is left out, so that many such pixels together are covered as they should be, and the
 * same ones in the next frame.
 */
float grainAt(vec3 place) {
  float pixel = max(length(dFdx(place)), length(dFdy(place)));
  vec3 cell = floor(place / exp2(ceil(log2(max(pixel, 1e-5)))));
  return fract(sin(dot(mod(cell, 4096.0), vec3(12.9898, 78.233, 37.719))) * 43758.5453);
}
`;

/** Spreads what lies between two of the screen's colours, so that a soft gradient shows no bands. */
export const DITHER = /* glsl */ `
vec3 dithered(vec3 colour) {
  float grain = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  return colour + (grain - 0.5) / 255.0;
}
`;
