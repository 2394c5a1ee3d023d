import { BLADE_STEP } from "../foliage/leaf-cards";
import { SPRIG_LEAVES, SPRIG_REACH, TILE_MARGIN } from "../painting/measures";
import { DYES } from "../table/row-dyes";
import { COVER, HEAD, LIGHT, NODES } from "./common";
import { MODES, TRAITS } from "./draw-mode";
import { GHOST_COLOUR, GHOST_PLACE } from "./ghost";
import { itemsOf } from "./items";
import { DEPTH_COLOUR } from "./shadow";

/** Where rules LF1–LF5 put a leaf, from where its metamer is drawn. */
export const LEAF_PLACE = /* glsl */ `
struct Leaf {
  vec3 base;
  vec3 direction;
  vec3 normal;
};
/** What stands at the end \`b\` of a metamer with this heading, so far around it and in such a stance (LF5). */
Leaf givenAt(vec3 b, vec3 h, float azimuth, float stance) {
  float roll = floor(stance / 256.0);
  float away = (stance - 256.0 * roll) * 0.01231997;
  float turn = roll * 0.09817477;
  vec3 middle = (h + vec3(0, 1, 0)) * (1.0 / max(1e-6, 1.0 + h.y));
  vec3 u = normalize(vec3(1, 0, 0) - h.x * (h.y < -0.9999 ? h : middle));
  vec3 w = cross(u, h);
  vec3 aside = cos(azimuth) * u + sin(azimuth) * w;
  vec3 across = cos(azimuth) * w - sin(azimuth) * u;
  vec3 upper = sin(away) * h - cos(away) * aside;
  return Leaf(b, normalize(cos(away) * h + sin(away) * aside), normalize(cos(turn) * upper + sin(turn) * across));
}
/** Of the metamer from \`a\` to \`b\`, so far around it, at such a share of the way along and, if it is not below 0, in such a stance. */
Leaf leafAt(vec3 a, vec3 b, float azimuth, float share, float stance) {
  vec3 h = normalize(b - a);
  if (stance >= 0.0) return givenAt(b, h, azimuth, stance);
  vec3 u = normalize(abs(h.y) > 0.99 ? cross(h, vec3(1, 0, 0)) : cross(h, vec3(0, 1, 0)));
  vec3 w = cross(h, u);
  vec3 d = normalize(0.5 * h + 0.866 * (cos(azimuth) * u + sin(azimuth) * w) - vec3(0.0, 0.15, 0.0));
  vec3 upright = abs(d.y) > 0.99 ? h : vec3(0, 1, 0);
  return Leaf(mix(a, b, share), d, normalize(upright - dot(upright, d) * d));
}
`;

/** What a season and a look make of a leaf's shape; the server's exports compute the same. */
export const LEAF_SHAPE = /* glsl */ `
/** More numbers of a leaf's own, 0 to 1. */
vec4 ownNumbers(float random) { return fract(random * vec4(57.31, 131.7, 313.3, 709.9)); }
/** A leaf is there while its number lies below a share; where that nears it, it shrinks away. */
float presence(float share, float number) { return clamp((share * 1.08 - number) / 0.08, 0.0, 1.0); }
/** The size of a leaf that unfolds a little earlier than others, or later. */
float unfolding(float unfolded, float number) { return mix(unfolded, 1.0, 0.35 * number * (1.0 - unfolded)); }
/** How far the tip of a blade bows and its halves rise from the midrib, each leaf by its own measure. */
vec2 bending(float random, float own) { return vec2(mix(0.10, 0.38, random), mix(0.12, 0.45, own)); }
/** Where a leaf points that lies so far along its twig, and hangs or is raised. */
vec3 pointing(vec3 d, vec3 h, vec3 side, float lean, float turn) {
  vec3 lying = mix(d, h, lean);
  return normalize(mix(lying, vec3(0.0, sign(turn), 0.0), 0.92 * abs(turn)) + 1e-4 * side);
}
struct Blade { vec3 base; vec3 direction; vec3 normal; float size; float own; };
/** One of the blades that a leaf is divided into (LF6), in the leaf's length; it bends so far. */
Blade bladeOf(vec3 d, vec3 n, float random, float count, float number, float bend) {
  if (count < 1.5) return Blade(vec3(0.0, 0.0, 0.0), d, n, 1.0, random);
  float own = fract(random + 0.618034 * number);
  float open = number + 1.5 > count ? 0.25 : 1.15;
  float angle = 2.399963 * number + 6.2831853 * random;
  vec3 aside = cos(angle) * cross(d, n) + 0.55 * sin(angle) * n;
  vec3 way = normalize(d + open * aside - vec3(0.0, 0.4 * bend * own, 0.0));
  vec3 base = d * (0.05 + 0.8 * (number + 0.5) / count);
  return Blade(base, way, normalize(n - dot(n, way) * way), (0.82 + 0.36 * own) * inversesqrt(count), own);
}
`;

