/** Red, green and blue, 0 to 1, as light adds up. */
export type Colour = readonly [number, number, number];

/** What the screen's bytes stand for. */
export function linear(srgb: readonly number[]): Colour {
  const channel = (byte: number) => {
    const share = byte / 255;
    return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  };
  return [channel(srgb[0]!), channel(srgb[1]!), channel(srgb[2]!)];
}
