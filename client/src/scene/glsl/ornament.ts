import { HEAD, LIGHT, NODES } from "./common";
import { MODES, TRAITS } from "./draw-mode";
import { BORNE, CARD, CUT, LEAF_PLACE, NO_CROWN, THIN_LIGHT } from "./leaf";
import { DEPTH_COLOUR } from "./shadow";

/** What makes a flower or fruit differ from others of its kind; the server's exports compute the same. */
export const ORNAMENT_SHAPE = /* glsl */ `
/** How large it is beside the middle size. */
float ornamentSize(float random) { return mix(0.82, 1.18, random); }
/** Where it points that hangs or stands upright so far, from where a leaf would. */
vec3 ornamentAxis(vec3 direction, float hang, vec3 more) {
  return normalize(mix(direction, vec3(0.0, sign(hang), 0.0), abs(hang)) + 0.16 * (more - vec3(0.5)));
}
vec3 ornamentHue(vec3 tint, vec3 more) {
  return tint * (0.86 + 0.28 * more.z) * vec3(1.0 + 0.10 * (more.y - 0.5), 1.0, 1.0 - 0.08 * (more.y - 0.5));
}
`;

/** Puts one flower or fruit at the surface of the wood that bears it. */
export const ornamentVertex = (
  name: "Flower" | "Fruit",
  { declared, read } = NO_CROWN,
) => /* glsl */ `${HEAD}${BORNE}${NODES}${TRAITS}${LEAF_PLACE}
uniform vec3 uSun;
uniform vec4 u${name}Form; // half width, hanging to upright, turned to the eye or a disc, stalk
uniform vec4 u${name}Finish; // size, gloss, how much larger all are because not all are drawn
uniform vec3 u${name}Tint;
in vec3 card;
out vec3 vWorld;
out vec3 vNormal;
out vec4 vSide; // across the card, and ±1 where the picture is mirrored
out vec2 vPicture;
out vec3 vMiddle;
out float vLight; // below 0 for what is marked
out float vTrait;
const float SECONDS = 0.5;
${CARD}${ORNAMENT_SHAPE}${declared}
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
  if (node.look == HIDDEN || distance(node.position, from.position) < 1e-6) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  float random = fract(tint);
  vec3 more = fract(random * vec3(57.31, 131.7, 313.3));
  float length_ = own.length_ > 0.0 ? own.length_ * u${name}Finish.z : u${name}Finish.x * ornamentSize(random);
  float size = length_ * eased(uTime - node.birth - node.growing, SECONDS);
  Leaf place = leafAt(from.position, node.position, leaf.z, leaf.w, own.stance);
  vec3 h = normalize(node.position - from.position);
  vec3 outward = normalize(place.direction - dot(place.direction, h) * h + 1e-4 * place.normal);
  vec3 base = place.base + outward * node.radius * 0.9;
  vec3 eye = towardsEye(base);
  float hang = u${name}Form.y;
  vec3 axis = ornamentAxis(place.direction, hang, more);
  float stalk = own.stance < 0.0 ? u${name}Form.w : 0.0;
  float mirror = more.x > 0.5 ? 1.0 : -1.0;
  float across = card.x * u${name}Form.x * (1.0 + 2.0 * MARGIN);
  float along = card.y * (1.0 + 2.0 * MARGIN) - MARGIN;
  vec3 side;
  vec3 n;
  vec3 world;
  if (u${name}Form.z < 0.0) {
    // A disc looks outward and up, and a little towards the eye, so that none is seen from its edge.
    n = normalize(axis + 0.55 * eye);
    side = normalize(cross(abs(n.y) > 0.95 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0), n));
    float spin = 6.2832 * more.y;
    vec3 lengthwise = cross(n, side);
    vec3 turnedSide = cos(spin) * side + sin(spin) * lengthwise;
    side = turnedSide;
    world = base + size * (axis * stalk + side * across + cross(n, side) * (along - 0.5));
  } else {
    vec3 across_ = cross(axis, eye);
    // Seen along its axis it turns further, for it is as thick as it is broad.
    vec3 lengthwise = normalize(axis - u${name}Form.z * dot(axis, eye) * eye);
    side = normalize(across_ + 1e-4 * place.normal);
    n = normalize(cross(side, lengthwise));
    n *= dot(n, eye) < 0.0 ? -1.0 : 1.0;
    world = base + size * (axis * stalk + lengthwise * along + side * across);
  }
  vWorld = world;
  vNormal = n;
  vSide = vec4(side, mirror);
  vPicture = tileAt(card.xy, more.x * 2.0 - step(0.5, more.x), mirror);
  vMiddle = ornamentHue(u${name}Tint, more);
  vLight = node.look == MARKED ? -1.0 : node.light;
  vTrait = traitOf(int(leaf.x + 0.5));
${read}
  gl_Position = projectionMatrix * viewMatrix * vec4(world, 1.0);
}
`;

