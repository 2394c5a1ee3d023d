/** What a person can choose for this device. */
export const SETTINGS = {
  "settings.language": ["Language", "Sprache"],
  "settings.language.system": ["As the browser", "Wie der Browser"],
  "settings.theme": ["Appearance", "Erscheinungsbild"],
  "settings.theme.system": ["As the system", "Wie das System"],
  "settings.theme.light": ["Light", "Hell"],
  "settings.theme.dark": ["Dark", "Dunkel"],
  "settings.side": ["Tools", "Werkzeuge"],
  "settings.side.left": ["Left", "Links"],
  "settings.side.right": ["Right", "Rechts"],
  "settings.names": ["Names on all buttons", "Namen an allen Knöpfen"],
  "settings.follow": ["Move back when growth leaves the picture", "Zurückgehen, wenn Wachstum das Bild verlässt"],
  "settings.pressure": ["Pen pressure widens the brush", "Stiftdruck verbreitert den Pinsel"],
} as const;
