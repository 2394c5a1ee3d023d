/** What surrounds the tree. */
export const BACKGROUND = {
  "background.surroundings": ["Surroundings", "Umgebung"],
  "background.sun": ["Sun", "Sonne"],
  "background.sky": ["Sky", "Himmel"],
  "background.sky.help": [
    "The sky, which also sets how soft the light and its shadows are.",
    "Der Himmel; von ihm kommt auch, wie weich Licht und Schatten sind.",
  ],
  "background.sky.meadow": ["Hazy", "Dunstig"],
  "background.sky.clear": ["Clear", "Klar"],
  "background.sky.overcast": ["Overcast", "Bedeckt"],
  "background.sky.studio": ["Studio", "Studio"],
  "background.ground": ["Ground", "Boden"],
  "background.ground.help": [
    "What the tree stands on; plain shows nothing but its shadow.",
    "Worauf der Baum steht; „Schlicht“ zeigt nur seinen Schatten.",
  ],
  "background.ground.grass": ["Grass", "Gras"],
  "background.ground.earth": ["Earth", "Erde"],
  "background.ground.sand": ["Sand", "Sand"],
  "background.ground.snow": ["Snow", "Schnee"],
  "background.ground.plain": ["Plain", "Schlicht"],
  "background.backdrop": ["Colour of the backdrop", "Farbe des Hintergrunds"],
  "background.backdrop.help": ["The studio’s wall behind the tree.", "Die Wand des Studios hinter dem Baum."],
  "background.time": ["Time of day", "Tageszeit"],
  "background.time.help": [
    "Moves the sun along its arc over a day at 48° north.",
    "Bewegt die Sonne auf ihrem Tagesbogen bei 48° Nord.",
  ],
  "background.sun_azimuth": ["Direction", "Richtung"],
  "background.sun_azimuth.help": [
    "Where the sun stands around the tree; you are at the foot of the dial.",
    "Wo die Sonne um den Baum steht; unten in der Scheibe bist du.",
  ],
  "background.sun_elevation": ["Height", "Höhe"],
  "background.sun_elevation.help": [
    "How high the sun stands above the horizon.",
    "Wie hoch die Sonne über dem Horizont steht.",
  ],
  "background.pin": ["Sun stays while you turn the tree", "Sonne bleibt beim Drehen stehen"],
  "background.pin.help": [
    "On: the sun keeps its place beside you. Off: it turns with the tree.",
    "Ein: Die Sonne bleibt neben dir. Aus: Sie dreht sich mit dem Baum.",
  ],
} as const;