/** Cards that show a tile of an atlas: how they turn to the eye, and which part of the picture they show. */
export const CARD = /* glsl */ `
const float MARGIN = ${TILE_MARGIN.toFixed(4)};
const float SPRIG_REACH = ${SPRIG_REACH.toFixed(4)};
const float SPRIG_LEAVES = ${SPRIG_LEAVES.toFixed(1)};
/** Towards the viewer: the eye, or the sun while shadows are drawn. */
vec3 towardsEye(vec3 place) {
#ifdef CASTER
  return uSun;
#else
  return normalize(cameraPosition - place);
#endif
}
/** One of four pictures, as it is or mirrored. */
vec2 tileAt(vec2 at, float random, float mirror) {
  float tile = floor(random * 4.0);
  return (vec2(mod(tile, 2.0), floor(tile * 0.5)) + vec2(0.5 + 0.5 * mirror * at.x, at.y)) * 0.5;
}
`;

/** Pictures of single leaves, or of sprigs. */
const LEAF_SAMPLERS = /* glsl */ `
uniform vec4 uLeafForm;
#ifdef SPRIG
uniform sampler2D uSprigColour;
uniform sampler2D uSprigRelief;
// Leaves of a pixel or two stay apart, or a sprig would be a blot.
#define paintedAt(at) texture(uSprigColour, at, -1.0)
#define reliefAt(at) texture(uSprigRelief, at, -1.0)
#define aroundAt(at) texture(uSprigColour, at, 3.0).a
#else
uniform sampler2D uLeafColour; // half the brightness, second hue, sheerness, coverage
uniform sampler2D uLeafRelief; // normal across and along, wood, margin
uniform sampler2D uSprigColour;
uniform sampler2D uSprigRelief;
flat in float vTwig; // 1 where a leaf shows the picture of a sprig
vec4 paintedAt(vec2 at) {
  vec2 across = dFdx(at);
  vec2 up = dFdy(at);
  if (vTwig > 0.5) return textureGrad(uSprigColour, at, 0.5 * across, 0.5 * up);
  // Needles run together to lobes in a picture that is no finer than the card.
  float finer = exp2(-1.1 * uLeafForm.y);
  return textureGrad(uLeafColour, at, finer * across, finer * up);
}
/** How much is covered around a place. */
float aroundAt(vec2 at) { return vTwig > 0.5 ? texture(uSprigColour, at, 3.0).a : texture(uLeafColour, at, 3.0).a; }
vec4 reliefAt(vec2 at) {
  vec2 across = dFdx(at);
  vec2 up = dFdy(at);
  if (vTwig > 0.5) return textureGrad(uSprigRelief, at, 0.5 * across, 0.5 * up);
  return textureGrad(uLeafRelief, at, across, up);
}
#endif
`;

