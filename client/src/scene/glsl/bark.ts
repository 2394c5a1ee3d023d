import { BARK_BEGINS, BARK_SQUARES, LIMB_ENDS, THINNEST_BARK } from "../../wire/generated";
import { MOST_SHADE, MOST_SLOPE } from "../painting/measures";

/** The bark of a place on a limb, from the textures of \`bark.ts\`. */
export const BARK = /* glsl */ `
uniform sampler2D uBarkColours;
uniform sampler2D uBarkRelief;
uniform vec3 uBarkPalette[5]; // the bark's three colours on a trunk, that of twigs, and what limbs have for the first
uniform vec4 uBarkShape; // relief, root flare, collar, smoothing
struct Bark {
  vec3 albedo;
  vec2 slope; // how the surface rises around and along
  float cavity; // how much of the sky it sees
  float height; // 0 in the deepest furrow to 1 on the highest ridge
};
const float THINNEST = ${THINNEST_BARK}; // radius of the first octave, in internodes
/** Squares around a limb: bark coarsens as a limb thickens, and then there is more of it. */
float squaresAround(float octave) {
  return float(int[](${BARK_SQUARES.join(", ")})[int(octave + 0.5)]);
}
/** Colours' shares and height, relief. Squares fit around the limb a whole number of times, so there is no seam. */
void squareAt(vec2 at, vec2 dx, vec2 dy, out vec4 shares, out vec4 relief) {
  shares = textureGrad(uBarkColours, at, dx, dy);
  relief = textureGrad(uBarkRelief, at, dx, dy);
}
/** Squares are shifted against each other in drifts, one passing into the next: the repetition is not seen. */
void octaveAt(float octave, vec2 place, vec2 dx, vec2 dy, out vec4 shares, out vec4 relief) {
  float squares = squaresAround(octave);
  float side = 6.2831853 * THINNEST * exp2(octave) / squares;
  vec2 scale = vec2(squares, 1.0 / side);
  vec2 at = place * scale + vec2(0.0, 0.37 * octave);
  float turn = 6.2831853 * place.x;
  float drift = 7.0 * noise(vec3(0.42 * squares * vec2(cos(turn), sin(turn)) + 9.0, 0.8 * at.y + 3.0 * octave));
  float shift = floor(drift);
  float passing = drift - shift;
  const vec2 SHIFT = vec2(0.387, 0.731);
  squareAt(at + SHIFT * (passing > 0.6 ? shift + 1.0 : shift), dx * scale, dy * scale, shares, relief);
  if (passing < 0.4 || passing > 0.6) return;
  vec4 otherShares;
  vec4 otherRelief;
  squareAt(at + SHIFT * (shift + 1.0), dx * scale, dy * scale, otherShares, otherRelief);
  float share = smoothstep(0.4, 0.6, passing + 0.2 * (otherRelief.a - relief.a) * (1.0 - abs(passing - 0.5) / 0.1));
  shares = mix(shares, otherShares, share);
  relief = mix(relief, otherRelief, share);
}
/** The bark at a turn and length of a limb of such a radius; one octave passes into the next by the height of both. */
void skinAt(vec2 place, float radius, vec2 dx, vec2 dy, out vec4 shares, out vec4 relief) {
  float octave = clamp(log2(radius / THINNEST), 0.0, ${(BARK_SQUARES.length - 1).toFixed(1)});
  float lower = floor(octave);
  float passing = octave - lower;
  octaveAt(passing > 0.62 ? lower + 1.0 : lower, place, dx, dy, shares, relief);
  if (passing < 0.38 || passing > 0.62) return;
  vec4 otherShares;
  vec4 otherRelief;
  octaveAt(lower + 1.0, place, dx, dy, otherShares, otherRelief);
  float share = smoothstep(0.38, 0.62, passing + 0.24 * (otherRelief.a - relief.a) * (1.0 - abs(passing - 0.5) / 0.12));
  shares = mix(shares, otherShares, share);
  relief = mix(relief, otherRelief, share);
}
/** What a twig grows out of: it is smooth, and has its own colour. */
Bark aged(vec4 shares, vec4 relief, float radius) {
  vec3 first = mix(uBarkPalette[4], uBarkPalette[0], smoothstep(${LIMB_ENDS.join(", ")}, radius));
  vec3 own = first * shares.r * ${MOST_SHADE} + uBarkPalette[1] * shares.g + uBarkPalette[2] * shares.b;
  float bark = smoothstep(${BARK_BEGINS.join(", ")}, radius);
  vec3 young = uBarkPalette[3] * (0.75 + 0.4 * shares.r);
  float rough = smoothstep(0.05, 0.3, radius);
  vec2 slope = (relief.rg * 2.0 - 1.0) * ${MOST_SLOPE.toFixed(1)} * rough * uBarkShape.x;
  return Bark(mix(young, own, bark), slope, mix(1.0, relief.b, rough * min(uBarkShape.x, 1.3)), relief.a);
}
Bark distantBark(float radius) {
  return aged(textureLod(uBarkColours, vec2(0.5), 20.0), textureLod(uBarkRelief, vec2(0.5), 20.0), radius);
}
/** What has no pattern: bark as it is on the whole, and the wood of a cut end. */
Bark plainBark(vec4 place) {
  Bark bark = distantBark(place.z);
  return Bark(place.w >= 0.0 ? vec3(0.40, 0.27, 0.15) : bark.albedo, vec2(0.0), 1.0, 0.5);
}
/** Sawn or broken wood: rings, rays, and a rim of bark. */
vec3 cutWood(float inward, float turn) {
  float rings = 0.5 + 0.5 * sin(55.0 * sqrt(inward) + 1.5 * sin(6.2831853 * turn));
  float heart = smoothstep(0.35, 0.8, inward);
  vec3 wood = mix(vec3(0.50, 0.36, 0.21), vec3(0.33, 0.20, 0.105), heart) * mix(0.86, 1.05, rings);
  return mix(uBarkPalette[0] * 0.5, wood, smoothstep(0.05, 0.12, inward));
}
/** Place: turn, length, radius, and how far inward on a cut end; bearing: turn, length, radius and weight. */
Bark barkAt(vec4 place, vec4 bearing) {
  vec4 shares;
  vec4 relief;
  vec2 dx = dFdx(bearing.xy);
  vec2 dy = dFdy(bearing.xy);
  skinAt(place.xy, place.z, dFdx(place.xy), dFdy(place.xy), shares, relief);
  Bark bark = aged(shares, relief, place.z);
  if (bearing.w > 0.01) {
    skinAt(bearing.xy, bearing.z, dx, dy, shares, relief);
    Bark below = aged(shares, relief, bearing.z);
    bark.albedo = mix(bark.albedo, below.albedo, bearing.w);
    bark.slope = mix(bark.slope, below.slope, bearing.w);
    bark.cavity = mix(bark.cavity, below.cavity, bearing.w);
    bark.height = mix(bark.height, below.height, bearing.w);
  }
  if (place.w >= 0.0) bark = Bark(cutWood(place.w, place.x), vec2(0.0), 1.0, 0.5);
  return bark;
}
`;
