import type { Parameters, ParametersPatch } from "../../../../wire/generated";
import { NUMBERS } from "../../../document/growth/growth-parameters";
import { clamped } from "./place";

/** The parameters of gravimorphism (Figure 10). */
export type Ellipse = Pick<Parameters, "gravimorphism_vertical" | "gravimorphism_horizontal" | "gravimorphism_shift">;

/**
 * How far from the branch the ellipse reaches, which is how well buds do there: on the upper side, on the underside,
 * and at its widest on the flanks. In units in which 1 favours nobody.
 */
export interface Reach {
  readonly above: number;
  readonly below: number;
  readonly aside: number;
}

const { gravimorphism_vertical: V, gravimorphism_horizontal: P, gravimorphism_shift: E } = NUMBERS;
const hundredths = (value: number) => Math.round(100 * value) / 100;

export function reachOf({
  gravimorphism_vertical: s,
  gravimorphism_horizontal,
  gravimorphism_shift: e,
}: Ellipse): Reach {
  return { above: s * (1 + e), below: s * (1 - e), aside: gravimorphism_horizontal };
}

/** The ellipse whose top or bottom is pulled to a distance, while the other stays as well as it can. */
export function pulledTo(end: "above" | "below", distance: number, now: Ellipse): ParametersPatch {
  const other = reachOf(now)[end === "above" ? "below" : "above"];
  const wanted = Math.max(distance, 0);
  const vertical = clamped(hundredths((wanted + other) / 2), V.least, V.most);
  const shift = clamped(
    hundredths(((wanted - other) / (wanted + other)) * (end === "above" ? 1 : -1)),
    E.least,
    E.most,
  );
  return { gravimorphism_vertical: vertical, gravimorphism_shift: shift };
}

/** The ellipse that is pulled to a width. */
export function widenedTo(distance: number): ParametersPatch {
  return { gravimorphism_horizontal: clamped(hundredths(distance), P.least, P.most) };
}

/** The ellipse that is moved so far upwards as a whole, in the same units. */
export function movedBy(up: number, from: Ellipse): ParametersPatch {
  const { gravimorphism_vertical: s, gravimorphism_shift: e } = from;
  return { gravimorphism_shift: clamped(hundredths(e + up / s), E.least, E.most) };
}

/** The distance from the branch to the ellipse in a direction, given by the angle to the upper side (d of Figure 10). */
export function distanceAt(degrees: number, ellipse: Ellipse): number {
  const { gravimorphism_vertical: s, gravimorphism_horizontal: p, gravimorphism_shift: e } = ellipse;
  const angle = (degrees * Math.PI) / 180;
  const [up, side] = [Math.cos(angle), Math.sin(angle)];
  const a = (up / s) ** 2 + (side / p) ** 2;
  const b = (e * up) / s;
  return (b + Math.sqrt(Math.max(0, b * b - a * (e * e - 1)))) / a;
}

/** Which buds are favoured on slanted branches. */
export function favoured(ellipse: Ellipse): "epitony" | "hypotony" | "amphitony" | "even" | "vertical" {
  const [up, down, side] = [0, 180, 90].map((degrees) => distanceAt(degrees, ellipse)) as [number, number, number];
  const most = Math.max(up, down, side);
  if (most - Math.min(up, down, side) < 0.1) {
    return "even";
  }
  if (side === most) {
    return "amphitony";
  }
  if (Math.abs(up - down) < 0.05) {
    return "vertical";
  }
  return up > down ? "epitony" : "hypotony";
}