/** The colour of a leaf, in its middle and along its margin; the server's exports compute that of the middle. */
export const LEAF_COLOUR = /* glsl */ `
uniform vec4 uLeafForm; // half width, whether it is a spray, how far that lies along its twig, how much it bends
uniform vec4 uLeafSeason; // size, presence, fresh, turned
uniform vec4 uLeafTraits; // shift by vigor, orientation, withered
uniform vec3 uLeafTint;
// The colours of autumn, at first and at last, and of dead leaves.
uniform vec3 uLeafFirst;
uniform vec3 uLeafLast;
uniform vec3 uLeafDead;
const vec3 BRIGHTNESS = vec3(0.30, 0.59, 0.11);
struct Hues { vec3 middle; vec3 margin; };
/** Greens as they are seen outdoors: duller than the tint of a leaf, those of sprays somewhat bluer. */
vec3 natural(vec3 hue) {
  float green = clamp(2.0 * (hue.g - max(hue.r, hue.b)) / max(hue.g, 1e-3), 0.0, 1.0);
  vec3 dull = dot(hue, BRIGHTNESS) * mix(vec3(1.08, 1.02, 0.74), vec3(1.0, 1.22, 1.2), uLeafForm.y);
  return mix(hue, dull, 0.4 * green);
}
Hues leafHues(float vigor, float light, vec3 random) {
  // No two leaves are quite alike: lighter or darker, warmer or cooler; in the shade darker and bluer.
  // Sprays, which are many small leaves each, differ less.
  random = mix(random, vec3(0.5), 0.55 * uLeafForm.y);
  vec3 summer = uLeafTint * (0.80 + 0.40 * random.x) * mix(vec3(0.80, 0.88, 1.0), vec3(1.04, 1.02, 0.96), light);
  summer *= vec3(1.0 + 0.34 * (random.y - 0.5), 1.0, 1.0 - 0.40 * (random.y - 0.5));
  // Vigor is a share of the greatest there is, and most shoots have little of it.
  float weak = clamp(1.0 - smoothstep(0.0, 0.42, vigor) + 0.36 * (random.z - 0.5), 0.0, 1.0);
  float shift = uLeafTraits.x * weak * (1.0 - 0.5 * uLeafForm.y);
  float bright = dot(summer, BRIGHTNESS);
  vec3 warm = mix(vec3(1.36, 1.08, 0.24), vec3(1.95, 0.55, 0.14), smoothstep(0.35, 0.95, shift)) * bright;
  summer = mix(summer, warm, 0.9 * shift);
  summer = mix(summer, summer * vec3(1.55, 1.42, 0.85) + vec3(0.02, 0.03, 0.0), uLeafSeason.z);
  // Weak shoots turn first, and leaves in the sun turn reddest.
  float late = 0.55 * random.z + 0.30 * vigor + 0.15 * (1.0 - light);
  float turned = uLeafSeason.w * 1.5 - 0.25;
  float middle = smoothstep(late - 0.25, late + 0.25, turned - 0.12);
  float margin = smoothstep(late - 0.25, late + 0.25, turned + 0.16);
  float depth = clamp(0.75 * random.x + 0.5 * light - 0.3 + 0.3 * (1.0 - vigor), 0.0, 1.0);
  vec3 autumn = mix(uLeafFirst, uLeafLast, smoothstep(0.2, 0.9, depth)) * (0.82 + 0.36 * random.y);
  vec3 dead = uLeafDead * (0.7 + 0.5 * random.y);
  float died = clamp(uLeafTraits.z * 1.3 - 0.3 * random.z, 0.0, 1.0);
  Hues hues = Hues(mix(summer, autumn, middle), mix(summer, mix(autumn, uLeafLast, 0.3), margin));
  vec3 inner = mix(hues.middle, dead, died);
  vec3 outer = mix(hues.margin, dead, min(1.0, died * 1.4));
  return Hues(natural(inner), natural(outer));
}
`;

/** Texels of the numbers of a leaf, flower or fruit. */
export const LEAF_TEXELS = 2;

/** A leaf, flower or fruit as `row-instances.ts` lists it. */
export const BORNE = /* glsl */ `${itemsOf("sampler2D", LEAF_TEXELS)}
struct Borne {
  vec4 at; // row, parent's row, azimuth, share of the way along the metamer
  float tint; // a random number with the vigor above the point; below 0 where there is none
  float shoot; // a random number of the shoot's
  float stance; // below 0 for what stands by rule
  float length_; // in internodes, 0 for what the look says
};
Borne borne() {
  int number = itemNumber();
  if (number >= uItemsDrawn[0]) return Borne(vec4(0.0), -1.0, 0.0, -1.0, 0.0);
  ivec2 place = itemPlace(number);
  vec4 more = texelFetch(uItems, place + ivec2(1, 0), 0);
  return Borne(texelFetch(uItems, place, 0), more.x, more.y, more.z, more.w);
}
`;

