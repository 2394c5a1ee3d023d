/** The wind in which trees sway. */
export const WIND = {
  "wind.air": ["Air", "Luft"],
  "wind.wood": ["Wood", "Holz"],
  "wind.presets": ["How strong the wind is", "Wie stark der Wind ist"],
  "wind.presets.calm": ["Calm", "Windstille"],
  "wind.presets.breeze": ["Breeze", "Brise"],
  "wind.presets.wind": ["Wind", "Wind"],
  "wind.presets.storm": ["Storm", "Sturm"],
  "wind.disc": ["Wind by strength and direction", "Wind nach Stärke und Richtung"],
  "wind.disc.value": ["{speed} towards {direction}°", "{speed} in Richtung {direction}°"],
  "wind.speed": ["Strength", "Stärke"],
  "wind.speed.help": [
    "Mean speed of the wind 10 m above the ground; nearer to it there is less.",
    "Mittlere Geschwindigkeit des Windes 10 m über dem Boden; näher am Boden ist es weniger.",
  ],
  "wind.direction": ["Direction", "Richtung"],
  "wind.direction.help": ["Where the wind blows to.", "Wohin der Wind weht."],
  "wind.turbulence": ["Turbulence", "Böigkeit"],
  "wind.turbulence.help": [
    "From an even wind to one that comes in gusts.",
    "Von einem gleichmäßigen Wind bis zu einem, der in Böen kommt.",
  ],
  "wind.flutter": ["Flutter of leaves", "Flattern der Blätter"],
  "wind.flutter.help": [
    "How much leaves flutter; needles do so less than blades.",
    "Wie stark Blätter flattern; Nadeln tun es weniger als Spreiten.",
  ],
  "wind.sag": ["Sag", "Durchhang"],
  "wind.sag.help": [
    "How far branches hang lower, as if they weighed more than they grew under.",
    "Wie weit Äste tiefer hängen, als wögen sie mehr, als sie beim Wachsen wogen.",
  ],
  "wind.suppleness": ["Suppleness", "Biegsamkeit"],
  "wind.suppleness.help": [
    "How much softer the wood is than that of most trees of this height.",
    "Wie viel weicher das Holz ist als das der meisten Bäume dieser Höhe.",
  ],
  "wind.damping": ["Damping", "Dämpfung"],
  "wind.damping.help": [
    "How soon branches come to rest after a gust.",
    "Wie bald Äste nach einer Böe zur Ruhe kommen.",
  ],
  "wind.hold": ["Hold", "Anhalten"],
  "wind.let-go": ["Let go", "Loslassen"],
  "wind.move": ["Let it move", "Bewegen lassen"],
  "wind.hold.title": ["Hold what moves, or let it go (A)", "Anhalten, was sich bewegt, oder loslassen (A)"],
  "wind.still": [
    "Nothing moves, because this device is set to show less motion.",
    "Nichts bewegt sich, weil dieses Gerät weniger Bewegung zeigen soll.",
  ],
  "wind.local": [
    "The wind blows on this page alone: others in the session do not see it, and it is not saved.",
    "Der Wind weht nur auf dieser Seite: Andere in der Sitzung sehen ihn nicht, und er wird nicht gesichert.",
  ],
} as const;
