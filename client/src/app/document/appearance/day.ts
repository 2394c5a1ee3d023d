/**
 * The sun's way over one day. The scene is taken to lie at 48° north, with south along z and east along x, so that at
 * noon the sun stands behind who looks at the tree as a page opens. There a place in the sky belongs to one time of
 * one day of the year: turning its direction from the horizon's axes to those of the Earth gives the declination,
 * which is the day, and the hour angle, which is the time. So nothing but the sun's place is kept, and moving the
 * time moves the sun along the arc it is on. Where the real sun never stands, the nearest day's arc is taken.
 */
const LATITUDE = (48 * Math.PI) / 180;
/** How far from the equator the sun gets, in degrees. */
const SOLSTICE = 23.44;
/** The sun is not followed further below the horizon than this, in degrees. */
export const LOWEST = -10;

const [SIN, COS] = [Math.sin(LATITUDE), Math.cos(LATITUDE)];
const radians = (degrees: number) => (degrees * Math.PI) / 180;
const degrees = (radians: number) => (radians * 180) / Math.PI;

/** Where the sun is: azimuth in degrees from the z axis towards the x axis, elevation in degrees. */
export interface SunPlace {
  readonly azimuth: number;
  readonly elevation: number;
}

/** A time on a day: hours from 0 to 24, 12 at noon; the declination in degrees, from midwinter to midsummer. */
export interface TimeOfDay {
  readonly hours: number;
  readonly declination: number;
}

/** The time and the day on which the sun is there. */
export function timeAt({ azimuth, elevation }: SunPlace): TimeOfDay {
  const level = Math.cos(radians(elevation));
  const east = level * Math.sin(radians(azimuth));
  const south = level * Math.cos(radians(azimuth));
  const up = Math.sin(radians(elevation));
  const declination = degrees(Math.asin(clamp(up * SIN - south * COS, -1, 1)));
  const angle = Math.atan2(-east, south * SIN + up * COS);
  return { hours: 12 + (degrees(angle) * 24) / 360, declination: clamp(declination, -SOLSTICE, SOLSTICE) };
}

/** Where the sun is at a time of a day, no lower than it is followed. */
export function sunAt({ hours, declination }: TimeOfDay): SunPlace {
  const angle = radians(((hours - 12) * 360) / 24);
  const [sin, cos] = [Math.sin(radians(declination)), Math.cos(radians(declination))];
  const east = -cos * Math.sin(angle);
  const south = cos * Math.cos(angle) * SIN - sin * COS;
  const up = sin * SIN + cos * Math.cos(angle) * COS;
  const azimuth = degrees(Math.atan2(east, south));
  return {
    azimuth: azimuth < 0 ? azimuth + 360 : azimuth,
    elevation: Math.max(LOWEST, degrees(Math.asin(clamp(up, -1, 1)))),
  };
}

/** From when to when the sun is followed on a day, in hours. */
export function daylight(declination: number): readonly [dawn: number, dusk: number] {
  const d = radians(declination);
  const half = degrees(Math.acos(clamp((Math.sin(radians(LOWEST)) - Math.sin(d) * SIN) / (Math.cos(d) * COS), -1, 1)));
  return [12 - (half * 24) / 360, 12 + (half * 24) / 360];
}

/** Hours as a clock shows them. */
export function clockText(hours: number): string {
  const minutes = Math.round(hours * 60);
  return `${Math.floor(minutes / 60)}:${String(minutes % 60).padStart(2, "0")}`;
}

/** Hours from what was typed: `14:30`, or a number; null if it is neither. */
export function typedHours(text: string): number | null {
  const [, hours, minutes = "0"] = /^\s*(\d{1,2})(?::(\d{1,2}))?\s*$/.exec(text) ?? [];
  if (hours !== undefined) {
    return Number(hours) + Number(minutes) / 60;
  }
  const plain = Number(text.replace(",", "."));
  return text.trim() === "" || Number.isNaN(plain) ? null : plain;
}

function clamp(value: number, least: number, most: number): number {
  return Math.min(most, Math.max(least, value));
}
