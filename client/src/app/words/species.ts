/** German names of species by slug, and what tells each from others. The English ones come with the species. */
export const SPECIES = {
  oak: [
    "Eiche",
    "Ein kurzer Stamm, der sich früh in knorrige, weit ausgreifende Äste unter einer breiten Kuppel auflöst.",
  ],
  beech: [
    "Buche",
    "Ein glatter grauer Stamm, der sich in steile Äste unter einer hohen, dichten, runden Krone gabelt.",
  ],
  birch: ["Hänge-Birke", "Ein schlanker weißer Stamm mit aufsteigenden Ästen, deren feine Spitzen hängen."],
  "lombardy-poplar": ["Pyramidenpappel", "Eine hohe schmale Säule: alle Äste steigen vom Boden an steil am Stamm auf."],
  "weeping-willow": [
    "Trauerweide",
    "Ein kräftiger Stamm und Bögen, von denen ein Vorhang langer Triebe bis zum Boden hängt.",
  ],
  maple: ["Zucker-Ahorn", "Gepaarte Knospen bauen eine dichte ovale Krone, hier in Herbstfarben."],
  plane: ["Platane", "Ein hoher, fleckig gemusterter Stamm unter wenigen großen Ästen und einer lichten Kuppel."],
  cherry: ["Blütenkirsche", "Weit gespannte Äste auf kurzem Stamm, von Blüten bedeckt, ehe die Blätter kommen."],
  apple: ["Apfelbaum", "Eine niedrige runde Krone, so breit wie hoch, auf kurzem krummem Stamm."],
  olive: ["Ölbaum", "Ein alter, dicker, gewundener Stamm mit lockerer graugrüner Krone."],
  "umbrella-acacia": [
    "Schirmakazie",
    "Ein weites, flaches Dach auf Ästen, die sich tief gabeln und spreizen wie Schirmrippen.",
  ],
  baobab: ["Affenbrotbaum", "Ein Fass von einem Stamm, viel zu mächtig für die kurze, schüttere Krone darauf."],
  ginkgo: ["Ginkgo", "Wenige steife, aufsteigende Äste an geradem Stamm, mit kleinen Fächern, die buttergelb werden."],
  spruce: ["Fichte", "Ein dunkler Kegel bis zum Boden, dessen Äste sich senken und am Ende wieder heben."],
  "scots-pine": [
    "Waldkiefer",
    "Ein langer kahler Stamm, oben fuchsrot, mit flachen Nadelwolken auf wenigen krummen Ästen.",
  ],
  "stone-pine": ["Pinie", "Ein Sonnenschirm: Äste, die sich oben am kahlen Stamm zu einer glatten Kuppel fächern."],
  larch: ["Lärche", "Ein lichter Kegel mit waagrechten Ästen, dünnen hängenden Zweigen und Nadeln, die golden werden."],
  "cedar-of-lebanon": ["Libanon-Zeder", "Breite waagrechte Etagen, Platte über Platte, bis zum flachen Wipfel."],
  cypress: ["Säulenzypresse", "Eine dichte dunkle Flamme, geschlossen vom Boden bis zur Spitze."],
  juniper: ["Wacholder", "Viele steile Stämme aus einem Fuß in einem unebenen, blaugrünen, spitzen Busch."],
  "windswept-hawthorn": [
    "Windflüchter-Weißdorn",
    "Von Jahren einseitigen Windes gebeugt: der Stamm neigt sich, die ganze Krone weht nach Lee.",
  ],
  "bonsai-formal-upright": [
    "Bonsai, streng aufrecht",
    "Ein gerader, sich verjüngender Stamm mit waagrechten Laubpolstern abwechselnd links und rechts.",
  ],
  "bonsai-cascade": [
    "Bonsai, Halbkaskade",
    "Der Stamm steigt aus einem hohen Topf, neigt sich über den Rand und fällt zur Seite.",
  ],
  "bonsai-windswept": [
    "Bonsai, windgepeitscht",
    "Stamm und alle Äste neigen sich zu einer Seite, wie auf einer Klippe über dem Meer.",
  ],
  "bonsai-literati": [
    "Bonsai, Literaten",
    "Ein langer dünner Stamm in freien Kurven, kahl bis auf wenige kleine Polster nahe der Spitze.",
  ],
  shrub: ["Strauch", "Viele Stämme aus einer Wurzel, nach außen gebogen, keiner davon ein Hauptstamm."],
  hedge: ["Hecke", "Eine Reihe Pflanzen, mit dem Pinsel zu einem geschnittenen Block mit geraden Seiten geformt."],
  espalier: ["Spalier", "Eine Birne, flach an einer Wand gezogen: waagrechte Arme in Paaren an einem geraden Stamm."],
} as const satisfies Record<string, readonly [name: string, sentence: string]>;