/** What is known of the crown around a leaf, for its light; it is read where the leaf is placed. */
export interface Crown {
  readonly declared: string;
  readonly read: string;
}
export const NO_CROWN: Crown = { declared: "", read: "" };

/** Puts one leaf, or one spray of small ones, in its place. */
export const leafVertex = ({
  declared,
  read,
} = NO_CROWN) => /* glsl */ `${HEAD}${BORNE}${NODES}${TRAITS}${GHOST_PLACE}${LEAF_PLACE}
uniform vec3 uSun;
uniform float uLeafSize;
uniform vec3 uLeafLevel; // 0 near to 2 far, share of the leaves that are drawn, blades that each is divided into
uniform vec3 uLeafBand; // length of a leaf in pixels up to which all give way to sprigs, and from which none; how much sprigs swell
uniform float uSprigSpan; // leaves that a sprig is long
#ifndef SPRIG
uniform float uLeafTwig; // up to this length in pixels a leaf shows the picture of a sprig
flat out float vTwig;
#endif
in vec3 card; // across −1 to 1, along 0 to 1, which of the crossed ones and which blade
out vec3 vWorld;
out vec3 vNormal;
out vec4 vSide; // across the blade, and ±1 where the picture is mirrored
out vec2 vPicture;
out vec3 vMiddle;
out vec3 vMargin;
out vec2 vLight; // below 0 for what is marked; how open to the sky it is
out float vTrait;
const float SECONDS = 0.35;
const float BLADE_STEP = ${BLADE_STEP.toFixed(1)};
${CARD}${LEAF_SHAPE}${LEAF_COLOUR}${declared}
void main() {
  Borne own = borne();
  vec4 leaf = own.at;
  float tint = own.tint;
  if (tint < 0.0) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  Node node = nodeAt(int(leaf.x + 0.5));
  Node from = nodeAt(int(leaf.y + 0.5));
  float random = fract(tint);
  vec4 more = ownNumbers(random);
  // From afar single leaves give way to sprigs, one here and one there, until none is left.
  float usual = own.length_ > 0.0 ? own.length_ : uLeafSize;
  float length_ = usual * uView.w / max(0.1, distance(uView.xyz, node.position));
  float single = uLeafBand.y > 0.0 ? smoothstep(uLeafBand.x, uLeafBand.y, length_) : 1.0;
#ifdef SPRIG
  float share = 1.0 - single;
  float haste = 1.0;
#else
  float share = single;
  float haste = uLeafLevel.y;
#endif
  float there = presence(min(1.0, haste * float(uItemsDrawn[1])), more.w) * presence(share, fract(random * 1531.7));
  if (there <= 0.0 || node.look == HIDDEN || distance(node.position, from.position) < 1e-6) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  float vigor = floor(tint) / 15.0;
  float grown = eased(uTime - node.birth - node.growing * 0.6, SECONDS);
  float size = (own.length_ > 0.0 ? usual : (0.75 + 0.5 * random) * usual) * grown * there * inversesqrt(max(haste, 0.2));
  Leaf place = leafAt(from.position, node.position, leaf.z, leaf.w, own.stance);
  vec3 h = normalize(node.position - from.position);
  vec3 side = cross(place.direction, place.normal);
  vec3 d = pointing(place.direction, h, side, uLeafForm.z, uLeafTraits.y);
  side = normalize(side - dot(side, d) * d);
  float which = card.z;
#ifndef SPRIG
  float number = floor(which / BLADE_STEP);
  which -= BLADE_STEP * number;
  Blade blade = bladeOf(d, cross(side, d), random, uLeafLevel.z, number, uLeafForm.w);
  place.base += size * blade.base;
  d = blade.direction;
  side = cross(d, blade.normal);
  size *= blade.size;
  random = blade.own;
  more = ownNumbers(random);
#endif
  size *= presence(uLeafSeason.y, more.z) * unfolding(uLeafSeason.x, more.y);
  vec3 n = cross(side, d);
  float mirror = more.x > 0.5 ? 1.0 : -1.0;
  float across = card.x * uLeafForm.x * (1.0 + 2.0 * MARGIN);
  float along = card.y * (1.0 + 2.0 * MARGIN) - MARGIN;
  float pixels = size * uView.w / max(0.1, distance(uView.xyz, place.base));
#ifdef SPRIG
  // Its middle is where that of the leaf would be.
  // Single leaves about as small as a pixel seem larger than they are.
  float span = uSprigSpan * uLeafBand.z * mix(1.35, 1.0, smoothstep(1.0, 3.8, length_)) * (1.0 + 2.0 * MARGIN);
  along = (card.y - 0.5) * span + 0.5;
  across = card.x * SPRIG_REACH * span;
#else
  // A twig with the picture of a sprig covers as much as one leaf.
  vTwig = pixels < uLeafTwig ? 1.0 : 0.0;
  if (vTwig > 0.5) {
    float span = uSprigSpan * inversesqrt(SPRIG_LEAVES) * (1.0 + 2.0 * MARGIN);
    along = (card.y - 0.5) * span + 0.5;
    across = card.x * SPRIG_REACH * span;
  }
#endif
  vec3 world = place.base;
  vec3 lengthwise = d;
  if (uLeafForm.y > 0.5) {
    vec3 eye = towardsEye(place.base);
    vec3 facing = normalize(cross(d, eye) + 1e-4 * side);
    float far = max(step(1.5, uLeafLevel.x), 1.0 - smoothstep(12.0, 30.0, pixels));
#if defined(CASTER) || defined(SPRIG)
    far = 1.0;
#endif
    float angle = 1.0472 * which + 6.2832 * more.y;
    vec3 fixed_ = cos(angle) * side + sin(angle) * n;
    facing *= dot(facing, fixed_) < 0.0 ? -1.0 : 1.0;
    side = which < 0.5 ? normalize(mix(fixed_, facing, far)) : fixed_;
    across *= which < 0.5 ? 1.0 : 1.0 - far;
    // Needles stand all around: the further out, the more they look to the side.
    n = cross(side, d);
    // What is above in a spray sees more of the sky than what is below.
    vec3 out_ = d * (along - 0.5) + side * across;
    n = normalize((dot(n, eye) < 0.0 ? -n : n) + side * card.x * 0.9 + vec3(0.0, 0.3 + 1.2 * out_.y, 0.0));
    world += size * (d * along + side * across - vec3(0.0, 0.10 * uLeafForm.w * along * along, 0.0));
  } else {
    float roll = (more.y - 0.5) * 0.9;
    vec3 level = n;
    n = cos(roll) * n + sin(roll) * side;
    side = cos(roll) * side - sin(roll) * level;
    // The tip bows, each leaf by its own measure, and the halves rise from the midrib; far off this is left out.
    float near = smoothstep(7.0, 22.0, pixels) * uLeafForm.w;
#if defined(CASTER) || defined(SPRIG)
    near = 0.0;
#else
    near *= 1.0 - vTwig;
#endif
    vec2 bent = bending(random, more.w) * near;
    float bow = bent.x;
    float fold = bent.y;
    world += size * (d * (along - 0.12 * bow * along * along) + side * across
      + n * (abs(across) * fold - bow * along * along));
    lengthwise = normalize(d - n * 2.0 * bow * along);
    n = normalize(cross(normalize(side + n * fold * card.x), lengthwise));
  }
  vWorld = world;
  vNormal = n;
  vSide = vec4(side, mirror);
  vPicture = tileAt(card.xy, more.x * 2.0 - step(0.5, more.x), mirror);
  // Leaves of one shoot are more alike than those of others.
  vec3 own_ = vec3(random, more.y, more.w);
#ifndef SPRIG
  // Several leaves in one picture differ less from the next several.
  own_ = mix(own_, vec3(0.5), 0.5 * vTwig);
#endif
  Hues hues = leafHues(vigor, node.light, mix(own_, ownNumbers(own.shoot).xyz, 0.6));
  vec3 dye = uDyes[${DYES} + node.dye];
  vMiddle = hues.middle * dye;
  vMargin = hues.margin * dye;
  // The outer half of a leaf sees more of the sky than where it is hidden by its twig, or by other needles.
  vLight = vec2(node.look == MARKED ? -1.0 : node.light, mix(mix(0.72, 0.8, uLeafForm.y), 1.0, card.y));
#ifdef SPRIG
  vLight.y = 0.86;
#endif
  vTrait = traitOf(int(leaf.x + 0.5));
${read}
#ifdef GHOST
  vWorld = world = ghostPlace(world);
  vNormal = turned(uGhostTurn, vNormal);
  vSide.xyz = turned(uGhostTurn, vSide.xyz);
#endif
  gl_Position = projectionMatrix * viewMatrix * vec4(world, 1.0);
}
`;

