import { onStep } from "../../words/number-text";

/** A range, and the part of it that gets most of a control's travel, if any is named. */
export interface Scale {
  readonly least: number;
  readonly most: number;
  readonly step: number;
  readonly travel?: readonly [number, number] | undefined;
}

/** The share of the travel that such a part gets; what lies below and above it divide the rest by their lengths. */
const SHARE = 0.9;

/** Corners of the line from values to places: the values, and where each stands between 0 and 1. */
function cornersOf({ least, most, travel }: Scale): readonly (readonly [number, number])[] {
  if (!travel) {
    return [
      [least, 0],
      [most, 1],
    ];
  }
  const [from, to] = travel;
  const outside = most - least - (to - from);
  const start = outside > 0 ? ((1 - SHARE) * (from - least)) / outside : 0;
  return [
    [least, 0],
    [from, start],
    [to, outside > 0 ? start + SHARE : 1],
    [most, 1],
  ];
}

/** Where a value stands on a control, from 0 at its least end to 1 at its most. */
export function placeOf(scale: Scale, value: number): number {
  return along(cornersOf(scale), value);
}

/** The value nearest to a place on a control, on one of its steps. */
export function valueAt(scale: Scale, place: number): number {
  const corners = cornersOf(scale).map(([value, at]) => [at, value] as const);
  return onStep(along(corners, place), scale.least, scale.most, scale.step);
}

/** How many steps a key moves a control by; null for a key that does not. */
export function stepsOf(key: string): number | null {
  return STEPS[key] ?? null;
}

const STEPS: Readonly<Record<string, number>> = {
  ArrowUp: 1,
  ArrowRight: 1,
  ArrowDown: -1,
  ArrowLeft: -1,
  PageUp: 10,
  PageDown: -10,
};

/** What a line of corners gives for x; its ends beyond them. */
function along(corners: readonly (readonly [number, number])[], x: number): number {
  let [before, atBefore] = corners[0]!;
  for (const [next, atNext] of corners) {
    if (x <= next) {
      return next > before ? atBefore + ((atNext - atBefore) * Math.max(0, x - before)) / (next - before) : atNext;
    }
    [before, atBefore] = [next, atNext];
  }
  return atBefore;
}
