import { LEAF_NATURES, type LeafKind } from "../../wire/generated";

/** x across, from the midrib; y along, from 0 where the stalk begins to 1. */
export type Point = readonly [x: number, y: number];
/** The corners of a closed line. */
export type Outline = readonly Point[];

/** A vein, a stalk, a twig or a needle: as wide as is said at each end, from edge to edge. */
export interface Rib {
  readonly from: Point;
  readonly to: Point;
  readonly width: readonly [from: number, to: number];
}

/** A leaf, or a spray of small ones, laid flat. */
export interface Lamina {
  readonly blades: readonly Outline[];
  readonly veins: readonly Rib[];
  readonly stalks: readonly Rib[];
  /** Needles or scales, those below first; 0 to 1 says how far out on the shoot each stands. */
  readonly needles: readonly (Rib & { readonly out: number })[];
  /** Half of its width. */
  readonly reach: number;
}

type Parts = Omit<Lamina, "reach">;

/** Numbers from 0 to 1; the type specimen of a leaf has 0.5 everywhere. */
export type Random = () => number;
const typical: Random = () => 0.5;

/** The leaf of a kind; no two of them are quite alike. */
export function laminaOf(kind: LeafKind, random: Random = typical): Lamina {
  const parts = SHAPES[kind](random);
  let reach = 0;
  for (const [x] of parts.blades.flat()) reach = Math.max(reach, Math.abs(x));
  for (const { from, to, width } of [...parts.needles, ...parts.stalks]) {
    reach = Math.max(reach, Math.abs(from[0]) + width[0] / 2, Math.abs(to[0]) + width[1] / 2);
  }
  return { ...parts, reach };
}

/** Leaves that are many small ones on a twig, drawn as a spray that is seen from all around. */
export function isSpray(kind: LeafKind): boolean {
  return LEAF_NATURES[kind].is_spray;
}

/** Needles in a panel's picture. */
const MOST_NEEDLES = 64;

/** An SVG path of the type specimen, upright in a box from 0 to `size`. */
export function laminaPath(kind: LeafKind, size = 24): string {
  const { blades, stalks, needles: all } = laminaOf(kind);
  // So small, a spray is clearer with few of its needles.
  const needles = all.filter((_, i) => (i * 0.618034) % 1 < MOST_NEEDLES / all.length);
  const scale = size * 0.96;
  const at = ([x, y]: Point) => `${(size / 2 + x * scale).toFixed(1)} ${(size * 0.98 - y * scale).toFixed(1)}`;
  const bold = isSpray(kind) ? 0.034 : 0.024;
  const lines = [...stalks, ...needles].map((rib) => ribOutline(rib, bold));
  return [...blades, ...lines].map((outline) => `M${outline.map(at).join("L")}Z`).join("");
}

/** A rib as a closed line, nowhere thinner than `least`. */
function ribOutline({ from, to, width }: Rib, least: number): Outline {
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]) || 1;
  const across = [-(to[1] - from[1]) / length, (to[0] - from[0]) / length] as const;
  const corner = ([x, y]: Point, half: number): Point => [x + across[0] * half, y + across[1] * half];
  const [a, b] = width.map((w) => Math.max(w, least) / 2) as [number, number];
  return [corner(from, a), corner(to, b), corner(to, -b), corner(from, -a)];
}

const SHAPES: Record<LeafKind, (random: Random) => Parts> = {
  ovate: (random) =>
    simple(random, { stalk: 0.13, width: 0.27, below: 0.62, above: 0.86, sway: 0.03, teeth: 13, pairs: 7 }),
  round: (random) =>
    simple(random, { stalk: 0.27, width: 0.345, below: 0.44, above: 0.66, sway: 0.02, teeth: 11, pairs: 5 }),
  lanceolate: (random) =>
    simple(random, { stalk: 0.05, width: 0.088, below: 0.6, above: 0.82, sway: 0.06, teeth: 0, pairs: 9 }),
  lobed,
  palmate,
  fan,
  compound,
  needle,
  scale,
};

interface Simple {
  readonly stalk: number;
  /** Half width where it is widest. */
  readonly width: number;
  /** How blunt it is at its base and at its tip: powers of the distance to either. */
  readonly below: number;
  readonly above: number;
  /** How far the midrib may bend to the side. */
  readonly sway: number;
  readonly teeth: number;
  readonly pairs: number;
}

