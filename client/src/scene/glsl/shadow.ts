/** Depth as a colour, for those who cannot read depth: 1 nearest to the sun, 0 where nothing is. */
export const DEPTH_COLOUR = /* glsl */ `
vec4 depthColour() {
  float steps = floor((1.0 - gl_FragCoord.z) * 65535.0);
  return vec4(floor(steps / 256.0), mod(steps, 256.0), 0.0, 255.0) / 255.0;
}
`;

/** Of what casts a shadow everywhere. */
export const DEPTH_FRAGMENT = /* glsl */ `precision highp float;
${DEPTH_COLOUR}
out vec4 colour;
void main() { colour = depthColour(); }
`;

export const SHADE_VERTEX = /* glsl */ `
in vec3 position;
void main() { gl_Position = vec4(position, 1.0); }
`;

/** What keeps the sun from the ground: how much of each place, and how far above the ground it stands. */
export const SHADE_FRAGMENT = /* glsl */ `
precision highp float;
uniform sampler2D uDepths;
uniform vec4 uGroundDepth; // depth of the ground across, up and at the map's corner; internodes that one depth is
uniform float uShadeFar; // how far above the ground, in internodes, counts as farthest
out vec4 colour;
void main() {
  ivec2 size = textureSize(uDepths, 0);
  ivec2 first = ivec2(gl_FragCoord.xy) * 2;
  vec2 sum = vec2(0.0);
  for (int i = 0; i < 4; i++) {
    ivec2 at = min(first + ivec2(i & 1, i >> 1), size - 1);
    vec4 packed = texelFetch(uDepths, at, 0);
    float depth = 1.0 - dot(packed.rg, vec2(65280.0, 255.0)) / 65535.0;
    vec2 place = (vec2(at) + 0.5) / vec2(size);
    float above = (dot(uGroundDepth.xy, place) + uGroundDepth.z - depth) * uGroundDepth.w;
    // What is below the ground, as roots are, shades nothing.
    if (packed.r + packed.g > 0.0 && above > 0.02) sum += vec2(1.0, sqrt(min(1.0, above / uShadeFar)));
  }
  colour = vec4(sum / 4.0, 0.0, 1.0);
}
`;

/** The sun on the ground: the further above it what shades it, the softer the edge. After \`LIGHT\`. */
export const GROUND_SUN = /* glsl */ `
uniform sampler2D uShade;
uniform vec2 uShadeScale; // texels an internode is wide, and \`uShadeFar\`
uniform float uSunSpread;
float groundSun(vec3 world) {
  if (uShadowTaps == 0) return 1.0;
  vec2 at = (uSunFromWorld * vec4(world, 1.0)).xy * 0.5 + 0.5;
  vec2 edge = smoothstep(vec2(0.0), vec2(0.03), at) * smoothstep(vec2(0.0), vec2(0.03), 1.0 - at);
  float inside = edge.x * edge.y;
  if (inside <= 0.0) return 1.0;
  // What shades a place is looked for as far around as the widest penumbra reaches.
  float widest = log2(max(1.0, 0.3 * uShadeScale.y * uSunSpread * uShadeScale.x));
  vec2 around = textureLod(uShade, at, max(4.5, widest)).rg * 0.6 + textureLod(uShade, at, max(6.0, widest + 1.2)).rg * 0.4;
  if (around.x < 0.0002) return 1.0;
  float above = around.y / around.x;
  float width = max(1.0, above * above * uShadeScale.y * uSunSpread * uShadeScale.x);
  float level = max(0.0, log2(width) - 1.0);
  vec2 reach = width / vec2(textureSize(uShade, 0));
  int taps = uShadowTaps == 1 ? 5 : 20;
  float sum = 0.0;
  float weights = 0.0;
  for (int i = 0; i < 20; i++) {
    if (i >= taps) break;
    float off = sqrt((float(i) + 0.5) / float(taps)) * 1.7;
    float turn = 2.39996 * float(i);
    float weight = exp(-0.9 * off * off);
    sum += weight * textureLod(uShade, at + reach * off * vec2(cos(turn), sin(turn)), level).r;
    weights += weight;
  }
  return 1.0 - inside * min(1.0, sum / weights);
}
`;
