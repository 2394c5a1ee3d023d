import { EASES_OVER, NO_SLOPE, SLOPE_STEPS, STEEPEST } from "../table/girth";
import { RISES } from "../table/limb-curve";
import { BARK } from "./bark";
import { COVER, HEAD, LIGHT, NODES, NOISE } from "./common";
import { MODES, TRAITS } from "./draw-mode";
import { GHOST_COLOUR, GHOST_PLACE } from "./ghost";
import { itemsOf } from "./items";
import { ROOTS } from "./roots";

/** How much wood differs from a round tube, at most, as a share of its radius. */
const KNOTTY = 0.16;

/** Where a trunk meets the ground. */
const FOOT = /* glsl */ `${ROOTS}
/** How much wider than its wood a trunk is, as it spreads into its roots; how that changes with the turn, and with the height. */
vec3 rootFlare(uint tree, float turn, float along, float foot) {
  float height = max(along, 0.0) / (foot + 0.05);
  float fades = 0.22 * exp(-0.7 * height);
  vec3 flare = vec3(fades, 0.0, -0.7 * fades);
  for (int i = 0; i < rootsOf(tree) && height < 6.0; i++) {
    Root root = rootOf(tree, i);
    float off = turn - root.turn;
    // The nearer to the ground, the faster it spreads, and the narrower it is.
    float pinch = 2.6 * exp(-2.0 * height);
    float aside = cos(off) - 1.0;
    float rib = 1.5 * root.strong * exp(root.narrow * (1.0 + pinch) * aside);
    vec2 low = vec2(0.6, 0.4) * exp(-height * vec2(1.0, 3.2) / root.high);
    float wide = rib * (low.x + low.y);
    flare += vec3(wide, -root.narrow * (1.0 + pinch) * sin(off) * wide, -rib * (low.x + 3.2 * low.y) / root.high - 2.0 * root.narrow * pinch * aside * wide);
  }
  flare *= uBarkShape.y;
  return vec3(1.0 + flare.x, flare.y, along > 0.0 ? flare.z / (foot + 0.05) : 0.0);
}
/** The same on the average around the trunk. */
float meanFlare(float along, float foot) {
  float height = max(along, 0.0) / (foot + 0.05);
  return 1.0 + uBarkShape.y * (0.22 * exp(-0.7 * height) + 0.36 * exp(-1.6 * height));
}
/** How much longer the surface of a trunk is than its axis, from a place upwards: bark is not drawn out where it spreads. */
float surplus(float along, float foot) {
  float fades = 1.3 / (foot + 0.05);
  float incline = 0.8 * uBarkShape.y * exp(-fades * max(along, 0.0));
  float way = sqrt(1.0 + incline * incline);
  return (way - 1.0 - log(0.5 * (1.0 + way))) / fades - min(along, 0.0) * (way - 1.0);
}
/** Which way around the vertical a side of a trunk looks. */
float turnOf(vec3 outward, vec3 tangent) {
  vec3 east = abs(tangent.x) < 0.9 ? vec3(1, 0, 0) : vec3(0, -tangent.x, 0);
  east = normalize(east - tangent * dot(east, tangent));
  return atan(dot(outward, cross(east, tangent)), dot(outward, east));
}
`;

