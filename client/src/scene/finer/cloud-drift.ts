import { type Background, DEFAULT_APPEARANCE } from "../../wire/generated";

/** How far clouds have drifted since the hour in which new trees stand: they go on as the sun does, and are back with it. */
export function cloudDrift(background: Background): number {
  return driftAt(background) - driftAt(DEFAULT_APPEARANCE.background);
}

function driftAt({ sun_azimuth, sun_elevation }: Background): number {
  const turn = (sun_azimuth * Math.PI) / 180;
  return 0.5 * Math.sin(turn) + 0.35 * Math.cos(turn) + 0.012 * sun_elevation;
}