/** Where a picture ends, and what is drawn of its edge. */
export const EDGE = /* glsl */ `
/** How much of a pixel is inside, from what the picture says of its middle and how that changes from pixel to pixel. */
float edgeOf(float covered, vec2 slope) {
  float inside = covered - 0.5;
  float width = 0.7 * length(slope);
  // What is mostly covered is solid, or leaves seen at a slant would let through what is behind them.
  return clamp(max(inside / max(width, 1e-4) + 0.5, 4.0 * inside), 0.0, 1.0);
}
/** Least that must be there to be drawn, of a grain between 0 and 1 and for a picture so many pixels long. */
float leastOf(float grain, float pixels) {
  // The edge of what is large is a line, and would only be frayed.
  return 0.5 + (2.0 * grain - 1.0) * mix(0.45, 0.15, smoothstep(6.0, 12.0, pixels));
}
`;

/** Whether there is anything at a place of a picture, with an edge one pixel wide however large it is drawn. */
export const CUT = /* glsl */ `${COVER}${EDGE}
float cut(float covered) { return edgeOf(covered, vec2(dFdx(covered), dFdy(covered))); }
/** Least that must be there to be drawn; \`picture\` is the place in an atlas of two tiles a side. */
float leastAt(vec2 picture, vec3 place) {
  if (uSamples > 1) return 0.12;
  return leastOf(grainAt(place), 0.5 / max(length(dFdx(picture)), length(dFdy(picture))));
}
`;

