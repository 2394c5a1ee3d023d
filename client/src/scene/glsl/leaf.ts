import { HEAD, LIGHT, NODES } from "./common";
import { GHOST_COLOUR, GHOST_PLACE } from "./ghost";

/** Where rules LF1–LF4 put a leaf, from where its metamer is drawn. */
export const LEAF_PLACE = /* glsl */ `
struct Leaf {
  vec3 base;
  vec3 direction;
  vec3 normal;
};
/** Of the metamer from \`a\` to \`b\`, so far around it and at such a share of the way along. */
Leaf leafAt(vec3 a, vec3 b, float azimuth, float share) {
  vec3 h = normalize(b - a);
  vec3 u = normalize(abs(h.y) > 0.99 ? cross(h, vec3(1, 0, 0)) : cross(h, vec3(0, 1, 0)));
  vec3 w = cross(h, u);
  vec3 d = normalize(0.5 * h + 0.866 * (cos(azimuth) * u + sin(azimuth) * w) - vec3(0.0, 0.15, 0.0));
  vec3 upright = abs(d.y) > 0.99 ? h : vec3(0, 1, 0);
  return Leaf(mix(a, b, share), d, normalize(upright - dot(upright, d) * d));
}
`;

/** Puts one blade in its place, folded along its midrib and bent towards its tip. */
export const LEAF_VERTEX = /* glsl */ `${HEAD}${NODES}${GHOST_PLACE}${LEAF_PLACE}
in vec3 blade; // across −1 to 1, along 0 to 1, half width there
in vec4 leaf; // row, parent's row, azimuth, share of the way along the metamer
in float tint; // a random number with the vigor above the point; below 0 where there is no leaf
uniform float uLeafSize;
const float SECONDS = 0.35;
out vec3 vWorld;
out vec3 vNormal;
out vec2 vBlade;
out vec3 vTint; // random, vigor, light or, below 0, that it is marked

void main() {
  Node node = nodeAt(int(leaf.x + 0.5));
  Node from = nodeAt(int(leaf.y + 0.5));
  if (tint < 0.0 || node.look == HIDDEN || distance(node.position, from.position) < 1e-6) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  float grown = eased(uTime - node.birth - node.growing * 0.6, SECONDS);
  float random = fract(tint);
  float size = (0.75 + 0.5 * random) * uLeafSize * grown;
  Leaf place = leafAt(from.position, node.position, leaf.z, leaf.w);
  vec3 d = place.direction;
  vec3 n = place.normal;
  vec3 side = cross(d, n);
  float along = blade.y;
  // The tip bows, each leaf by its own measure, and the halves rise from the midrib.
  float bow = mix(0.12, 0.42, random);
  float fold = mix(0.18, 0.45, fract(random * 7.0));
  float across = blade.x * blade.z;
  vec3 world = place.base + size * (
    d * (along - 0.12 * bow * along * along) + side * across * 1.05
    + n * (abs(across) * fold - bow * along * along));
  vWorld = world;
  vec3 lengthwise = normalize(d - n * 2.0 * bow * along);
  vec3 crosswise = normalize(side + n * fold * sign(blade.x) * min(1.0, abs(blade.x) * 4.0));
  vNormal = normalize(cross(crosswise, lengthwise));
  vBlade = vec2(blade.x, along);
  vTint = vec3(random, floor(tint) / 15.0, node.look == MARKED ? -1.0 : node.light);
#ifdef GHOST
  vWorld = world = ghostPlace(world);
  vNormal = turned(uGhostTurn, vNormal);
#endif
  gl_Position = projectionMatrix * viewMatrix * vec4(world, 1.0);
}
`;

/** A blade lit from both sides; what the sun does not reflect from one shines through to the other. */
export const LEAF_FRAGMENT = /* glsl */ `${HEAD}${LIGHT}${GHOST_COLOUR}
in vec3 vWorld;
in vec3 vNormal;
in vec2 vBlade;
in vec3 vTint;
out vec4 colour;

void main() {
  vec3 eye = cameraPosition - vWorld;
  float away = length(eye);
  vec3 sight = eye / max(away, 1e-4);
  vec3 normal = normalize(vNormal);
  if (dot(normal, sight) < 0.0) normal = -normal;
  float random = vTint.x;
  float vigor = vTint.y;
  float exposure = abs(vTint.z);

  vec3 deep = vec3(0.052, 0.115, 0.030);
  vec3 fresh = vec3(0.115, 0.190, 0.032);
  float freshness = clamp(0.1 + 0.4 * vigor + 0.7 * (random - 0.5) + 0.3 * exposure, 0.0, 1.0);
  vec3 albedo = mix(deep, fresh, freshness);
  albedo = mix(albedo, vec3(0.20, 0.18, 0.035), smoothstep(0.90, 1.0, random) * 0.45);
  if (vTint.z < 0.0) albedo = condemned(albedo);
  float detail = 1.0 - smoothstep(14.0, 45.0, away);
  float rib = 1.0 - smoothstep(0.0, 0.09, abs(vBlade.x));
  float veins = abs(fract(vBlade.y * 6.5 - abs(vBlade.x) * 1.5) - 0.5) * 2.0;
  albedo *= 1.0 + detail * (0.32 * rib + 0.10 * (smoothstep(0.7, 1.0, veins) - 0.2) + 0.12 * (0.5 - abs(vBlade.x)));

  float facing = dot(normal, uSun);
  // Some sun always finds its way through a crown, from leaf to leaf.
  float sun = mix(0.14, 1.0, sunlit(vWorld, uSun * 3.0, 1.4));
  float reflected = max(0.0, (facing + 0.2) / 1.2);
  float through = max(0.0, -facing + 0.1) * 0.62 + 0.35 * pow(max(0.0, -dot(sight, uSun)), 4.0);
  vec3 transmitted = albedo * vec3(1.35, 1.25, 0.5);
  float open = mix(0.55, 1.0, exposure);
  vec3 lit = albedo * (ambient(normal) * 1.5 * open + SUN_COLOUR * reflected * sun) + transmitted * SUN_COLOUR * through * sun;
  float gloss = pow(max(0.0, dot(normal, normalize(sight + uSun))), 20.0);
  lit += SUN_COLOUR * gloss * sun * 0.035;
  colour = vec4(finished(hazed(lit, away)), 1.0);
#ifdef GHOST
  colour = ghostly(colour);
#endif
}
`;
