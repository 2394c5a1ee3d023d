import type { Parameters, ParametersPatch } from "../../../../wire/generated";
import { NUMBERS } from "../../../document/growth/growth-parameters";
import { onStep } from "../../../words/number-text";
import { angleOnRight, clamped, type Place } from "./place";

/** What a bud occupies and perceives (Figure 8B). */
export type Perception = Pick<Parameters, "occupancy_radius" | "perception_depth" | "perception_angle">;

const { occupancy_radius: R, perception_depth: D, perception_angle: ZETA } = NUMBERS;
const FARTHEST = R.most + D.most;

/**
 * Distances in internodes as pixels around the bud. Far ones are drawn closer together, as a root: circles stay circles
 * and angles stay what they are, while the least zone can be held and the farthest fits.
 */
export class Rings {
  readonly #outermost: number;

  /** The farthest that can be perceived is drawn at so many pixels. */
  constructor(outermost: number) {
    this.#outermost = outermost;
  }

  pixels(internodes: number): number {
    return this.#outermost * Math.sqrt(Math.max(0, internodes) / FARTHEST);
  }

  internodes(pixels: number): number {
    return FARTHEST * (Math.max(0, pixels) / this.#outermost) ** 2;
  }
}

/** The occupied zone when its rim is pulled to a distance in internodes. */
export function zoneAt(distance: number): ParametersPatch {
  return { occupancy_radius: onStep(clamped(distance, R.least, R.most), R.least, R.most, R.step) };
}

/** The depth of perception when its rim, which lies beyond the zone, is pulled to a distance. */
export function depthAt(distance: number, { occupancy_radius }: Perception): ParametersPatch {
  return { perception_depth: onStep(clamped(distance - occupancy_radius, D.least, D.most), D.least, D.most, D.step) };
}

/** The angle of perception, both sides together, when its right side is turned to a place. */
export function angleAt(bud: Place, place: Place): ParametersPatch {
  const angle = 2 * angleOnRight(bud, place, [ZETA.least / 2, ZETA.most / 2]);
  return { perception_angle: onStep(angle, ZETA.least, ZETA.most, ZETA.step) };
}