/** For shadows: what the picture leaves out lets the sun through. */
export const LEAF_DEPTH_FRAGMENT = /* glsl */ `${HEAD}${DEPTH_COLOUR}
${LEAF_SAMPLERS}
in vec2 vPicture;
out vec4 colour;
void main() {
  if (paintedAt(vPicture).a < 0.5) discard;
  colour = depthColour();
}
`;

/** Light on something thin, seen from both sides: what the sun does not reflect from one shines through to the other. */
export const THIN_LIGHT = /* glsl */ `
vec3 thinLit(vec3 albedo, vec3 normal, vec3 sight, vec3 world, float sheer, float gloss, float exposure, float open) {
  float facing = dot(normal, uSun);
  // Some sun always finds its way through a crown, from leaf to leaf.
  float sun = mix(0.10, 1.0, sunAt(world + uSun * (0.12 + uShadowSize), 1.4));
  float reflected = max(0.0, (facing + 0.25) / 1.25);
  float through = sheer * (max(0.0, 0.15 - facing) * 0.85 + 0.5 * pow(max(0.0, -dot(sight, uSun)), 4.0));
  vec3 sieved = albedo * (0.35 + 2.4 * albedo / max(max(albedo.r, albedo.g), 0.02)) * vec3(0.62, 0.60, 0.36);
  // Deep in a crown there is little of the sky, and what comes from behind a leaf shines through it.
  float shade = mix(0.24, 1.08, exposure) * open * mix(0.62, 1.1, sunAround(world));
  vec3 lit = albedo * (ambient(normal) * 1.35 * shade + SUN_COLOUR * reflected * sun);
  lit += sieved * (SUN_COLOUR * through * sun + ambient(-normal) * sheer * 0.8 * shade);
  float shine = pow(max(0.0, dot(normal, normalize(sight + uSun))), 24.0) * sun;
  return lit + (SUN_COLOUR * shine * 0.06 + SKY_COLOUR * 0.03 * shade * pow(1.0 - abs(dot(normal, sight)), 3.0)) * gloss;
}
`;

