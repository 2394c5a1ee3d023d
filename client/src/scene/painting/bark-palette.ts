import { BARK_NATURES, type BarkKind, type Mixture } from "../../wire/generated";

type Rgb = readonly [number, number, number];

/** The linear colours of a bark of this tint (sRGB, 0 to 255): a trunk's own, the second, the third, twigs', limbs' own. */
export function barkPalette(kind: BarkKind, tint: Rgb): readonly [Rgb, Rgb, Rgb, Rgb, Rgb] {
  const own: Rgb = [linear(tint[0]), linear(tint[1]), linear(tint[2])];
  const { second, third, young, limb } = BARK_NATURES[kind];
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