/** One blade whose half width is t^below·(1 − t)^above, as wide as is said at its widest. */
function simple(random: Random, { stalk, width, below, above, sway, teeth, pairs }: Simple): Parts {
  const bend = sway * (2 * random() - 1);
  const broad = width * (0.92 + 0.16 * random());
  const most = below / (below + above);
  const peak = most ** below * (1 - most) ** above;
  const middle = (t: number): Point => [bend * Math.sin(Math.PI * t), stalk + (1 - stalk) * t];
  const half = (t: number) => (broad / peak) * t ** below * (1 - t) ** above;
  // Teeth point towards the tip: they rise slowly and fall at once.
  const tooth = (t: number) => (teeth === 0 ? 1 : 1 + 0.055 * ((t * teeth) % 1) * Math.sin(Math.PI * t));
  const blade = mirrored(72, (t, sign) => {
    const [x, y] = middle(t);
    return [x + sign * half(t) * tooth(t), y];
  });
  const veins: Rib[] = chain(8, middle, [0.018, 0.004]);
  for (let pair = 1; pair <= pairs; pair += 1) {
    const start = 0.82 * (pair / (pairs + 0.6)) ** 1.1;
    for (const sign of [-1, 1]) {
      const end = Math.min(0.97, start + 0.16 + (sign > 0 ? 0.02 : 0));
      const [x, y] = middle(end);
      veins.push(rib(middle(start), [x + sign * half(end) * 0.93, y], 0.009, 0.003));
    }
  }
  return { blades: [blade], veins, stalks: [rib([0, 0], middle(0.04), 0.022, 0.018)], needles: [] };
}

/** Round lobes along a blade that is widest beyond its middle. */
function lobed(random: Random): Parts {
  const stalk = 0.07;
  const lobes = 4;
  const phase = 0.1 * (random() - 0.5);
  const middle = (t: number): Point => [0, stalk + (1 - stalk) * t];
  const wave = (t: number, sign: number) =>
    0.5 - 0.5 * Math.cos(2 * Math.PI * (lobes * t ** 0.92 + (sign > 0 ? phase : -phase) * Math.sin(Math.PI * t)));
  const half = (t: number, sign: number) => {
    const envelope = 0.335 * (t / 0.64) ** 0.75 * ((1 - t) / 0.36) ** 0.42;
    return envelope * (0.34 + 0.66 * wave(t, sign) ** 0.42);
  };
  const blade = mirrored(120, (t, sign) => {
    const out = half(t, sign);
    return [sign * out, middle(t)[1] + 0.16 * out * Math.sin(Math.PI * t)];
  });
  const veins = chain(6, middle, [0.02, 0.005]);
  for (let lobe = 0; lobe < lobes; lobe += 1) {
    const tip = ((lobe + 0.5) / lobes) ** (1 / 0.92);
    for (const sign of [-1, 1]) {
      const out = half(tip, sign) * 0.85;
      veins.push(rib(middle(tip * 0.86 - 0.02), [sign * out, middle(tip)[1] + 0.1 * out], 0.011, 0.003));
    }
  }
  return { blades: [blade], veins, stalks: [rib([0, 0], [0, stalk + 0.03], 0.026, 0.02)], needles: [] };
}

/** Pointed lobes that spread from the end of the stalk like fingers: the farthest of wedges with straight sides. */
function palmate(random: Random): Parts {
  const centre: Point = [0, 0.34];
  const lobes = [
    { at: 0, reach: 0.655, slim: 1.75 },
    { at: 0.82, reach: 0.57, slim: 1.9 },
    { at: -0.82, reach: 0.57, slim: 1.9 },
    { at: 1.72, reach: 0.36, slim: 1.9 },
    { at: -1.72, reach: 0.36, slim: 1.9 },
  ].map(({ at, reach, slim }) => ({ at: at * (0.95 + 0.1 * random()), reach: reach * (0.94 + 0.06 * random()), slim }));
  const wedges = lobes.flatMap(({ at, reach, slim }) => [
    { at, reach, slim },
    // Smaller points stand on the shoulders of each lobe.
    { at: at + 0.26, reach: reach * 0.7, slim: 4.2 },
    { at: at - 0.26, reach: reach * 0.7, slim: 4.2 },
  ]);
  const radius = (angle: number) => {
    let far = 0.1;
    for (const { at, reach, slim } of wedges) {
      const off = Math.abs(angle - at);
      if (off < 1.2) far = Math.max(far, reach / (Math.cos(off) + slim * Math.sin(off) ** 0.86));
    }
    return far;
  };
  const polar = (angle: number, far: number): Point => [
    centre[0] + Math.sin(angle) * far,
    centre[1] + Math.cos(angle) * far,
  ];
  const widest = 2.45;
  const blade: Point[] = [];
  for (let i = 0; i <= 180; i += 1) {
    const angle = widest * (i / 90 - 1);
    blade.push(polar(angle, radius(angle)));
  }
  blade.push([centre[0], centre[1] - 0.02]);
  const veins: Rib[] = [];
  for (const { at, reach } of lobes) {
    veins.push(rib(centre, polar(at, reach * 0.96), 0.02, 0.003));
    for (const sign of [-1, 1]) {
      for (const [from, to] of [
        [0.3, 0.52],
        [0.5, 0.68],
      ] as const) {
        veins.push(rib(polar(at, reach * from), polar(at + sign * 0.2, reach * to), 0.008, 0.003));
      }
    }
  }
  return { blades: [blade], veins, stalks: [rib([0, 0], centre, 0.02, 0.018)], needles: [] };
}