/** A leaf as its picture shows it. */
export const leafFragment = (light = THIN_LIGHT) => /* glsl */ `${HEAD}${LIGHT}${MODES}${GHOST_COLOUR}${CUT}${light}
${LEAF_SAMPLERS}
in vec3 vWorld;
in vec3 vNormal;
in vec4 vSide;
in vec2 vPicture;
in vec3 vMiddle;
in vec3 vMargin;
in vec2 vLight;
in float vTrait;
out vec4 colour;
const vec3 TWIG = vec3(0.150, 0.095, 0.055);
const vec4 FLAT_BLADE = vec4(128.0 / 255.0, 128.0 / 255.0, 0.0, 0.0);

void main() {
  vec4 painted = paintedAt(vPicture);
  vec3 face = facet(vWorld, normalize(cameraPosition - vWorld));
#ifdef SPRIG
  // Of a leaf that is hardly a pixel long there is no edge to be seen.
  float there = clamp(1.6 * (painted.a - 0.5) + 0.5, 0.0, 1.0);
#else
  float there = cut(painted.a);
#endif
  if (uLeafForm.y > 0.5) {
    // Needles thinner than a pixel: lines that point ahead and out, each of its own brightness, some of them gaps.
    float pixel = max(length(dFdx(vPicture)), length(dFdy(vPicture)));
    float thin = smoothstep(0.003, 0.010, pixel);
    vec2 tile = fract(2.0 * vPicture);
    float off = abs(tile.x - 0.5);
    vec2 line = vec2(off - 0.6 * tile.y, 0.28 * (tile.y + 0.6 * off));
    vec2 cell = floor(line / (1.25 * exp2(ceil(log2(max(pixel, 1e-5)) - 0.5)))) + 16.0 * floor(2.0 * vPicture);
    vec2 grain = fract(sin(vec2(dot(cell, vec2(12.9898, 78.233)), dot(cell, vec2(39.346, 11.135)))) * 43758.5453);
    there = mix(there, clamp(1.5 * painted.a + grain.x - 0.65, 0.0, 1.0), thin);
    painted.r *= 1.0 + thin * (grain.y - 0.15);
    painted.g = mix(painted.g, 1.0, thin * 0.6 * smoothstep(0.75, 1.0, grain.y));
  }
#ifdef GHOST
  if (painted.a < 0.5) discard;
#else
  if (there < leastAt(vPicture, vWorld)) discard;
#endif
  vec4 relief = reliefAt(vPicture);
  if (uShown.z < 0.5) {
    painted = vec4(0.5, 0.0, painted.ba);
    relief = FLAT_BLADE;
  }
  vec3 eye = cameraPosition - vWorld;
  float away = length(eye);
  vec3 sight = eye / max(away, 1e-4);
  vec3 up = normalize(vNormal);
  vec3 side = normalize(vSide.xyz - dot(vSide.xyz, up) * up);
  vec2 slope = (relief.xy * 255.0 - 128.0) / 127.0;
  vec3 normal = normalize(up + slope.x * vSide.w * side + slope.y * cross(up, side));
  if (dot(up, sight) < 0.0) normal = -normal;
  if (uShown.y < 0.5) normal = face;

  vec3 albedo = mix(vMiddle, vMargin, relief.a);
  vec3 second = mix(albedo * 1.15 + vec3(0.035, 0.035, 0.006), albedo * vec3(1.30, 1.35, 0.95), uLeafForm.y);
  albedo = mix(albedo, second, painted.g) * painted.r * 2.0;
  albedo = mix(albedo, TWIG * painted.r * 2.0, relief.b);
  // The lower side is paler and duller.
  float below = gl_FrontFacing ? 0.0 : 1.0 - uLeafForm.y;
  albedo = mix(albedo, vec3(dot(albedo, vec3(0.33))) * 1.1 + 0.012, 0.28 * below);
  if (vLight.x < 0.0) albedo = condemned(albedo);
  vec3 lit = thinLit(albedo, normal, sight, vWorld, painted.b, 1.0 - 0.7 * below, abs(vLight.x), vLight.y);
  colour = vec4(shownAs(finished(hazed(lit, away)), albedo, vTrait, dot(normal, sight)), there);
#ifdef GHOST
  colour = ghostly(vec4(colour.rgb, 1.0));
#endif
}
`;
