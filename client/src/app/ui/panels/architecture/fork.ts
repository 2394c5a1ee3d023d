import type { ParametersPatch } from "../../../../wire/generated";
import { NUMBERS } from "../../../document/growth/growth-parameters";
import { onStep } from "../../../words/number-text";
import { angleOnRight, away, type Place } from "./place";

const { branching_angle: PSI, deflection_angle: DELTA } = NUMBERS;

/** Lengths of the arms of the fork, in pixels: far enough apart that both ends can be held where both angles are 0. */
export const LATERAL = 66;
export const MAIN = 108;

/** Where the side shoot ends (ψ is measured to the right). */
export const lateralEnd = (node: Place, psi: number): Place => away(node, psi, LATERAL);

/** Where the main axis ends, which turns away to the left (δ). */
export const mainEnd = (node: Place, delta: number): Place => away(node, -delta, MAIN);

/** The branching angle when the side shoot is bent to a place. */
export function branchingAt(node: Place, place: Place): ParametersPatch {
  const angle = angleOnRight(node, place, [PSI.least, PSI.most]);
  return { branching_angle: onStep(angle, PSI.least, PSI.most, PSI.step) };
}

/** The deflection angle when the main axis is bent to a place. */
export function deflectionAt(node: Place, { x, y }: Place): ParametersPatch {
  const angle = angleOnRight(node, { x: 2 * node.x - x, y }, [DELTA.least, DELTA.most]);
  return { deflection_angle: onStep(angle, DELTA.least, DELTA.most, DELTA.step) };
}
