import { METAMER_TEXELS } from "./branch";
import { HEAD, NODES } from "./common";
import { itemsOf } from "./items";

/** A strip as wide as a line, from a metamer's parent to where it ends. */
export const SKELETON_VERTEX = /* glsl */ `${HEAD}${itemsOf("usampler2D", METAMER_TEXELS)}${NODES}
in vec2 strip; // across −1 to 1, along 0 or 1
uniform vec2 uPicture; // the picture's size in pixels
uniform float uLine; // a line's width in pixels
out float vAcross;
out float vStrength;
void main() {
  int number = itemNumber();
  if (number >= uItemsDrawn[0]) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  uvec4 metamer = texelFetch(uItems, itemPlace(number), 0);
  Node end = nodeAt(int(metamer.x));
  Node start = nodeAt(int(metamer.y));
  if (end.look == HIDDEN) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  mat4 clip = projectionMatrix * viewMatrix;
  float grown = eased(uTime - end.birth, end.growing);
  vec4 a = clip * vec4(start.position, 1.0);
  vec4 b = clip * vec4(mix(start.position, end.position, grown), 1.0);
  if (min(a.w, b.w) < 0.02) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  vec2 way = (b.xy / b.w - a.xy / a.w) * uPicture;
  vec2 aside = dot(way, way) > 1e-6 ? normalize(vec2(-way.y, way.x)) : vec2(1, 0);
  // Limbs are drawn a little bolder than twigs: the eye finds the axes then.
  float bold = clamp(2.5 * end.radius, 0.0, 1.0);
  float width = uLine * mix(1.0, 2.6, bold) + 1.0;
  vec4 place = strip.y > 0.5 ? b : a;
  place.xy += aside * strip.x * width / uPicture * place.w;
  vAcross = 0.5 * strip.x * width;
  vStrength = 0.5 * width;
  gl_Position = place;
}
`;

/** Ink with soft edges. */
export const SKELETON_FRAGMENT = /* glsl */ `precision highp float;
in float vAcross;
in float vStrength;
uniform vec3 uInk;
out vec4 colour;
void main() {
  float cover = clamp(vStrength - abs(vAcross), 0.0, 1.0);
  colour = vec4(uInk, cover);
}
`;
