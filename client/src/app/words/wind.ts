/** The wind in which trees sway. */
export const WIND = {
  "wind.air": ["Air", "Luft"],
  "wind.wood": ["Wood", "Holz"],
  "wind.weather": ["Snow and rain", "Schnee und Regen"],
  "wind.snow": ["Snow", "Schnee"],
  "wind.snow.help": [
    "How deep fresh snow lies on leaves and level wood, which bend under it.",
    "Wie hoch Neuschnee auf Blättern und flachem Holz liegt, die sich darunter biegen.",
  ],
  "wind.rain": ["Rain", "Regen"],
  "wind.rain.help": [
    "How wet leaves and bark are: leaves hang, and bark is darker.",
    "Wie nass Blätter und Rinde sind: Blätter hängen, und Rinde ist dunkler.",
  ],
  "wind.presets": ["How strong the wind is", "Wie stark der Wind ist"],
  "wind.presets.calm": ["Calm", "Windstille"],
  "wind.presets.breeze": ["Breeze", "Brise"],
  "wind.presets.wind": ["Wind", "Wind"],
  "wind.presets.storm": ["Storm", "Sturm"],
  "wind.presets.snow": ["Snow", "Schnee"],
  "wind.disc": ["Wind by strength and direction", "Wind nach Stärke und Richtung"],
  "wind.disc.value": ["{speed} towards {direction}°", "{speed} in Richtung {direction}°"],
  "wind.speed": ["Strength", "Stärke"],
  "wind.speed.help": [
    "Mean speed of the wind 10 m above the ground; nearer to it there is less.",
    "Mittlere Geschwindigkeit des Windes 10 m über dem Boden; näher am Boden ist es weniger.",
  ],
  "wind.direction": ["Direction", "Richtung"],
  "wind.direction.help": ["Where the wind blows to.", "Wohin der Wind weht."],
  "wind.rise": ["Upwards", "Aufwärts"],
  "wind.rise.help": [
    "How fast the wind rises; it falls where this is less than nothing.",
    "Wie schnell der Wind aufsteigt; unter null fällt er.",
  ],
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
  "wind.shared": [
    "All in the session see the same wind and the same gusts, and it is saved with the tree. To hold it concerns this page alone.",
    "Alle in der Sitzung sehen denselben Wind und dieselben Böen, und er wird mit dem Baum gesichert. Angehalten wird er nur auf dieser Seite.",
  ],
  "wind.fine": [
    "Motion has no time step to set, for it is a formula of time; how finely curves are drawn follows the screen.",
    "Ein Zeitschritt ist nicht einzustellen, denn die Bewegung ist eine Formel der Zeit; wie fein Kurven gezeichnet werden, folgt dem Bildschirm.",
  ],
} as const;
