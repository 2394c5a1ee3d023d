/** The panel in which a tree's architecture is shaped: its parts, and what its widgets are for. */
export const ARCHITECTURE = {
  "architecture.tab.species": ["Species", "Arten"],
  "architecture.tab.form": ["Form", "Form"],
  "architecture.tab.growth": ["Growth", "Wuchs"],
  "architecture.tabs": ["What to shape", "Was geformt wird"],

  "architecture.sketch": [
    "A small flat tree that grows as the settings below say",
    "Ein kleiner flacher Baum, der wächst, wie es die Einstellungen darunter sagen",
  ],
  "architecture.sketch.growing": ["The sketch is growing…", "Die Skizze wächst …"],
  "architecture.sketch.failed": ["No sketch just now", "Gerade keine Skizze"],
  "architecture.own": ["Your own", "Eigene Art"],
  "architecture.changed": ["{name}, changed", "{name}, verändert"],
  "architecture.badge": ["changed", "verändert"],
  "architecture.choose-species": ["Species: {name}. Choose another one", "Art: {name}. Eine andere wählen"],

  "architecture.species.note": [
    "What grows from now on follows the species you pick; a seedling becomes a tree like the one in its picture.",
    "Was von nun an wächst, folgt der gewählten Art; aus einem Sämling wird ein Baum wie der auf ihrem Bild.",
  ],
  "architecture.species.search": ["Find a species", "Art suchen"],
  "architecture.species.none": ["No species is called “{words}”.", "Keine Art heißt „{words}“."],
  "architecture.species.unknown": ["This server knows no species.", "Dieser Server kennt keine Arten."],
  "architecture.species.looking": ["Looking…", "Suche…"],
  "architecture.species.label": ["{name} ({botanical}): {sentence}", "{name} ({botanical}): {sentence}"],

  "architecture.tropism": ["Tropism", "Tropismus"],
  "architecture.tropism.help": [
    "Turn the arrow on the sketch: branches tend to point along it, on every side of the tree.",
    "Drehe den Pfeil in der Skizze: Äste streben in seine Richtung, auf jeder Seite des Baums.",
  ],
  "architecture.sides": ["Favoured side", "Begünstigte Seite"],
  "architecture.sides.help": [
    "A slanted branch seen end-on: pull the ellipse to where its buds should grow best.",
    "Ein schräger Ast, von vorn gesehen: Zieh die Ellipse dorthin, wo seine Knospen am besten wachsen sollen.",
  ],
  "architecture.sides.above": ["Upper side", "Oberseite"],
  "architecture.sides.below": ["Underside", "Unterseite"],
  "architecture.sides.aside": ["Flanks", "Flanken"],
  "architecture.sides.whole": ["Whole ellipse, up or down", "Ganze Ellipse, hinauf oder hinab"],
  "architecture.sides.even": ["No side is favoured", "Keine Seite ist im Vorteil"],
  "architecture.sides.epitony": ["Epitony: buds on top thrive", "Epitonie: Knospen oben gedeihen"],
  "architecture.sides.hypotony": ["Hypotony: buds underneath thrive", "Hypotonie: Knospen unten gedeihen"],
  "architecture.sides.amphitony": [
    "Amphitony: buds on the flanks thrive",
    "Amphitonie: Knospen an den Flanken gedeihen",
  ],
  "architecture.sides.vertical": ["Buds above and below thrive", "Knospen oben und unten gedeihen"],
  "architecture.fork": ["Branching", "Verzweigung"],
  "architecture.fork.help": [
    "Bend the fork: the side shoot leaves at ψ, and the axis turns away from it by δ.",
    "Biege die Gabel: Der Seitentrieb geht im Winkel ψ ab, und die Achse weicht ihm um δ aus.",
  ],
  "architecture.fork.several": [
    "Several buds at a node push the axis to no side, so δ rests.",
    "Mehrere Knospen am Knoten drängen die Achse nach keiner Seite; δ ruht.",
  ],
  "architecture.weights": ["Direction", "Richtung"],
  "architecture.weights.help": [
    "Drag the dot towards what new shoots should obey: their own heading, tropism, or free space.",
    "Zieh den Punkt zu dem, was neuen Trieben wichtig sein soll: ihre Richtung, Tropismus oder freier Raum.",
  ],
  "architecture.weights.point": [
    "Balance of heading, tropism and free space",
    "Gleichgewicht von Richtung, Tropismus und freiem Raum",
  ],
  "architecture.weights.text": [
    "straight on {alpha}, tropism {beta}, free space {gamma}",
    "geradeaus {alpha}, Tropismus {beta}, freier Raum {gamma}",
  ],
  "architecture.perception": ["Space of a bud", "Raum einer Knospe"],
  "architecture.perception.help": [
    "The inner circle is a bud’s own; in the cone it looks for room, shown as dots, and grows to where they are.",
    "Der innere Kreis gehört der Knospe; im Kegel sucht sie Raum, die Punkte, und wächst dorthin.",
  ],

  "architecture.programme": ["Programme over age", "Programm über das Alter"],
  "architecture.programme.none": [
    "The tree grows by the same parameters at every age. A programme changes them with its age.",
    "Der Baum wächst in jedem Alter nach denselben Parametern. Ein Programm ändert sie mit seinem Alter.",
  ],
  "architecture.programme.begin": ["Begin a programme", "Programm beginnen"],
  "architecture.programme.parameter": ["Parameter whose course is shown", "Parameter, dessen Verlauf gezeigt wird"],
  "architecture.programme.stage": ["{name} from age {age}", "{name} ab Alter {age}"],
  "architecture.programme.place": ["Stage {place} of {count}", "Stufe {place} von {count}"],
  "architecture.programme.previous": ["The stage before", "Die Stufe davor"],
  "architecture.programme.next": ["The next stage", "Die nächste Stufe"],
  "architecture.programme.now": ["age {age}", "Alter {age}"],
  "architecture.programme.from": ["From age", "Ab Alter"],
  "architecture.programme.age": ["Age at which the stage begins", "Alter, in dem die Stufe beginnt"],
  "architecture.programme.add": ["Add a stage at age {age}", "Stufe im Alter {age} einfügen"],
  "architecture.programme.remove": ["Remove the stage", "Stufe entfernen"],
  "architecture.programme.reset": ["As {name} has it", "Wie bei: {name}"],
  "architecture.programme.drop": ["Without a programme", "Ohne Programm"],
  "architecture.programme.followed": ["All parameters follow the programme.", "Alle Parameter folgen dem Programm."],
  "architecture.programme.by-hand": [
    "Set by hand, and so the same at every age:",
    "Von Hand gesetzt und darum in jedem Alter gleich:",
  ],
  "architecture.programme.follow": ["Follow", "Folgen"],
  "architecture.programme.follow-one": [
    "Let {name} follow the programme again",
    "{name} wieder dem Programm folgen lassen",
  ],
  "architecture.programme.follow-all": ["Let all follow the programme again", "Alle wieder dem Programm folgen lassen"],

  "architecture.section.vigor": ["Vigor", "Wuchskraft"],
  "architecture.section.sharing": ["How vigor is shared", "Verteilung der Kraft"],
  "architecture.section.buds": ["Buds", "Knospen"],
  "architecture.section.shade": ["Shade", "Schatten"],
  "architecture.section.wood": ["Wood", "Holz"],
} as const;
