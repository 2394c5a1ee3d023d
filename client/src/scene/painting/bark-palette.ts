import type { BarkKind } from "../../wire/generated";

type Rgb = readonly [number, number, number];

/** How the other colours of a bark come from its tint: a share of the tint itself, and what is mixed with it. */
interface Mixture {
  readonly brightness: number;
  readonly other: Rgb;
  readonly share: number;
}

interface Palette {
  readonly second: Mixture;
  readonly third: Mixture;
  /** Of twigs, before they have bark. */
  readonly young: Mixture;
  /** What limbs have for the tint, which is that of the trunk. */
  readonly limb: Mixture;
}

const SAME: Mixture = { brightness: 1, other: [0, 0, 0], share: 0 };

const TWIG: Mixture = { brightness: 0.75, other: [0.085, 0.07, 0.036], share: 0.55 };

/** Linear colours beside the tint: what lies in the furrows, what grows or shows on top. */
const PALETTES: Record<BarkKind, Palette> = {
  smooth: {
    second: { brightness: 0.8, other: [0.1, 0.12, 0.05], share: 0.6 },
    third: { brightness: 1.12, other: [0.42, 0.44, 0.36], share: 0.3 },
    young: { brightness: 0.7, other: [0.13, 0.095, 0.06], share: 0.5 },
    limb: SAME,
  },
  furrowed: {
    second: { brightness: 0.34, other: [0.045, 0.032, 0.021], share: 0.5 },
    third: { brightness: 1, other: [0.24, 0.28, 0.16], share: 0.6 },
    young: TWIG,
    limb: SAME,
  },
  plated: {
    second: { brightness: 1.05, other: [0.36, 0.14, 0.06], share: 0.55 },
    third: { brightness: 0.24, other: [0.035, 0.022, 0.015], share: 0.5 },
    young: { brightness: 0.9, other: [0.2, 0.115, 0.055], share: 0.5 },
    // Fox-red where the plates came off.
    limb: { brightness: 1.1, other: [0.37, 0.155, 0.07], share: 0.6 },
  },
  papery: {
    second: { brightness: 0.02, other: [0.02, 0.017, 0.015], share: 0.8 },
    third: { brightness: 0.9, other: [0.55, 0.33, 0.2], share: 0.75 },
    young: { brightness: 0.05, other: [0.085, 0.042, 0.03], share: 0.9 },
    limb: SAME,
  },
  flaking: {
    second: { brightness: 1.4, other: [0.58, 0.51, 0.31], share: 0.7 },
    third: { brightness: 0.75, other: [0.2, 0.175, 0.135], share: 0.7 },
    young: { brightness: 0.8, other: [0.11, 0.09, 0.045], share: 0.5 },
    limb: { brightness: 1.2, other: [0.5, 0.45, 0.28], share: 0.35 },
  },
  banded: {
    second: { brightness: 1.7, other: [0.28, 0.17, 0.1], share: 0.55 },
    third: { brightness: 0.25, other: [0.025, 0.014, 0.012], share: 0.4 },
    young: { brightness: 0.9, other: [0.11, 0.05, 0.035], share: 0.5 },
    limb: SAME,
  },
  stringy: {
    second: { brightness: 0.45, other: [0.13, 0.045, 0.022], share: 0.55 },
    third: { brightness: 1.25, other: [0.36, 0.33, 0.28], share: 0.5 },
    young: { brightness: 0.7, other: [0.1, 0.075, 0.035], share: 0.6 },
    limb: SAME,
  },
};

/** The linear colours of a bark of this tint (sRGB, 0 to 255): a trunk's own, the second, the third, twigs', limbs' own. */
export function barkPalette(kind: BarkKind, tint: Rgb): readonly [Rgb, Rgb, Rgb, Rgb, Rgb] {
  const own: Rgb = [linear(tint[0]), linear(tint[1]), linear(tint[2])];
  const { second, third, young, limb } = PALETTES[kind];
  return [own, mixed(own, second), mixed(own, third), mixed(own, young), mixed(own, limb)];
}

function mixed(own: Rgb, { brightness, other, share }: Mixture): Rgb {
  const of = (i: 0 | 1 | 2) => own[i] * brightness * (1 - share) + other[i] * share;
  return [of(0), of(1), of(2)];
}

/** What a byte of sRGB means as light. */
function linear(byte: number): number {
  const value = byte / 255;
  return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
}
