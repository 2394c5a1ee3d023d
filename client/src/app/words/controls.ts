/** What every control has. */
export const CONTROLS = {
  "controls.reset": ["Reset {name}", "{name} zurücksetzen"],
  "controls.reset-all": ["Reset all", "Alles zurücksetzen"],
  "controls.value": ["{name}: value", "{name}: Wert"],
  "controls.still-busy": [
    "The server is still at what was asked before. Try again in a moment.",
    "Der Server ist noch bei dem, was davor verlangt wurde. Versuche es gleich noch einmal.",
  ],
  "controls.any-colour": ["Any colour", "Beliebige Farbe"],
  "controls.any-colour-of": ["{name}: any colour", "{name}: beliebige Farbe"],
} as const;