/** Where a limb leaves the axis that bears it. */
const JUNCTION = /* glsl */ `
const float STEEPEST = ${STEEPEST.toFixed(3)};
const float EASES_OVER = ${EASES_OVER.toFixed(3)};
/** What is left of too much girth after a length of wood, as \`girth.ts\` has it. */
float excess(float much, float along, float radius) {
  float straight = clamp((much - STEEPEST * EASES_OVER * radius) / STEEPEST, 0.0, along);
  return (much - STEEPEST * straight) * exp((straight - along) / (EASES_OVER * max(radius, 1e-4)));
}
struct Junction {
  vec3 outward; // of the bearing axis' surface
  float weight; // 1 where the limb comes out of it, 0 where it is wholly its own
  vec3 swelling; // how far its surface lies from where it would without the other
  vec2 place; // turn around and length along the bearing axis
  float radius; // of the bearing axis there
};
/**
 * A fillet between two tubes. The limb widens towards the bearing axis, more along it than across, and takes over its
 * normal and its bark: where one surface ends in the other, both look the same.
 */
Junction junctionAt(vec3 place, vec3 outward, float radius, vec3 heading, Node bearing) {
  vec3 axis = turned(bearing.turn, vec3(0, 1, 0));
  vec3 normal = turned(bearing.turn, vec3(1, 0, 0));
  vec3 binormal = cross(normal, axis);
  vec3 from = place - bearing.position;
  float height = dot(from, axis);
  vec3 across = from - axis * height;
  float reach = max(length(across), 1e-4);
  // What goes on above is as thick as the pipe model leaves it.
  float share = min(radius / max(bearing.radius, 1e-4), 1.0);
  float above = bearing.radius * pow(max(1.0 - pow(share, 2.4), 0.04), 0.42);
  float wood = above + excess(bearing.radius - above, max(height, 0.0), bearing.radius);
  float gap = reach - wood;
  float width = uBarkShape.z * min(1.3 * radius, 0.9 * bearing.radius) + 0.15 * radius;
  float close = clamp(1.0 - gap / max(width, 1e-4), 0.0, 1.0);
  float lengthwise = dot(outward, axis);
  // Across, a limb as thick as what bears it must not stick out of it.
  float room = clamp((0.97 * wood - radius) / max(width, 1e-4), 0.0, 0.4);
  float amount = mix(room, 1.0, lengthwise * lengthwise) * 0.7 * uBarkShape.z;
  float sunk = smoothstep(-0.7 * wood, 0.0, gap);
  float swelling = min(width, 1.3 * radius) * close * close * close * amount * sunk;
  // It spreads over the bearing axis rather than off it.
  vec3 side = across / reach;
  vec3 spread = outward - side * (dot(outward, side) * close);
  // Bark is that of the place where the swollen surface lies.
  vec3 moved = spread * swelling;
  height += dot(moved, axis);
  across += moved - axis * dot(moved, axis);
  vec2 turn = vec2(dot(across, normal), dot(across, binormal));
  float middle = atan(dot(heading, binormal), dot(heading, normal)) / 6.2831853;
  float aside = atan(turn.y, turn.x) / 6.2831853 - middle;
  return Junction(normalize(across), close * close * (3.0 - 2.0 * close), moved,
    vec2(middle + aside - round(aside), bearing.arc + height), wood);
}
`;

/** Wood is not quite round, and swells here and there; hardly anywhere does it shrink, or what ends within it would stick out. */
const KNOTS = /* glsl */ `
float bulge(vec2 side, float along, float octave, float own) {
  float lower = floor(octave);
  vec2 at = 0.3 * along * exp2(-lower - vec2(0.0, 1.0)) + own + 7.0 * lower;
  return mix(noise(vec3(side, at.x)), noise(vec3(side, at.y + 7.0)), octave - lower);
}
/** A factor of a radius; how it changes with the turn, and in a radius upwards. A limb's own number shifts it. */
vec3 knotted(vec2 side, float along, float radius, float own) {
  float octave = log2(max(radius, 0.01));
  float here = bulge(side, along, octave, own);
  vec2 rises = vec2(bulge(side + 0.3 * vec2(-side.y, side.x), along, octave, own), bulge(side, along + 0.3 * radius, octave, own)) - here;
  return vec3(1, 0, 0) + ${KNOTTY.toFixed(2)} * min(uBarkShape.x, 1.5) * smoothstep(0.08, 0.4, radius) * vec3(here - 0.3, rises / 0.3);
}
`;

/** Texels of the numbers of a metamer. */
export const METAMER_TEXELS = 1;

