import { type Appearance, DEFAULT_APPEARANCE } from "../../wire/generated";
import type { Vec3 } from "../vector";

/** How trees sway, and what else the weather does to them: the section `wind` of the looks that all share. */
export type AirSettings = Readonly<Appearance["wind"]>;

export type AirName = keyof AirSettings;

/** No wind, and trees as they grew. */
export const CALM: AirSettings = DEFAULT_APPEARANCE.wind;

/** Whether anything goes on moving. */
export function stirs({ speed, rise }: Pick<AirSettings, "speed" | "rise">): boolean {
  return speed > 0 || rise !== 0;
}

/** The same for who is to see nothing move: what stands otherwise than it grew does so all the same. */
export function stilled(settings: AirSettings): AirSettings {
  return { ...settings, speed: 0, rise: 0 };
}

/** Whether anything stands otherwise than it grew. */
export function blows(settings: AirSettings): boolean {
  return stirs(settings) || settings.sag > 0 || settings.snow > 0 || settings.rain > 0;
}

/** Whether two are the same in every number. */
export function sameAir(one: AirSettings, other: AirSettings): boolean {
  return (Object.keys(CALM) as AirName[]).every((name) => one[name] === other[name]);
}

/** Where it blows, as a unit vector; in a calm where it would. However strong a level wind is, it is the same to the bit. */
export function alongOf({ speed, direction, rise }: Pick<AirSettings, "speed" | "direction" | "rise">): Vec3 {
  const whole = Math.hypot(speed, rise);
  const [level, up] = whole > 0 ? [speed / whole, rise / whole] : [1, 0];
  const turn = (direction * Math.PI) / 180;
  return [level * Math.cos(turn), up, level * Math.sin(turn)];
}

/** Mean wind 10 m above the ground, m/s. */
export function velocityOf({ speed, direction, rise }: Pick<AirSettings, "speed" | "direction" | "rise">): Vec3 {
  const turn = (direction * Math.PI) / 180;
  return [speed * Math.cos(turn), rise, speed * Math.sin(turn)];
}
