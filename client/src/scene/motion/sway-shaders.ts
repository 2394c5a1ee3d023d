import { FLAT_NOISE_SIDE } from "../noise-texture";

/** Steps of an internode in which a row's displacement is written, and of 1 in which the numbers of its turn are. */
const SHIFT_STEPS = 2048;
const TURN_STEPS = 2047;
/** Steps of 1 m/s in which the speed of the air around it is. */
const AIR_STEPS = 512;

/** Writes how one row moves into a texel of three words of 20 bits of displacement with 12 of turn, and one with the air's speed. */
const PACK = /* glsl */ `
uvec4 packed(vec3 shift, vec4 turn, float air) {
  ivec3 far = ivec3(round(clamp(shift * ${SHIFT_STEPS}.0, -524287.0, 524287.0)));
  ivec3 part = ivec3(round(clamp((turn.w < 0.0 ? -turn.xyz : turn.xyz) * ${TURN_STEPS}.0, -2047.0, 2047.0)));
  return uvec4(uvec3((far << 12) | (part & 4095)), uint(clamp(air, 0.0, 120.0) * ${AIR_STEPS}.0 + 0.5));
}
`;
const UNPACK = /* glsl */ `
struct Sway { vec3 shift; vec4 turn; float air; };
Sway unpacked(uvec4 texel) {
  ivec3 words = ivec3(texel.xyz);
  vec3 part = vec3((words << 20) >> 20) / ${TURN_STEPS}.0;
  return Sway(vec3(words >> 12) / ${SHIFT_STEPS}.0, vec4(part, sqrt(max(0.0, 1.0 - dot(part, part)))), float(texel.w) / ${AIR_STEPS}.0);
}
`;

/** Texels of a joint's numbers in a line of their texture. */
export const JOINTS_A_LINE = 64;
export const JOINT_TEXELS = 3;
/** Lines along the wind that a shader takes: 14 of each wind, and of seven that set in a quarter of a second apart none is over. */
export const MOST_GUSTS = 98;

export const MOVE_VERTEX = /* glsl */ `
in vec3 position;
void main() { gl_Position = vec4(position, 1.0); }
`;

