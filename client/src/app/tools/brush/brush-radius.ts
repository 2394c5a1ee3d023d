import { BOUNDS } from "../../../wire/generated";
import { numberText } from "../../words/number-text";
import { say } from "../../words/say";

/** The widest brush, in internodes (`LM2`). */
export const MAX_RADIUS: number = BOUNDS.BrushRadius.most;
/** The narrowest brush that is not sketching. */
export const MIN_BRUSH = 0.5;
/** The part of the slider's way that means sketching. */
const SKETCH_ZONE = 0.06;

/**
 * The radius at a place of a slider that ends with the widest brush that the picture has room for, 0 (bottom) to 1; fine
 * at the narrow end, 0 at the very bottom.
 */
export function radiusAt(place: number, widest = MAX_RADIUS): number {
  const clamped = Math.min(1, Math.max(0, place));
  if (clamped < SKETCH_ZONE) {
    return 0;
  }
  return MIN_BRUSH * rangeOf(widest) ** ((clamped - SKETCH_ZONE) / (1 - SKETCH_ZONE));
}

/** The place of that slider for a radius. */
export function placeOf(radius: number, widest = MAX_RADIUS): number {
  if (radius < MIN_BRUSH / 2) {
    return 0;
  }
  const share = Math.log(Math.max(MIN_BRUSH, radius) / MIN_BRUSH) / Math.log(rangeOf(widest));
  return Math.min(1, SKETCH_ZONE + (1 - SKETCH_ZONE) * share);
}

/** How many times as wide as the narrowest brush the widest is; twice also where the picture has no room for that. */
function rangeOf(widest: number): number {
  return Math.max(2, widest / MIN_BRUSH);
}

/** A radius some notches wider or narrower; the way crosses from sketching to the narrowest brush. */
export function stepRadius(radius: number, notches: number): number {
  return radiusAt(placeOf(radius) + notches * SKETCH_ZONE);
}

/** The radius in words. */
export function radiusLabel(radius: number): string {
  return radius === 0 ? say("bars.radius.short") : numberText(radius, radius < 10 ? 0.1 : 1);
}