/** A fan on a long stalk, cleft in its middle, with fine veins that never meet. */
function fan(random: Random): Parts {
  const centre: Point = [0, 0.38];
  const cleft = 0.2 + 0.16 * random();
  const ripple = 6.28 * random();
  const spread = 1.28;
  const polar = (angle: number, far: number): Point => [Math.sin(angle) * far, centre[1] + Math.cos(angle) * far];
  const radius = (angle: number) =>
    0.565 * (1 + 0.07 * Math.cos(1.3 * angle)) * (1 - cleft * Math.exp(-((angle / 0.07) ** 2))) +
    0.008 * Math.sin(17 * angle + ripple);
  const blade: Point[] = [centre];
  for (let i = 0; i <= 96; i += 1) {
    const angle = spread * (i / 48 - 1);
    // The straight sides bow inwards a little before they meet the stalk.
    blade.push(polar(angle, radius(angle)));
  }
  const veins: Rib[] = [];
  for (let i = 0; i <= 22; i += 1) {
    const angle = spread * 0.94 * (i / 11 - 1);
    veins.push(rib(polar(angle * 0.8, 0.05), polar(angle, radius(angle) * 0.97), 0.008, 0.005));
  }
  return { blades: [blade], veins, stalks: [rib([0, 0], [0, centre[1] + 0.03], 0.024, 0.026)], needles: [] };
}

/** Leaflets in pairs along a stalk, and one at its end. */
function compound(random: Random): Parts {
  const pairs = 6;
  const blades: Outline[] = [];
  const veins: Rib[] = [];
  const leaflet = (from: Point, angle: number, length: number) => {
    const along: Point = [Math.sin(angle), Math.cos(angle)];
    const place = (t: number, out: number): Point => [
      from[0] + length * (along[0] * t + along[1] * out),
      from[1] + length * (along[1] * t - along[0] * out),
    ];
    const width = 0.17 + 0.02 * random();
    blades.push(mirrored(20, (t, sign) => place(t, sign * width * 2.05 * t ** 0.6 * (1 - t) ** 0.75)));
    veins.push(rib(place(0, 0), place(0.92, 0), 0.01, 0.003));
  };
  for (let pair = 0; pair < pairs; pair += 1) {
    const along = 0.17 + (0.6 * pair) / (pairs - 1);
    const length = 0.29 * (0.72 + 0.5 * Math.sin(Math.PI * (0.18 + (0.62 * pair) / pairs)));
    for (const sign of [-1, 1]) {
      const slip = 0.012 * (random() - 0.5);
      leaflet([0, along + slip], sign * (1.22 - 0.07 * pair + 0.14 * (random() - 0.5)), length);
    }
  }
  leaflet([0, 0.72], 0.1 * (random() - 0.5), 0.28);
  return { blades, veins, stalks: [rib([0, 0], [0, 0.74], 0.024, 0.01)], needles: [] };
}

