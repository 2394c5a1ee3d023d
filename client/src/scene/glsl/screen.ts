import { DITHER } from "./common";

/** A triangle over the whole picture. */
export const SCREEN_VERTEX = /* glsl */ `
in vec3 position;
void main() { gl_Position = vec4(position, 1.0); }
`;

/**
 * Shows a picture of fewer pixels, or of as many, and what it comes over. It is opaque whatever was drawn: the page behind
 * the canvas must not shine through the edges of leaves.
 */
export const SCREEN_FRAGMENT = /* glsl */ `
precision highp float;
uniform sampler2D uPicture;
uniform sampler2D uBefore;
uniform vec2 uShown; // pixels that are shown, across and down
uniform float uShare;
out vec4 colour;
${DITHER}
/** Catmull-Rom in five looks (after J. Jimenez, 2016): as sharp as the picture is, without steps at its edges. */
vec3 enlarged(vec2 size) {
  vec2 at = gl_FragCoord.xy / uShown * size;
  vec2 middle = floor(at - 0.5) + 0.5;
  vec2 f = at - middle;
  vec2 before = f * (-0.5 + f * (1.0 - 0.5 * f));
  vec2 own = 1.0 + f * f * (-2.5 + 1.5 * f);
  vec2 next = f * (0.5 + f * (2.0 - 1.5 * f));
  vec2 after = f * f * (-0.5 + 0.5 * f);
  vec2 both = own + next;
  vec2 a = (middle - 1.0) / size;
  vec2 b = (middle + next / both) / size;
  vec2 c = (middle + 2.0) / size;
  float left = before.x * both.y;
  float right = after.x * both.y;
  float low = both.x * before.y;
  float high = both.x * after.y;
  float inner = both.x * both.y;
  vec3 sum = inner * texture(uPicture, b).rgb
    + left * texture(uPicture, vec2(a.x, b.y)).rgb + right * texture(uPicture, vec2(c.x, b.y)).rgb
    + low * texture(uPicture, vec2(b.x, a.y)).rgb + high * texture(uPicture, vec2(b.x, c.y)).rgb;
  return clamp(sum / (inner + left + right + low + high), 0.0, 1.0);
}
void main() {
  vec2 size = vec2(textureSize(uPicture, 0));
  vec3 picture = size == uShown ? texelFetch(uPicture, ivec2(gl_FragCoord.xy), 0).rgb : dithered(enlarged(size));
  if (uShare < 1.0) picture = mix(texture(uBefore, gl_FragCoord.xy / uShown).rgb, picture, uShare);
  colour = vec4(picture, 1.0);
}
`;
