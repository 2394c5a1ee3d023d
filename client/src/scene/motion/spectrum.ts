/** Length of the largest eddies along the wind, m. */
const EDDIES = 60;
/** Steps of Simpson's rule over one band, an even number. */
const STEPS = 16;

/**
 * The share of the variance along the wind that lies between two frequencies in Hz, at a mean speed in m/s, by von Kármán's
 * spectrum.
 */
export function shareOfVariance(speed: number, [low, high]: readonly [number, number]): number {
  // Over ln X with X = f L/U: ∫ 4 X / (1 + 70.8 X²)^(5/6) d ln X.
  const [from, to] = [(low * EDDIES) / speed, (high * EDDIES) / speed];
  const step = Math.log(to / from) / STEPS;
  const at = (i: number) => {
    const x = from * Math.exp(i * step);
    return (4 * x) / (1 + 70.8 * x * x) ** (5 / 6);
  };
  let inner = 0;
  for (let i = 1; i < STEPS; i += 1) inner += (i % 2 === 1 ? 4 : 2) * at(i);
  return ((at(0) + inner + at(STEPS)) * step) / 3;
}