/** One fragment a row: how it moves, as `pose.ts` has it; with the shiver of twigs, and the air around it. */
export const MOVE_FRAGMENT = /* glsl */ `
precision highp float;
precision highp int;
precision highp sampler2D;
uniform sampler2D uNodes;
uniform sampler2D uRides;
uniform sampler2D uJoints;
uniform highp usampler2D uBefore;
uniform float uShare; // of what moves now; the rest is as before
uniform int uRows;
uniform int uGusts;
uniform vec4 uGust[${MOST_GUSTS}]; // wave number with the line's angle
uniform vec4 uSize[${Math.ceil(MOST_GUSTS / 4)}]; // amplitudes along the wind in m/s, four together
uniform vec3 uAir; // speed in m/s, seconds of the period, how much of it there is
out uvec4 moved;
${PACK}${UNPACK}
vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
vec4 product(vec4 a, vec4 b) { return vec4(a.w * b.xyz + b.w * a.xyz + cross(a.xyz, b.xyz), a.w * b.w - dot(a.xyz, b.xyz)); }
vec4 turnBy(vec3 by) {
  float angle = length(by);
  return vec4(by * (angle < 1e-4 ? 0.5 : sin(0.5 * angle) / angle), cos(0.5 * angle));
}
/** Between −1 and 1, some times in a second, and the same after the period of the wind. */
float quiver(float number, float least) {
  float times = floor((least + 3.0 * fract(number * 57.31)) * 600.0) / 600.0;
  return sin(6.2831853 * (fract(times * uAir.y) + fract(number * 131.7)));
}
float speedAt(vec3 place) {
  float speed = uAir.x;
  for (int k = 0; k < uGusts; k++) speed += uSize[k >> 2][k & 3] * cos(uGust[k].w - dot(uGust[k].xyz, place));
  return max(0.0, speed * uAir.z);
}
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  int row = at.y * 256 + at.x;
  if (row >= uRows) { moved = packed(vec3(0.0), vec4(0, 0, 0, 1), 0.0); return; }
  vec3 rest = texelFetch(uNodes, ivec2(at.x * 3, at.y), 0).xyz;
  ivec2 from = ivec2(at.x * 3, at.y);
  vec4 a = texelFetch(uRides, from, 0);
  vec4 b = texelFetch(uRides, from + ivec2(1, 0), 0);
  vec4 c = texelFetch(uRides, from + ivec2(2, 0), 0);
  int joint = int(a.x);
  vec3 shift = vec3(0.0);
  vec4 turn = vec4(0, 0, 0, 1);
  float air = speedAt(rest);
  if (joint >= 0) {
    ivec2 place = ivec2((joint % ${JOINTS_A_LINE}) * ${JOINT_TEXELS}, joint / ${JOINTS_A_LINE});
    vec4 bend = texelFetch(uJoints, place, 0);
    vec4 stands = texelFetch(uJoints, place + ivec2(1, 0), 0);
    vec3 origin = texelFetch(uJoints, place + ivec2(2, 0), 0).xyz;
    air *= bend.w;
    vec3 still = rest;
    if (c.w >= 0.0) {
      // What is too stiff to bend shivers about where it stands.
      vec3 by = 0.02 * sqrt(air / 5.0) * vec3(quiver(c.w, 3.0), 0.6 * quiver(fract(c.w * 7.7), 4.0), quiver(fract(c.w * 3.3), 3.5));
      shift = cross(by, rest - c.xyz);
      turn = turnBy(by);
      still += shift;
    }
    vec3 first = vec3(a.zw, b.x);
    vec3 second = b.yzw;
    float squared = dot(bend.xyz, bend.xyz);
    float angle = sqrt(squared);
    float across = squared < 1e-6 ? 1.0 : sin(angle) / angle;
    float back = squared < 1e-6 ? 0.5 : (1.0 - cos(angle)) / squared;
    vec3 ridden = still + across * cross(bend.xyz, first) + back * cross(bend.xyz, cross(bend.xyz, second));
    shift = turned(stands, ridden) + origin - rest;
    turn = product(stands, product(turnBy(a.y * bend.xyz), turn));
    shift.y = max(shift.y, min(rest.y, 0.0) - rest.y);
  }
  if (uShare < 1.0) {
    Sway before = unpacked(texelFetch(uBefore, at, 0));
    shift = mix(before.shift, shift, uShare);
    turn = normalize(mix(before.turn, turn.w < 0.0 ? -turn : turn, uShare));
    air = mix(before.air, air, uShare);
  }
  moved = packed(shift, turn, air);
}
`;

const SWAY = /* glsl */ `
uniform highp usampler2D uMoved;
${UNPACK}
Sway swayAt(int row) { return unpacked(texelFetch(uMoved, ivec2(row & 255, row >> 8), 0)); }
Node nodeAt(int row) {
  Node node = restAt(row);
  Sway sway = swayAt(row);
  node.position += sway.shift;
  node.turn = product(sway.turn, node.turn);
  return node;
}
`;

