import { UNMOWN } from "../finer/meadow";
import { CHANCES } from "./chances";
import { CROWN_FIELD } from "./crown";
import { MOST_FEET } from "./environment";
import { FIELDS } from "./landscape";
import { ROOTS } from "./roots";

/** The colour of grass where it grows. */
export const GRASS_COLOUR = /* glsl */ `${UNMOWN}/** What lies flat is drawn out across the view where that grazes the ground, so that small patches are left out there. */
vec3 grassAt(vec2 at, float grazing) {
  float broad = noise(at * 0.021, 11.0) * 0.6 + noise(at * 0.057, 0.5) * 0.4;
  vec3 patches = vec3(noise(at * 0.09, 2.0), noise(at.yx * 0.21 + 3.7, 3.0), noise(at * 0.47, 13.0)) - 0.5;
  float dry = 0.5 + dot(vec3(0.45, 0.3, 0.25) * vec3(smoothstep(-0.04, 0.12, grazing), smoothstep(0.02, 0.3, grazing), smoothstep(0.06, 0.5, grazing)), patches);
  vec3 albedo = mix(vec3(0.066, 0.100, 0.033), vec3(0.122, 0.146, 0.050), smoothstep(0.15, 0.85, broad));
  // Lush and bluish where it is damp, dry here and there; what was not mown is straw on top.
  albedo = mix(albedo, vec3(0.058, 0.094, 0.042), 0.45 * smoothstep(0.5, 0.2, dry));
  albedo = mix(albedo, vec3(0.180, 0.164, 0.080), 0.45 * smoothstep(0.40, 0.95, dry));
  return mix(albedo, vec3(0.146, 0.147, 0.062), 0.36 * unmownAt(at));
}
`;

