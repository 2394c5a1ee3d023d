import { AIR_NUMBERS } from "../../../scene/motion/air-numbers";
import { onStep } from "../../words/number-text";

/** Share of the disc's half width at which the wind is strongest. */
export const RIM = 0.76;
/** Nearer to the middle than this share of the rim there is no wind. */
const MIDDLE = 0.06;

/** The wind that a place on the disc means, seen from above by an eye that is turned by so many degrees; x right, y down. */
export function windAt(x: number, y: number, turned: number): { speed: number; direction?: number } {
  const { speed, direction } = AIR_NUMBERS;
  const strength = Math.min(1, Math.hypot(x, y) / RIM);
  if (strength < MIDDLE) {
    return { speed: 0 };
  }
  const degrees = (Math.atan2(y, x) * 180) / Math.PI + turned;
  const round = onStep(((degrees % 360) + 360) % 360, direction.least, direction.most, direction.step);
  return { speed: onStep(strength * speed.most, speed.least, speed.most, speed.step), direction: round % 360 };
}

/** Where on the disc a wind stands. */
export function placeOnDisc(speed: number, direction: number, turned: number): readonly [x: number, y: number] {
  const strength = (RIM * speed) / AIR_NUMBERS.speed.most;
  const angle = ((direction - turned) * Math.PI) / 180;
  return [strength * Math.cos(angle), strength * Math.sin(angle)];
}