/** How blades move about their bases: downwind, up and down, and about their midribs. */
export const FLUTTER = /* glsl */ `
uniform sampler2D uFlatNoise;
uniform vec3 uLee;
uniform vec2 uFlutter; // how much of it, and cells of noise that have gone by
uniform vec2 uWeather;
float flutterNoise(float along, float seed) {
  float cell = floor(along);
  float f = along - cell;
  vec2 at = vec2(cell + f * f * (3.0 - 2.0 * f), floor(seed * ${FLAT_NOISE_SIDE - 1}.0)) + 0.5;
  return 2.0 * textureLod(uFlatNoise, at / ${FLAT_NOISE_SIDE}.0, 0.0).r - 1.0;
}
vec4 fluttered(float air, vec3 base, vec4 more, vec3 d, vec3 side) {
  float gone = uFlutter.y - 0.45 * dot(base, uLee) + 13.0 * more.z;
  float much = uFlutter.x;
  vec3 by = cross(d, uLee) * min(0.06 * air, 0.9) * min(much, 1.0);
  // Wet blades hang, and so do those that snow lies on.
  by += cross(d, vec3(0.0, -1.0, 0.0)) * min(0.7, 0.35 * uWeather.y + 0.5 * uWeather.x);
  by += side * (0.25 * much * min(1.0, air / 8.0) * flutterNoise(gone, more.x));
  by += d * (0.5 * much * min(1.0, air / 6.0) * flutterNoise(gone + 57.3, more.y));
#ifdef SPRIG
  by *= 0.5;
#endif
  return normalize(vec4(0.5 * by, 1.0));
}
void flutter(float air, vec3 base, vec4 more, inout vec3 d, inout vec3 side, inout vec3 n) {
  vec4 turn = fluttered(air, base, more, d, side);
  d = turned(turn, d);
  side = turned(turn, side);
  n = turned(turn, n);
}
`;

/** One change of a shader's text. White space in it may be more or less where shaders were shortened. */
interface Change {
  readonly from: RegExp;
  readonly to: string;
}

const line = (text: string) =>
  new RegExp(
    text
      .replace(/[.*+?^${}()|[\]\\]/g, "\\$&")
      .replace(/ ?(\\?[=*/,;<>{}()?:]) ?/g, " ?$1 ?")
      .replace(/ \?$/, ""),
  );

/** What is no longer where the table has it: for every shader that draws rows. */
const MOVED: Change = { from: line("Node nodeAt(int row)"), to: "Node restAt(int row) " };
const READ: Change = { from: line("float radiusNow(Node node)"), to: `${SWAY}float radiusNow(Node node) ` };
/** Bark goes with its wood, however that is stretched. */
const ALONG: Change = {
  from: line("float along = end.arc - len * (1.0 - u);"),
  to: `float along = end.arc - (1.0 - u) * distance(
    end.position - swayAt(int(metamer.x)).shift, start.position - swayAt(int(metamer.y)).shift);`,
};
/** What a row bears is placed as it is at rest, and then turned: or it would spin where its azimuth has no direction. */
const PLACED: Change = {
  from: line("Leaf place = leafAt(from.position, node.position, leaf.z, leaf.w, own.stance);"),
  to: `Sway sway = swayAt(int(leaf.x + 0.5));
  Leaf place = leafAt(from.position - swayAt(int(leaf.y + 0.5)).shift, node.position - sway.shift, leaf.z, leaf.w, own.stance);
  place = Leaf(mix(from.position, node.position, leaf.w), turned(sway.turn, place.direction), turned(sway.turn, place.normal));`,
};
const FLUTTERS: Change = {
  from: line("vec3 n = cross(side, d);"),
  to: "vec3 n = cross(side, d); flutter(sway.air, place.base, more, d, side, n);",
};
const FLUTTERING: Change = { from: line("void main()"), to: `${FLUTTER}void main() ` };

/** The same vertex shader for rows that move. */
export function swaying(shader: string): string {
  let changed = apply(apply(shader, MOVED), READ);
  if (ALONG.from.test(changed)) changed = apply(changed, ALONG);
  if (PLACED.from.test(changed)) changed = apply(changed, PLACED);
  if (FLUTTERS.from.test(changed)) changed = apply(apply(changed, FLUTTERS), FLUTTERING);
  return changed;
}