/** What the ground is made of and what lies on it, as finely as it is seen. */
export const GROUND_SURFACE = /* glsl */ `${CHANCES}${CROWN_FIELD}${FIELDS}${GRASS_COLOUR}
uniform vec4 uBarkShape; // relief, root flare, collar, smoothing
${ROOTS}uniform vec4 uLeafSeason; // size, presence, fresh, turned
uniform vec4 uLeafTraits; // shift by vigor, orientation, withered
uniform vec4 uLeafForm; // half width, whether it is a spray, how far that lies along its twig, how much it bends
uniform float uLeafSize;
uniform vec3 uLeafFirst;
uniform vec3 uLeafLast;
uniform vec3 uLeafDead;
/** How high grass stands, about one half; what is smaller than the picture can show is left out. */
float sward(vec2 at, float blurred) {
  vec4 wave = vec4(0.45, 1.7, 4.3, 10.7);
  vec4 shown = 1.0 - smoothstep(vec4(0.25), vec4(0.75), wave * blurred);
  vec4 parts = vec4(noise(at * wave.x, 8.0), noise(at.yx * wave.y, 5.0), noise(at * wave.z, 15.0), noise(at.yx * wave.w, 6.0));
  return 0.5 + dot(vec4(0.14, 0.28, 0.36, 0.32) * shown, parts - 0.5);
}
/** Leaves that have fallen, so many of them: their colour, and how much of the ground they cover here. */
vec4 litterAt(vec2 at, float many, float pixel) {
  float side = 0.9 * max(uLeafSize, 0.12);
  vec3 mean = mix(uLeafLast, uLeafDead, 0.62) * 0.8;
  float apart = 1.0 - smoothstep(0.25, 0.9, pixel / side);
  vec4 lies = vec4(mean, 0.75 * many * (1.0 - apart));
  if (apart <= 0.0) return lies;
  vec4 nearest = vec4(0.0);
  vec2 place = at / side;
  vec2 cell = floor(place);
  for (int i = 0; i < 9; i++) {
    vec2 other = cell + vec2(float(i % 3) - 1.0, float(i / 3) - 1.0);
    vec3 own = chances(other);
    if (own.z > many) continue;
    vec3 more = chances(other + 71.3);
    vec2 from = place - other - own.xy;
    float turn = 6.2832 * more.x;
    from = vec2(from.x * cos(turn) + from.y * sin(turn), from.y * cos(turn) - from.x * sin(turn));
    float wide = 0.32 * clamp(uLeafForm.x * 1.6, 0.12, 1.0);
    float along = clamp(from.x / 0.5, -1.0, 1.0);
    float rim = wide * sqrt(max(0.0, 1.0 - along * along)) * (1.0 - 0.25 * along);
    float inside = smoothstep(0.03, -0.03, abs(from.y) - rim) * step(abs(from.x), 0.5);
    // The midrib, and a blade that is bowed.
    vec3 hue = mix(mix(uLeafFirst, uLeafLast, more.y), uLeafDead, 0.35 + 0.6 * fract(own.z * 57.0 + more.z)) * (0.42 + 0.55 * more.z);
    hue *= 1.0 + 0.35 * from.y / max(wide, 0.05) - 0.3 * smoothstep(0.03, 0.0, abs(from.y));
    if (inside > 0.0 && more.z >= nearest.a) nearest = vec4(hue, max(more.z, 0.01));
  }
  return mix(lies, vec4(nearest.rgb, nearest.a > 0.0 ? 1.0 : 0.0), apart);
}
/** How much of the sky is left beside the roots that run over the ground here. */
float besideRoots(vec2 at) {
  float open = 1.0;
  for (int i = 0; i < ${MOST_FEET}; i++) {
    float thick = uFeet[i].w;
    if (thick <= 0.0) break;
    vec2 from = at - uFeet[i].xz;
    float far = length(from) / thick;
    if (far > 5.5 || thick < 0.12) continue;
    uint tree = uint(uFeet[i].y);
    for (int k = 0; k < rootsOf(tree); k++) {
      Root root = rootOf(tree, k);
      float along = dot(from, vec2(cos(root.turn), sin(root.turn))) / thick;
      vec4 middle = rootAt(root, thick, clamp((along - 0.5) / max(rootReach(root), 0.1), 0.0, 1.0));
      float gap = max(0.0, distance(from, middle.xz) - 0.8 * middle.w);
      float above = clamp((middle.y + middle.w) / max(middle.w, 1e-4), 0.0, 1.0);
      open *= 1.0 - 0.6 * above * exp(-gap / (0.45 * middle.w + 0.02));
    }
  }
  return open;
}
/** Daisies and buttercups where grass is open: they grow in patches, and are left out where they are smaller than pixels. */
vec3 flowered(vec3 grass, vec2 at, float pixel, float sheltered) {
  float patch_ = smoothstep(0.50, 0.78, noise(at * 0.16, 17.0) * 0.6 + noise(at * 0.55, 4.0) * 0.4);
  float many = 0.55 * patch_ * (1.0 - smoothstep(0.05, 0.4, sheltered)) * (1.0 - smoothstep(0.10, 0.26, pixel));
  if (many <= 0.0) return grass;
  const float APART = 0.42;
  vec2 cell = floor(at / APART);
  vec3 own = chances(cell + 13.7);
  if (own.z > many) return grass;
  vec2 from = (at / APART - cell - mix(vec2(0.22), vec2(0.78), own.xy)) * APART;
  float wide = 0.055 + 0.03 * own.x;
  float there = smoothstep(wide + 0.6 * pixel, wide - 0.6 * pixel, length(from));
  float kind = noise(at * 0.07, 22.0);
  vec3 hue = kind > 0.5 ? mix(vec3(0.62, 0.60, 0.52), vec3(0.62, 0.42, 0.05), smoothstep(0.5, 0.3, length(from) / wide)) : vec3(0.64, 0.48, 0.04);
  return mix(grass, hue, there);
}
Surface surfaceAt(vec3 world, vec3 eye, float foot, inout float open) {
  vec2 at = world.xz;
  float away = length(eye);
  float near = exp(-away * 0.010);
  // How wide a pixel is on the ground, and how deep: waves that are shorter than it is deep would run together across the view.
  vec2 wide = vec2(length(dFdx(at)), length(dFdy(at)));
  float shorter = min(wide.x, wide.y);
  float blurred = 0.4 * shorter + 0.34 * max(wide.x, wide.y);
  vec4 crown = crownAt(vec3(world.x, max(0.4, uCrownFrom.y + 2.6), world.z));
  // The box must not show where it ends.
  vec2 within = abs(2.0 * (at - uCrownFrom.xz) / uCrownSize.xz - 1.0);
  float shelter = (1.0 - crown.w) * smoothstep(1.0, 0.45, max(max(within.x, within.y), 0.8 * length(within)));
  open *= 1.0 - 0.86 * shelter;
  if (uShadowTaps > 1) open *= besideRoots(at);
  float broad = noise(at * 0.021, 11.0) * 0.6 + noise(at * 0.057, 0.5) * 0.4;
  float patches = noise(at * 0.09, 2.0) * 0.45 + noise(at.yx * 0.21 + 3.7, 3.0) * 0.3 + noise(at * 0.47, 13.0) * 0.25;
  float fine = noise(at * vec2(4.1, 2.6), 8.0) * 0.5 + noise(at.yx * vec2(7.0, 11.0), 5.0) * 0.5;
  vec3 soil = vec3(0.128, 0.094, 0.066) * (0.72 + 0.56 * fine);
  vec3 fields = mix(vec3(1.0), fieldsAt(at, away), smoothstep(70.0, 190.0, away));
  Surface surface = Surface(vec3(0.0), UP);
  if (uGround == EARTH) {
    float clods = noise(at * 1.3, 6.0) * 0.6 + noise(at * 2.9, 7.0) * 0.4;
    surface.albedo = mix(vec3(0.150, 0.108, 0.076), vec3(0.235, 0.178, 0.130), broad * 0.6 + patches * 0.4) * fields;
    surface.albedo *= 1.0 + near * ((clods - 0.5) * 0.35 + (fine - 0.5) * 0.4);
    surface.normal = normalize(vec3((clods - 0.5) * 0.5 * near, 1.0, (fine - 0.5) * 0.4 * near));
  } else if (uGround == SAND) {
    float bend = noise(at * 0.07, 4.0) * 9.0;
    float shown = near * (1.0 - smoothstep(0.10, 0.42, blurred));
    // Ripples part and meet; their lee sides are steep. Between drifts of them the sand lies smooth.
    float phase = at.x * 5.2 + at.y * 2.3 + 1.6 * bend + 3.4 * noise(at * 0.31, 9.0) + 1.2 * noise(at * 1.1, 5.0);
    float crest = fract(phase / 6.2831853);
    float slope = crest < 0.72 ? 0.39 : -1.0;
    slope *= smoothstep(0.0, 0.06, crest) * smoothstep(0.0, 0.06, abs(crest - 0.72)) * smoothstep(1.0, 0.94, crest);
    float rippled = shown * smoothstep(0.34, 0.66, noise(at * 0.06, 21.0)) * (0.35 + 0.65 * noise(at * 0.37, 25.0));
    float grains = (noise(at * 9.0, 3.0) + noise(at * 23.0, 7.0) - 1.0) * (1.0 - smoothstep(0.03, 0.12, shorter));
    surface.albedo = mix(vec3(0.430, 0.330, 0.225), vec3(0.530, 0.430, 0.310), broad * 0.5 + patches * 0.5);
    surface.albedo *= 1.0 + near * (fine - 0.5) * 0.14 + 0.16 * grains - 0.05 * rippled * (crest - 0.4);
    // Where the view grazes them, hollows are hidden and would be smears.
    float dunes = (noise(at * 0.03 + vec2(0.4, 0.0), 33.0) - noise(at * 0.03, 33.0)) * mix(0.25, 1.0, smoothstep(0.04, 0.25, eye.y / away));
    surface.normal = normalize(vec3(-0.9 * slope * rippled * 0.22 - 0.7 * dunes, 1.0, -0.4 * slope * rippled * 0.22 + (broad - 0.5) * 0.25));
  } else if (uGround == SNOW) {
    // Drifts, hollows that are blue with sky, a crust that sparkles near by, and wells around stems.
    float step_ = 0.35;
    vec3 drift = vec3(0.0);
    for (int i = 0; i < 3; i++) {
      vec2 p = at + step_ * vec2(i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0);
      p += 1.5 * noise(p * 0.05, 3.0);
      drift[i] = noise(p * vec2(0.050, 0.085), 4.0) * 1.9 + noise(p * 0.21, 9.0) * 0.30 * near + noise(p * 0.9, 2.0) * 0.05 * near;
    }
    // Where the view grazes them drifts hide their own hollows.
    vec2 slope = (drift.yz - drift.x) / step_ * mix(0.4, 1.0, smoothstep(0.03, 0.3, eye.y / away));
    surface.normal = normalize(vec3(-0.42 * slope.x, 1.0, -0.42 * slope.y));
    float hollow = clamp(1.2 - 0.7 * drift.x, 0.0, 1.0);
    surface.albedo = mix(vec3(0.88, 0.90, 0.93), vec3(0.74, 0.80, 0.90), 0.30 * hollow * smoothstep(-0.05, 0.2, eye.y / away) + 0.25 * foot);
    surface.albedo *= 0.965 + 0.05 * fine * near;
    vec3 grain = chances(floor(at / 0.05));
    vec3 towards = normalize(eye / away + uSun);
    float glint = pow(max(dot(normalize(surface.normal + 0.8 * (grain - 0.5)), towards), 0.0), 220.0);
    surface.albedo += 2.2 * step(0.75, glint) * (1.0 - smoothstep(8.0, 26.0, away));
  } else {
    // Grass stands: the eye meets the nearest tuft that is high enough on its way down to the ground.
    // Far off it is tussocks that are told apart.
    float tall = clamp(3.5 * shorter, 0.42, 1.1);
    float stands = uShadowTaps > 1 ? smoothstep(1.2, 3.5, tall / max(shorter, 1e-4)) : 0.0;
    // Near by blades are seen, and between them the dark at their feet.
    float near_ = smoothstep(40.0, 120.0, tall / max(shorter, 1e-4));
    stands *= 1.0 - 0.85 * near_;
    float height = sward(at, blurred);
    vec2 met = at;
    if (stands > 0.0) {
      vec2 back = eye.xz * (tall * stands / max(eye.y, 0.1));
      back *= min(1.0, 9.0 * tall / max(length(back), 1e-3));
      float fine_ = 0.9 * shorter;
      float above = 0.0;
      float before = 1.0;
      for (int i = 1; i <= 8; i++) {
        float level = 1.0 - float(i) / 8.0;
        vec2 at_ = at + back * level;
        float over = clamp((sward(at_, fine_) - 0.22) / 0.56, 0.0, 1.0) - level;
        if (over >= 0.0) {
          above = level + 0.125 * over / max(over + before, 1e-3);
          break;
        }
        before = -over;
      }
      met = at + back * above;
      height = mix(height, 0.22 + 0.56 * above, stands);
    }
    surface.albedo = grassAt(met, eye.y / away) * fields * (1.0 - 0.4 * near_);
    // A tuft is bright where it looks to the sun, and stands in the shade of the next.
    vec2 towards = uSun.xz / max(length(uSun.xz), 1e-3);
    float shaded = sward(met + 0.28 * towards, blurred) - height;
    float grazed = 1.0 - 0.6 * uSun.y;
    surface.albedo *= max(0.35, 1.0 + 1.35 * (height - 0.5) - 0.9 * grazed * shaded);
    surface.albedo = mix(surface.albedo, vec3(0.128, 0.132, 0.052), 0.35 * smoothstep(0.55, 0.8, height));
    surface.albedo = flowered(surface.albedo, at, shorter, shelter + foot);
    surface.albedo = mix(surface.albedo, soil * 0.8, 0.88 * foot * (1.0 - 0.55 * smoothstep(0.4, 0.62, height)));
  }
  if (uGround != SNOW && uLeafForm.y < 0.5) {
    // Under the crown and a little beyond it, thinning out; some of last year's are always left.
    float many = smoothstep(0.05, 0.75, shelter + 0.35 * (patches - 0.5) * smoothstep(0.02, 0.2, shelter));
    many *= clamp((uGround == SAND ? 0.0 : 0.05) + 1.0 * uLeafSeason.w + 0.5 * uLeafTraits.z, 0.0, 0.9);
    // Against the trunk what the wind has left of earlier years lies deepest.
    if (uGround != SAND) many = max(many, 0.34 * foot * smoothstep(0.05, 0.4, uCrown.w) * (0.4 + patches));
    if (many > 0.004) {
      vec4 litter = litterAt(at, many, blurred);
      surface.albedo = mix(surface.albedo, litter.rgb, litter.a);
    }
  }
  return surface;
}
`;
