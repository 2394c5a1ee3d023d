import { NONE } from "./limbs";

/** Damping of a limb that swings alone, as a share of the critical one, without that of the air (Jackson 2019). */
const ALONE = 0.04;
/** What limbs on one bearer take from each other when they swing nearly alike (James 2003, 2014). */
const COMPANY = 1.3;
/** So many of one bearer within this ratio of frequencies are company. */
const MANY = 3;
const ALIKE = 1.2;

/** Gives each joint its damping. */
export function dampingByCompany(
  damping: Float64Array,
  frequencies: Float64Array,
  bearerOf: (joint: number) => number,
): void {
  damping.fill(ALONE);
  const order = [...damping.keys()].sort(
    (a, b) => bearerOf(a) - bearerOf(b) || frequencies[a]! - frequencies[b]! || a - b,
  );
  for (let begin = 0, end = 0; begin < order.length; begin = end) {
    const bearer = bearerOf(order[begin]!);
    end = begin;
    while (end < order.length && bearerOf(order[end]!) === bearer) end += 1;
    // Trunks stand on the ground, which passes nothing on.
    if (bearer === NONE) continue;
    const frequency = (at: number) => frequencies[order[at]!]!;
    let [from, to] = [begin, begin];
    for (let of = begin; of < end; of += 1) {
      while (ALIKE * frequency(from) < frequency(of)) from += 1;
      while (to < end && frequency(to) <= ALIKE * frequency(of)) to += 1;
      if (to - from >= MANY) damping[order[of]!] = ALONE * COMPANY;
    }
  }
}