/** For their shadows. */
export const ornamentDepthFragment = (name: "Flower" | "Fruit") => /* glsl */ `${HEAD}${DEPTH_COLOUR}
uniform sampler2D u${name}Colour;
in vec2 vPicture;
out vec4 colour;
void main() {
  if (texture(u${name}Colour, vPicture).a < 0.5) discard;
  colour = depthColour();
}
`;

/** A flower or fruit as its picture shows it. */
export const ornamentFragment = (
  name: "Flower" | "Fruit",
  light = THIN_LIGHT,
) => /* glsl */ `${HEAD}${LIGHT}${MODES}${CUT}${light}
uniform sampler2D u${name}Colour; // half the brightness, second colour, sheerness, coverage
uniform sampler2D u${name}Relief; // normal across and along, stalk
uniform vec4 u${name}Finish;
uniform vec3 u${name}Second;
in vec3 vWorld;
in vec3 vNormal;
in vec4 vSide;
in vec2 vPicture;
in vec3 vMiddle;
in float vLight;
in float vTrait;
out vec4 colour;
const vec3 STALK = vec3(0.130, 0.130, 0.045);

void main() {
  vec4 painted = texture(u${name}Colour, vPicture);
  vec3 face = facet(vWorld, normalize(cameraPosition - vWorld));
  float there = cut(painted.a);
  if (there < leastAt(vPicture, vWorld)) discard;
  vec4 relief = texture(u${name}Relief, vPicture);
  if (uShown.z < 0.5) {
    painted = vec4(0.5, 0.0, painted.ba);
    relief = vec4(128.0 / 255.0, 128.0 / 255.0, 0.0, 0.0);
  }
  vec3 eye = cameraPosition - vWorld;
  float away = length(eye);
  vec3 sight = eye / max(away, 1e-4);
  vec3 up = normalize(vNormal);
  vec3 side = normalize(vSide.xyz - dot(vSide.xyz, up) * up);
  vec3 lengthwise = cross(up, side);
  vec2 slope = (relief.xy * 255.0 - 128.0) / 127.0;
  float steep = sqrt(max(0.05, 1.0 - min(0.95, dot(slope, slope))));
  vec3 normal = normalize(up * steep + slope.x * vSide.w * side + slope.y * lengthwise);
  if (dot(up, sight) < 0.0) normal = -normal;
  if (uShown.y < 0.5) normal = face;
  vec3 albedo = mix(vMiddle, u${name}Second, painted.g) * painted.r * 2.0;
  albedo = mix(albedo, STALK * painted.r * 2.0, relief.b);
  if (vLight < 0.0) albedo = condemned(albedo);
  vec3 lit = thinLit(albedo, normal, sight, vWorld, painted.b, u${name}Finish.y, mix(0.35, 1.0, abs(vLight)), 1.0);
  colour = vec4(shownAs(finished(hazed(lit, away)), albedo, vTrait, dot(normal, sight)), there);
}
`;
