/** What every control has. */
export const CONTROLS = {
  "controls.reset": ["Reset {name}", "{name} zurücksetzen"],
  "controls.reset-all": ["Reset all", "Alles zurücksetzen"],
  "controls.value": ["{name}: value", "{name}: Wert"],
  "controls.any-colour": ["Any colour", "Beliebige Farbe"],
  "controls.any-colour-of": ["{name}: any colour", "{name}: beliebige Farbe"],
} as const;