/** Sweeps a ring along one metamer, from its parent's orientation to its own. */
export const BRANCH_VERTEX = /* glsl */ `${HEAD}${itemsOf("usampler2D", METAMER_TEXELS)}${NODES}${TRAITS}${GHOST_PLACE}
in vec4 ring; // cosine, place along the metamer 0 to 1 and on to 2 over a cut end, sine, turn; of a strip, its side first
uniform vec4 uBarkShape; // relief, root flare, collar, smoothing
#ifdef CASTER
uniform vec3 uSun;
#endif
const uint BEGINS_LIMB = 1u;
const uint FROM_SEED = 2u;
const uint TRUNK = 4u;
const uint CUT = 8u;
const uint OVERLAPS = 16u;
const uint ROOT = 32u;
out vec3 vWorld;
out vec3 vNormal; // of a strip, where its side points
out vec3 vTangent;
out vec4 vBark; // turn, length along the limb, radius, how far towards the middle of a cut end or below 0
out vec4 vBearing; // the same of the limb that bears this one, and how much of its bark shows
out float vLight; // below 0 for what is marked
out float vTrait;
out vec3 vDye;
${NOISE}${FOOT}${JUNCTION}${KNOTS}
float slopeOf(uint code) { return (float(code & 255u) - ${NO_SLOPE.toFixed(1)}) / ${SLOPE_STEPS.toFixed(1)}; }
/** How thick the wood is at a node: a tip is slim until its axis goes on, unless it has been cut. */
float woodAt(Node node, bool cut) {
  return node.radius * mix(cut ? 1.0 : 0.42, 1.0, eased(uTime - node.extended, TIP_SECONDS));
}

void main() {
  int number = itemNumber();
  if (number >= uItemsDrawn[0]) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  // Row, parent's row, row where the limb begins, flags with the slopes of its girth below and above.
  uvec4 metamer = texelFetch(uItems, itemPlace(number), 0);
  Node end = nodeAt(int(metamer.x));
  Node bearing = nodeAt(int(metamer.z));
  uint own = uint(bearing.arc); // where that is a seed, the number of its tree
  bool none = (metamer.w & ROOT) != 0u && int(metamer.w >> 24u) >= rootsOf(own);
  if (end.look == HIDDEN || none) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  Node start = nodeAt(int(metamer.y));
  bool begins = (metamer.w & BEGINS_LIMB) != 0u;
  bool cut = (metamer.w & CUT) != 0u;
  float grown = eased(uTime - end.birth, end.growing);
  vec3 chord = end.position - start.position;
  float len = length(chord);
  vec3 heading = len > 1e-5 ? chord / len : vec3(0, 1, 0);

  vec3 t1 = turned(end.turn, vec3(0, 1, 0));
  vec3 t0 = turned(start.turn, vec3(0, 1, 0));
  vec3 n1 = turned(end.turn, vec3(1, 0, 0));
  vec3 n0 = turned(start.turn, vec3(1, 0, 0));
  if (begins) {
    // A lateral leaves along its bearing axis and bends away; one from the ground comes up, one from a cliff straight out.
    t0 = (metamer.w & FROM_SEED) != 0u ? normalize(heading + vec3(0, ${RISES.toFixed(1)} * max(heading.y, 0.0), 0)) : normalize(heading + 0.55 * t0);
    n0 = n1;
  }
  float smoothing = clamp(uBarkShape.w, 0.0, 1.0);
  vec3 leaves = normalize(mix(heading, t0, smoothing));
  vec3 arrives = normalize(mix(heading, t1, smoothing));
  float u = min(ring.y, 1.0);
  float u2 = u * u;
  float u3 = u2 * u;
  // Cubic Hermite curve through both nodes along their tangents.
  vec3 centre = start.position + grown * (
    (u3 - 2.0 * u2 + u) * len * leaves + (3.0 * u2 - 2.0 * u3) * chord + (u3 - u2) * len * arrives);
  vec3 tangent = normalize(
    (3.0 * u2 - 4.0 * u + 1.0) * leaves + (6.0 * u - 6.0 * u2) * heading + (3.0 * u2 - 2.0 * u) * arrives);
  // Rings at a joint lie across it for both its metamers, also where the axis has a corner there.
  float joint = pow(abs(2.0 * u - 1.0), 6.0) * (1.0 - smoothing);
  tangent = normalize(mix(tangent, u < 0.5 ? t0 : t1, joint));
  float r1 = woodAt(end, cut) * mix(0.25, 1.0, grown);
  float r0 = begins ? end.radius : woodAt(start, false);
  // Rings of thick wood turn evenly from node to node, or they would cross where the curve gathers its turn.
  bool rooted = (metamer.w & FROM_SEED) != 0u;
  if (!begins || rooted) {
    float stout = smoothstep(0.25, 0.6, max(r0, r1) / max(len, 1e-3)) * smoothing;
    tangent = normalize(mix(tangent, normalize(mix(t0, t1, u)), stout));
  }
  vec3 normal = mix(n0, n1, u);
  normal = normalize(normal - tangent * dot(tangent, normal));
  vec3 binormal = cross(normal, tangent);

  // Widths meet without a corner at the joints; the last metamer is a cone.
  float drop = r1 - r0;
  vec2 incline = vec2(slopeOf(metamer.w >> 8u) * r0, slopeOf(metamer.w >> 16u) * r1) * len;
  // While a width is tried out it may change by less than these slopes say.
  incline = clamp(incline, vec2(min(0.0, 3.0 * drop)), vec2(max(0.0, 3.0 * drop)));
  bool last = end.extended > 1e8 && !cut;
  float radius = last ? r0 + drop * u2 : r0 + drop * (3.0 * u2 - 2.0 * u3)
    + incline.x * (u3 - 2.0 * u2 + u) + incline.y * (u3 - u2);
  float slope = last ? 2.0 * drop * u : drop * (6.0 * u - 6.0 * u2)
    + incline.x * (3.0 * u2 - 4.0 * u + 1.0) + incline.y * (3.0 * u2 - 2.0 * u);
  slope /= max(len, 1e-3);
  radius *= smoothstep(0.0, 0.02, grown);
  float along = end.arc - len * (1.0 - u);
  // Where its sides are not those of the tube below, a joint would show gaps.
  if (u == 0.0 && (metamer.w & OVERLAPS) != 0u) centre -= tangent * 0.12 * r0;
  vLight = end.look == MARKED ? -1.0 : mix(start.light, end.light, u);
  vTrait = traitOf(int(metamer.x));
  // A limb begins in the colour of what bears it.
  vDye = mix(uDyes[start.dye], uDyes[end.dye], u);
  vTangent = tangent;
  vBearing = vec4(0.0, 0.0, 1.0, 0.0);
  vec3 world;
#ifdef RIBBON
#ifdef CASTER
  vec3 eye = uSun;
#else
  vec3 eye = cameraPosition - centre;
#endif
  vec3 side = cross(tangent, eye);
  side = dot(side, side) > 1e-8 ? normalize(side) : binormal;
  float drawn = radius;
  float cover = 1.0;
#ifdef CASTER
  if ((metamer.w & ROOT) != 0u) {
    Root root = rootOf(own, int(metamer.w >> 24u));
    float foot = bearing.radius * smoothstep(0.0, 0.02, grown);
    vec4 middle = rootAt(root, foot, u);
    centre = bearing.position + middle.xyz;
    side = normalize(cross(rootAt(root, foot, u + 0.01).xyz - middle.xyz, eye));
    drawn = middle.w;
  }
#endif
  if ((metamer.w & TRUNK) != 0u) drawn *= 0.5 + 0.5 * meanFlare(along, bearing.radius);
#ifndef CASTER
  // Thinner than a pixel it would flicker; it is drawn a pixel wide and lets so much more through.
  float least = 0.55 * length(eye) / max(uView.w, 1.0);
  cover = clamp(drawn / max(least, 1e-6), 0.0, 1.0);
  drawn = max(drawn, least * smoothstep(0.0, 0.02, grown));
#endif
  world = centre + side * (ring.x * drawn);
  vNormal = side;
  vBark = vec4(ring.x, along, radius, cover);
#else
  float wide = length(ring.xz);
  vec3 outward = (normal * ring.x + binormal * ring.z) / wide;
  float plain = radius;
  vec3 knots = knotted(ring.xz / wide, along, radius, bearing.arc);
  radius *= knots.x;
  slope = slope * knots.x + knots.z;
  vec3 askew = cross(outward, tangent) * knots.y;
  vNormal = outward - askew - tangent * slope;
  if ((metamer.w & TRUNK) != 0u) {
    // A seed is as thick as its trunk.
    float foot = bearing.radius;
    vec3 spread = rootFlare(own, turnOf(outward, tangent), along, foot);
    vNormal = outward - askew - cross(outward, tangent) * (spread.y / spread.x) - tangent * (slope * spread.x + radius * spread.z);
    radius *= spread.x;
    // The foot goes on into what it stands on, however that slopes; deeper where it leans, for it is round.
    if (begins) {
      float sunk = (1.0 - u) * (1.0 - u) * foot * (0.5 + 0.9 * length(t0.xz) + 1.1 * dot(t0.xz, t0.xz));
      centre -= t0 * sunk;
      along -= sunk;
    }
    world = centre + outward * radius * wide;
    plain *= 1.0 + 0.6 * (meanFlare(along, foot) - 1.0);
    along -= surplus(along, foot);
  } else if ((metamer.w & ROOT) == 0u) {
    // Its open end stays within its bearer, also where that is no thicker and bends away.
    radius *= mix(0.3, 1.0, smoothstep(0.0, 0.9 * bearing.radius, along));
    world = centre + outward * radius * wide;
    if (along < 5.0 * (bearing.radius + end.radius)) {
      Junction junction = junctionAt(world, outward, max(radius, 1e-4), heading, bearing);
      world += junction.swelling * grown;
      vNormal = mix(normalize(vNormal), junction.outward, junction.weight * 0.92) + 0.02 * heading;
      vBearing = vec4(junction.place, junction.radius, junction.weight);
    }
  }
  vNormal = normalize(vNormal);
  vBark = vec4(ring.w, along, max(plain, 0.005), -1.0);
  if ((metamer.w & ROOT) != 0u) {
    float foot = bearing.radius * smoothstep(0.0, 0.02, grown);
    Root root = rootOf(own, int(metamer.w >> 24u));
    vec4 middle = rootAt(root, foot, ring.y);
    tangent = normalize(rootAt(root, foot, ring.y + 0.01).xyz - middle.xyz);
    normal = normalize(cross(vec3(-tangent.z, 0.0, tangent.x), tangent));
    binormal = cross(normal, tangent);
    // Near the trunk it stands upright, as a board; further out it lies flat.
    vec2 shape = mix(vec2(1.5, 0.8), vec2(0.85, 1.1), smoothstep(0.1, 0.5, ring.y));
    vec3 from = middle.xyz + middle.w * (normal * ring.x * shape.x + binormal * ring.z * shape.y);
    world = bearing.position + from;
    vNormal = normalize(normal * (ring.x / shape.x) + binormal * (ring.z / shape.y));
    // Its bark comes out of the trunk's, and lies as that does: upwards. On its sides that would be drawn out.
    vTangent = -tangent;
    float far = length(middle.xz);
    vBark = vec4(-ring.w, -far, max(middle.w, 0.005), -1.0);
    vec3 side = normalize(n0 - t0 * dot(t0, n0));
    vec3 face = cross(side, t0);
    float ahead = atan(dot(middle.xyz, face), dot(middle.xyz, side)) / 6.2831853;
    float aside = atan(dot(from, face), dot(from, side)) / 6.2831853 - ahead;
    float low = from.y - surplus(from.y, foot) - max(0.0, length(from.xz) - 1.5 * foot);
    vBearing = vec4(ahead + aside - round(aside), low, foot * (1.0 + 0.6 * (meanFlare(0.0, foot) - 1.0)), (1.0 - ring.z * ring.z) * (1.0 - smoothstep(2.0, 4.0, far / max(foot, 1e-3))));
  }
  if (ring.y >= 1.0 && cut) {
    // A cut heals from its rim: the face bulges a little, and its edge is round.
    float inward = ring.y - 1.0;
    vec3 bulge = tangent * radius * 0.1 * sqrt(max(0.0, 1.0 - (1.0 - inward) * (1.0 - inward)));
    world = centre + outward * radius * (1.0 - inward) + bulge;
    vNormal = normalize(mix(outward, tangent, smoothstep(0.0, 0.1, inward)));
    vBark.w = inward;
  }
#endif
  vWorld = world;
#ifdef GHOST
  vWorld = world = ghostPlace(world);
  vNormal = turned(uGhostTurn, vNormal);
  vTangent = turned(uGhostTurn, vTangent);
#endif
  gl_Position = projectionMatrix * viewMatrix * vec4(world, 1.0);
}
`;

