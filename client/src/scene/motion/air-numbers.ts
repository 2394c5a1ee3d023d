import { LOOKS } from "../../wire/generated-tables";
import { type AirName, type AirSettings, CALM } from "./air-settings";

/** What can be set of the wind, row by row; apart, for the first picture does without. */
export const AIR_NUMBERS = LOOKS.wind;

/** Settings each of which is what it can be: what lies outside its range is at the end of that, what is no number as in a calm. */
export function soundAir(settings: AirSettings): AirSettings {
  const sound = (name: AirName) => {
    const { least, most } = AIR_NUMBERS[name];
    const value = settings[name];
    return [name, Number.isNaN(value) ? CALM[name] : Math.min(most, Math.max(least, value))] as const;
  };
  return Object.fromEntries((Object.keys(CALM) as AirName[]).map(sound)) as AirSettings;
}
