/** A place in a diagram, in pixels from its top left corner; y points down. */
export interface Place {
  readonly x: number;
  readonly y: number;
}

export const clamped = (value: number, least: number, most: number): number => Math.min(most, Math.max(least, value));

export const radians = (degrees: number): number => (degrees * Math.PI) / 180;

/** The place so far from another, in a direction given in degrees: 0 is up, 90 to the right. */
export function away(from: Place, degrees: number, distance: number): Place {
  const angle = radians(degrees);
  return { x: from.x + distance * Math.sin(angle), y: from.y - distance * Math.cos(angle) };
}

/**
 * The angle between up and the way from one place to another, in degrees, measured on the right side and kept within a
 * range. Beyond up and down it stays there, so that a pointer that slips over to the left does not jump.
 */
export function angleOnRight(from: Place, to: Place, [least, most]: readonly [number, number]): number {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const angle = dx >= 0 ? (Math.atan2(dx, -dy) * 180) / Math.PI : dy < 0 ? 0 : 180;
  return clamped(angle, least, most);
}

/** A number with as many digits as a path needs. */
export const short = (value: number): string => String(Math.round(value * 100) / 100);

/** An arc around a middle, from one direction to another in degrees clockwise, as the data of a path. */
export function arc(middle: Place, radius: number, from: number, to: number): string {
  const [begin, end] = [away(middle, from, radius), away(middle, to, radius)];
  const large = Math.abs(to - from) > 180 ? 1 : 0;
  const sweep = to > from ? 1 : 0;
  const r = short(radius);
  return `M${short(begin.x)} ${short(begin.y)}A${r} ${r} 0 ${large} ${sweep} ${short(end.x)} ${short(end.y)}`;
}