/** What covers wood, and the light on it: of the first picture, or finer. */
export interface WoodLook {
  readonly declared: string;
  /** Changes `albedo` of wood that looks to `smoothed`. */
  readonly covered: string;
  /** Says what is `lit`. */
  readonly lit: string;
}
const PLAIN_WOOD: WoodLook = {
  declared: "",
  covered: "",
  lit: /* glsl */ `
  float open = mix(1.0, bark.cavity, 0.55);
  vec3 lit = albedo * (ambient(normal) * exposure * bark.cavity * grounded + SUN_COLOUR * max(facing, 0.0) * sun * open);
  lit += SKY_COLOUR * 0.04 * pow(1.0 - max(dot(sight, smoothed), 0.0), 4.0) * exposure * bark.cavity;
`,
};

/** Bark in the light of sun and sky. */
export const branchFragment = (wood = PLAIN_WOOD) => /* glsl */ `${HEAD}${COVER}${NOISE}${LIGHT}${MODES}${GHOST_COLOUR}
in vec3 vWorld;
in vec3 vNormal;
in vec3 vTangent;
in vec4 vBark;
in vec4 vBearing;
in float vLight;
in float vTrait;
in vec3 vDye;
out vec4 colour;
uniform int uGround;
/** Moss of grass, soil, sand and snow, and how much of it; nothing comes from bare paper. */
const vec4 AT_FOOT[5] = vec4[5](vec4(0.090, 0.094, 0.040, 0.6), vec4(0.125, 0.092, 0.064, 0.55), vec4(0.400, 0.310, 0.210, 0.6), vec4(0.800, 0.825, 0.860, 0.75), vec4(0));
${BARK}
${wood.declared}
void main() {
  vec3 eye = cameraPosition - vWorld;
  float away = length(eye);
  vec3 sight = eye / max(away, 1e-4);
  vec3 lengthwise = normalize(vTangent);
  float cover = 1.0;
#ifdef RIBBON
  cover = vBark.w;
  if (uSamples == 1 && cover < 1.0 && cover <= grainAt(vWorld)) discard;
  // The strip stands for a round twig: its normal turns from one side over the eye to the other.
  vec3 front = normalize(sight - lengthwise * dot(sight, lengthwise));
  float across = clamp(vBark.x, -1.0, 1.0);
  vec3 smoothed = uShown.y > 0.5 ? normalize(vNormal * across + front * sqrt(1.0 - across * across)) : front;
  Bark bark = distantBark(vBark.z);
  bark.albedo *= vDye;
  vec3 normal = smoothed;
#else
  bool rounded = uShown.y > 0.5;
  vec3 smoothed = rounded ? normalize(vNormal) : facet(vWorld, sight);
  Bark bark = plainBark(vBark);
  if (uShown.z > 0.5) bark = barkAt(vBark, vBearing);
  if (vBark.w < 0.0) bark.albedo *= vDye;
  vec3 crosswise = cross(smoothed, lengthwise);
  crosswise /= max(length(crosswise), 1e-3);
  vec3 normal = rounded ? normalize(smoothed - crosswise * bark.slope.x - cross(crosswise, smoothed) * bark.slope.y) : smoothed;
#endif
  vec3 albedo = bark.albedo;
${wood.covered}
  if (vLight < 0.0) albedo = condemned(albedo);
  float exposure = mix(0.85, 1.35, abs(vLight));
  float facing = dot(normal, uSun);
  float sun = facing > 0.0 ? sunlit(vWorld, smoothed, 1.0) * smoothstep(-0.1, 0.2, dot(smoothed, uSun)) : 0.0;
  // What the trunk stands on climbs its foot, and the ground keeps the sky from it.
  if (vWorld.y < 0.65 && uShown.z > 0.5) {
    float rim = smoothstep(uGround == 3 ? 0.4 : 0.2, 0.0, vWorld.y - 0.25 * (noise(vWorld * 3.0) - (uGround == 3 ? 0.0 : 0.3)));
    albedo = mix(albedo, AT_FOOT[uGround].rgb, rim * AT_FOOT[uGround].a);
  }
  float grounded = mix(0.45, 1.0, smoothstep(0.0, 1.4, vWorld.y));
${wood.lit}
  colour = vec4(shownAs(finished(hazed(lit, away)), albedo, vTrait, dot(normal, sight)), cover);
#ifdef GHOST
  colour = ghostly(colour);
#endif
}
`;
