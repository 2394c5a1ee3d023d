/** Red, green and blue as multiples of another colour's, in linear light. */
export type Factors = readonly [number, number, number];
/** Red, green and blue in sRGB, each from 0 to 255. */
type Rgb = [number, number, number];

/** The greatest multiple. */
const MOST = 4;

/** A colour, with each part of its light so many times as strong. */
export function colourBy(base: Readonly<Rgb>, factors: Factors): Rgb {
  const part = (of: 0 | 1 | 2) => Math.round(255 * coded(linear(base[of] / 255) * factors[of]));
  return [part(0), part(1), part(2)];
}

/** How many times as strong the light of a colour is as another's; what has none of a part is not changed by it. */
export function factorsOf(base: Readonly<Rgb>, colour: Readonly<Rgb>): Factors {
  const part = (of: 0 | 1 | 2) => {
    const light = linear(base[of] / 255);
    return light === 0 ? 1 : Math.round(1e4 * Math.min(linear(colour[of] / 255) / light, MOST)) / 1e4;
  };
  return [part(0), part(1), part(2)];
}

function linear(code: number): number {
  return code <= 0.04045 ? code / 12.92 : ((code + 0.055) / 1.055) ** 2.4;
}

function coded(light: number): number {
  const within = Math.min(Math.max(light, 0), 1);
  return within <= 0.0031308 ? 12.92 * within : 1.055 * within ** (1 / 2.4) - 0.055;
}
