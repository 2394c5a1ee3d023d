import type { AirSettings } from "../../../scene/motion/air-settings";

/** Winds to pick from: what a tap sets. Where the wind blows to stays. */
export const WIND_PRESETS = {
  calm: { speed: 0, rise: 0, sag: 0, snow: 0, rain: 0 },
  breeze: { speed: 3, turbulence: 0.6 },
  wind: { speed: 8, turbulence: 0.7 },
  storm: { speed: 18, turbulence: 0.8 },
  snow: { speed: 0.5, rise: 0, snow: 0.15, rain: 0 },
} as const satisfies Record<string, Partial<AirSettings>>;

export type WindPreset = keyof typeof WIND_PRESETS;

export const PRESET_NAMES = Object.keys(WIND_PRESETS) as readonly WindPreset[];

/** The one of which all is set, or null. */
export function presetOf(settings: AirSettings): WindPreset | null {
  const isSet = (name: WindPreset) =>
    Object.entries(WIND_PRESETS[name]).every(([each, value]) => settings[each as keyof AirSettings] === value);
  return PRESET_NAMES.find(isSet) ?? null;
}
