/** What the tools tell and ask. */
export const TOOLS = {
  "tools.outline-small": [
    "Draw a larger outline: the tree grows to fill it.",
    "Zeichne einen größeren Umriss: Der Baum wächst hinein.",
  ],
  "tools.ground-missed": ["Tap the ground, not too far away.", "Tippe auf den Boden, nicht zu weit weg."],
  "tools.no-limb": ["Tap the limb that shall bear the branch.", "Tippe auf den Ast, der den Zweig tragen soll."],
  "tools.trunk-held": [
    "This is where the whole tree stands; take hold of it further up.",
    "Hier steht der ganze Baum; fass weiter oben an.",
  ],
  "tools.trunk-stays": [
    "The trunk cannot be cut off. Set a width on it, then cut above: a stub stays.",
    "Der Stamm lässt sich nicht abschneiden. Lege seine Dicke fest und schneide darüber: Ein Stumpf bleibt.",
  ],
  "tools.bend-ended": [
    "The branch you were bending has changed; your bend ended there.",
    "Der Ast, den du gebogen hast, hat sich verändert; dein Biegen endete dort.",
  ],
  "tools.bend-base": [
    "Take the branch a little further up: its base stays where it is.",
    "Fass den Ast etwas weiter oben: Sein Ansatz bleibt, wo er ist.",
  ],
  "tools.no-connection": [
    "There is no connection to ask; try again in a moment.",
    "Gerade ist keine Verbindung da; versuche es gleich noch einmal.",
  ],
  "tools.symmetry.off": ["No symmetry", "Keine Symmetrie"],
  "tools.symmetry.mirror": ["Mirrored across the trunk", "Gespiegelt am Stamm"],
  "tools.symmetry.around": ["{count} times around the trunk", "{count}-mal um den Stamm"],
  "tools.symmetry.around-mirrored": [
    "{count} times around the trunk, mirrored",
    "{count}-mal um den Stamm, gespiegelt",
  ],
} as const;

/** Options of the tools that shape what has grown, and what is done with a branch that is held. */
export const SHAPING = {
  "tools.bending": ["Bending", "Biegen"],
  "tools.bending.marked": [
    "Drag any place above the ring. Tap a place to have it stay put.",
    "Ziehe an einer Stelle über dem Ring. Angetippte Stellen bleiben, wo sie sind.",
  ],
  "tools.bending.unmarked": [
    "Drag a branch. Hold or tap its base first to say where it bends from.",
    "Ziehe an einem Ast. Halte oder tippe vorher an, von wo an er sich biegen soll.",
  ],
  "tools.stretch": ["Stretch", "Dehnung"],
  "tools.stretch.help": [
    "How much longer a branch may become as it is bent: at 0 it keeps its length, at 100 it stretches like rubber.",
    "Wie viel länger ein Ast beim Biegen werden darf: Bei 0 behält er seine Länge, bei 100 dehnt er sich wie Gummi.",
  ],
  "tools.base-release": ["Let go of the base", "Ansatz loslassen"],
  "tools.base-release.title": ["Let go of the base (Esc)", "Ansatz loslassen (Esc)"],
  "tools.widths": ["Widths", "Dicken"],
  "tools.widths.chosen": [
    "Pull a knob to make the limb thicker. Drag the dot to move the ring along it.",
    "Ziehe an einem Knopf, um den Ast dicker zu machen. Am Punkt lässt sich der Ring verschieben.",
  ],
  "tools.widths.none-chosen": [
    "Pinch around a limb with two fingers, or tap it.",
    "Nimm einen Ast zwischen zwei Finger oder tippe ihn an.",
  ],
  "tools.widths.none": ["No width is set", "Keine Dicke festgelegt"],
  "tools.widths.one": ["One width is set", "Eine Dicke festgelegt"],
  "tools.widths.many": ["{count} widths are set", "{count} Dicken festgelegt"],
  "tools.width.choose": ["Width {width}: choose it", "Dicke {width}: auswählen"],
  "tools.width.diameter": ["Diameter", "Durchmesser"],
  "tools.width.value": ["{width} internodes", "{width} Internodien"],
  "tools.width.along": ["Place along the limb", "Stelle am Ast"],
  "tools.width.along.title": ["Drag to move the ring along the limb", "Ziehen verschiebt den Ring am Ast entlang"],
  "tools.width.remove": ["Remove this width", "Diese Dicke aufheben"],
  "tools.width.remove.title": ["Remove this width (Delete)", "Diese Dicke aufheben (Entf)"],
  "tools.width.leave": ["Leave this limb as it is", "Diesen Ast lassen, wie er ist"],
  "tools.width.typed": ["Diameter in internodes", "Durchmesser in Internodien"],
  "tools.pruning": ["Pruning", "Schnitt"],
  "tools.pruning.hint": [
    "Tap a branch, or draw a line through branches.",
    "Ast antippen oder Linie durch mehrere ziehen.",
  ],
  "tools.what-if": ["What if?", "Was wäre, wenn?"],
  "tools.what-if.help": [
    "Shows how the tree would grow on without a branch, before anything is cut.",
    "Zeigt, wie der Baum ohne einen Ast weiterwachsen würde, bevor etwas geschnitten wird.",
  ],
  "tools.dim": ["Darker than", "Dunkler als"],
  "tools.dim.help": [
    "Marks the branches that get less than this share of full light, to cut them all at once.",
    "Markiert die Äste, die weniger als diesen Teil des vollen Lichts bekommen, um sie alle auf einmal zu schneiden.",
  ],
  "tools.dim.none": ["none", "keine"],
  "tools.dim.one": ["{percent} in 100: 1 branch", "{percent} von 100: 1 Ast"],
  "tools.dim.many": ["{percent} in 100: {count} branches", "{percent} von 100: {count} Äste"],
  "tools.cut.none": ["None", "Keine"],
  "tools.cut.one": ["Cut 1 branch", "1 Ast schneiden"],
  "tools.cut.many": ["Cut {count} branches", "{count} Äste schneiden"],
  "tools.branch": ["This branch", "Dieser Ast"],
  "tools.branch.move": ["Move", "Versetzen"],
  "tools.branch.move.title": ["Move it to another limb", "An einen anderen Ast versetzen"],
  "tools.branch.copy": ["Copy", "Kopieren"],
  "tools.branch.copy.title": ["Set a copy of it on another limb", "Eine Kopie auf einen anderen Ast setzen"],
  "tools.branch.cut": ["Cut", "Schneiden"],
  "tools.branch.cut.title": ["Cut it off", "Abschneiden"],
  "tools.branch.predict.title": ["What would cutting it do?", "Was würde der Schnitt bewirken?"],
  "tools.prediction": ["Prediction", "Vorschau"],
  "tools.prediction.one": ["Without this branch, {steps} on", "Ohne diesen Ast, {steps} später"],
  "tools.prediction.many": ["Without these {count} branches, {steps} on", "Ohne diese {count} Äste, {steps} später"],
  "tools.prediction.growing": ["Growing the prediction", "Die Vorschau wächst"],
  "tools.prediction.steps": ["Steps ahead", "Schritte voraus"],
  "tools.prediction.steps.help": [
    "How many steps the tree grows on in the preview; the tree itself waits.",
    "So viele Schritte wächst der Baum in der Vorschau weiter; er selbst wartet.",
  ],
  "tools.prediction.discard": ["Discard", "Verwerfen"],
  "tools.prediction.discard.title": ["Discard (Esc)", "Verwerfen (Esc)"],
  "tools.prediction.keep": ["Keep this", "Übernehmen"],
} as const;
