import type { ParametersPatch } from "../../../../wire/generated";
import { NUMBERS } from "../../../document/growth/growth-parameters";
import { onStep } from "../../../words/number-text";
import { angleOnRight, type Place } from "./place";

const { setpoint_angle: THETA } = NUMBERS;

/** The set-point angle when the arrow from a place points to another. */
export function setpointAt(from: Place, to: Place): ParametersPatch {
  const angle = angleOnRight(from, to, [THETA.least, THETA.most]);
  return { setpoint_angle: onStep(angle, THETA.least, THETA.most, THETA.step) };
}