/** A twig with shoots on both sides, each of them clothed in short thin needles that point ahead; the youngest are out on each shoot. */
function needle(random: Random): Parts {
  const needles: (Rib & { out: number })[] = [];
  const stalks: Rib[] = [];
  const shoot = (from: Point, angle: number, length: number, wide: number) => {
    const place = (t: number): Point => [
      from[0] + Math.sin(angle) * length * t,
      from[1] + Math.cos(angle) * length * t,
    ];
    stalks.push(rib(from, place(0.94), wide, wide * 0.5));
    const rows = Math.round(length / 0.017);
    for (let row = 0; row < rows; row += 1) {
      const t = (row + random()) / rows;
      for (const sign of [-1, 1]) {
        // Seen from the side, needles that point at the eye look short and lie close.
        const aside = 0.25 + 0.75 * random();
        const lean = angle + sign * aside * (0.95 - 0.55 * t);
        const far = (0.065 + 0.035 * aside) * (1.1 - 0.35 * t) * (0.75 + 0.5 * random());
        const at = place(0.04 + 0.96 * t);
        needles.push({
          from: at,
          to: [at[0] + Math.sin(lean) * far, Math.min(0.99, at[1] + Math.cos(lean) * far)],
          width: [0.0085, 0.003],
          out: t,
        });
      }
    }
  };
  // Those below first: the shoots at the base lie under the others.
  const pairs = 5;
  for (let pair = 0; pair < pairs; pair += 1) {
    for (const sign of [-1, 1]) {
      const along = 0.06 + (0.56 * (pair + 0.22 * (sign + 1) + 0.3 * random())) / pairs;
      const angle = sign * (0.98 - 0.62 * along) * (0.8 + 0.4 * random());
      shoot([0, along], angle, (0.42 - 0.36 * along) * (0.7 + 0.4 * random()), 0.011);
    }
  }
  shoot([0, 0], 0.04 * (random() - 0.5), 0.89, 0.018);
  return { blades: [], veins: [], stalks, needles };
}

/** A plume that branches twice, hidden under scales that overlap; all its shoots point ahead. */
function scale(random: Random): Parts {
  const needles: (Rib & { out: number })[] = [];
  const shoot = (from: Point, angle: number, length: number, wide: number) => {
    const scales = Math.max(3, Math.round(length / 0.018));
    const step = length / scales;
    for (let i = 0; i < scales; i += 1) {
      const t = i / scales;
      const at: Point = [from[0] + Math.sin(angle) * length * t, from[1] + Math.cos(angle) * length * t];
      // What would stick out beyond the tip is left away.
      if (at[1] > 0.96) return;
      const width = wide * (1 - 0.45 * t);
      for (const sign of [-1, 1]) {
        const lean = angle + sign * (0.2 + 0.3 * random());
        const to: Point = [at[0] + Math.sin(lean) * step * 1.9, Math.min(0.99, at[1] + Math.cos(lean) * step * 1.9)];
        needles.push({ from: at, to, width: [width, width * 0.25], out: t });
      }
    }
  };
  const branch = (from: Point, angle: number, length: number, depth: number) => {
    const laterals = [7, 5, 0][depth]!;
    for (let i = 0; i < laterals; i += 1) {
      for (const sign of [-1, 1]) {
        const t = (i + 0.45 + 0.25 * sign + 0.3 * (random() - 0.5)) / (laterals + 0.9);
        const at: Point = [from[0] + Math.sin(angle) * length * t, from[1] + Math.cos(angle) * length * t];
        const reach = length * (depth === 0 ? 0.46 : 0.4) * (1 - 0.55 * t) * (0.65 + 0.6 * random());
        branch(at, angle + sign * (0.46 + 0.24 * random()), reach, depth + 1);
      }
    }
    shoot(from, angle, length, [0.018, 0.012, 0.0095][depth]!);
  };
  branch([0, 0.01], 0.06 * (random() - 0.5), 0.95, 0);
  return { blades: [], veins: [], stalks: [rib([0, 0], [0, 0.3], 0.022, 0.014)], needles };
}

function rib(from: Point, to: Point, first: number, last: number): Rib {
  return { from, to, width: [first, last] };
}

/** A bent line as so many ribs, one after the other. */
function chain(parts: number, at: (t: number) => Point, [first, last]: readonly [number, number]): Rib[] {
  const width = (t: number) => first + (last - first) * t;
  return Array.from({ length: parts }, (_, i) => {
    const [from, to] = [i / parts, (i + 1) / parts];
    return rib(at(from), at(to), width(from), width(to));
  });
}

/** Up one side and down the other. */
function mirrored(parts: number, at: (t: number, sign: -1 | 1) => Point): Outline {
  const right = Array.from({ length: parts + 1 }, (_, i) => at(i / parts, 1));
  const left = Array.from({ length: parts - 1 }, (_, i) => at((parts - 1 - i) / parts, -1));
  return [...right, ...left];
}