/** What lies on what is drawn: wet it is darker, and snow lies on what looks up. */
const WEATHER = /* glsl */ `
uniform vec2 uWeather; // how far snow covers what it lies on, how wet it is
/** How much of what looks up is white. */
float snowCover() { return min(1.0, 1.3 * uWeather.x); }
/** What is less steep than \`steep\` begins to be white. */
vec3 weathered(vec3 albedo, vec3 normal, float steep) {
  albedo *= mix(1.0, 0.64, uWeather.y);
  return mix(albedo, vec3(0.81, 0.87, 0.97), snowCover() * smoothstep(steep, steep + 0.45, normal.y));
}
`;
/** Snow on leaves that look up is thicker than they are: it fills what is open between them. On needles it lies in small heaps. */
const HEAPED: Change = {
  from: line("vec4 painted = paintedAt(vPicture);"),
  to: `vec4 painted = paintedAt(vPicture);
  float heaped = 0.0;
  if (snowCover() > 0.0) {
    // Of a leaf that is seen from below the snow lies on the other side.
    bool seenFromAbove = dot(vNormal, cameraPosition - vWorld) * vNormal.y > 0.0;
    heaped = seenFromAbove ? snowCover() * smoothstep(0.15, 0.6, abs(normalize(vNormal).y)) : 0.0;
    vec2 heaps = sin(vec2(37.0, 45.0) * vPicture + 9.0 * vSide.xy);
    heaped *= mix(1.0, smoothstep(-0.35, 0.45, heaps.x * heaps.y), uLeafForm.y);
    // A heap is round: it ends before the leaf's picture, one of two by two, does.
    vec2 inward = 0.5 - abs(fract(2.0 * vPicture) - 0.5);
    heaped *= smoothstep(0.02, 0.16, min(inward.x, inward.y));
    painted.a = max(painted.a, heaped * smoothstep(0.10, 0.35, aroundAt(vPicture)));
    // The light that comes through a leaf does not come through the snow on it.
    painted.b *= 1.0 - heaped;
  }`,
};
const LIES_ON = ["vLight", "vLight.x"].map((light) => line(`if (${light} < 0.0) albedo = condemned(albedo);`));
/** From wood snow falls here and there, and lies on its back alone. */
const STEEP_WOOD = "0.7 * noise(vWorld * 1.3) + 0.3 * noise(vWorld * 6.0) - 0.2";
const STEEP = "-0.05";
/** Among leaves snow lies on what is open to the sky, is bluish as the sky is, and is lit from above whichever way its leaf looks. */
const LIES_ON_LEAF: Change = {
  from: line(`albedo = weathered(albedo, normal, ${STEEP});`),
  to: `heaped = max(heaped, 0.8 * snowCover() * smoothstep(0.45, 0.8, normal.y)) * smoothstep(0.1, 0.5, abs(vLight.x));
  heaped = smoothstep(0.2, 0.7, heaped);
  albedo = mix(weathered(albedo, vec3(0.0, -1.0, 0.0), ${STEEP}), vec3(0.74, 0.84, 1.1), heaped);
  painted.b *= 1.0 - heaped;
  normal = normalize(mix(normal, vec3(0.0, 1.0, 0.0), 0.6 * heaped));`,
};
const WEATHERED: Change = { from: line("void main()"), to: `${WEATHER}void main() ` };

/** The same fragment shader for what stands in rain and snow; one that draws no colour of rows is left as it is. */
export function weathering(shader: string): string {
  const from = LIES_ON.find((lies) => lies.test(shader));
  if (!from) return shader;
  const steep = /\bvBark\b/.test(shader) ? STEEP_WOOD : STEEP;
  const lies = shader.replace(from, (rest) => `albedo = weathered(albedo, normal, ${steep}); ${rest}`);
  const white = apply(lies, WEATHERED);
  return HEAPED.from.test(white) ? apply(apply(white, HEAPED), LIES_ON_LEAF) : white;
}

function apply(shader: string, { from, to }: Change): string {
  if (!from.test(shader)) throw new Error(`A shader has nothing like ${from.source}.`);
  return shader.replace(from, () => to);
}
