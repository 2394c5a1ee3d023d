/** Bark and the form of branches. */
export const BRANCHES = {
  "branches.bark": ["Bark", "Rinde"],
  "branches.form": ["Form", "Form"],
  "branches.girth": ["Thickness", "Dicke"],
  "bark.kind": ["Kind of bark", "Art der Rinde"],
  "bark.kind.help": [
    "The pattern of the bark; twigs are smooth whatever the bark is.",
    "Das Muster der Rinde; Zweige sind in jedem Fall glatt.",
  ],
  "bark.kind.smooth": ["Smooth", "Glatt"],
  "bark.kind.furrowed": ["Furrowed", "Gefurcht"],
  "bark.kind.plated": ["Plated", "Schuppig"],
  "bark.kind.papery": ["Papery", "Papieren"],
  "bark.kind.flaking": ["Flaking", "Blätternd"],
  "bark.kind.banded": ["Banded", "Geringelt"],
  "bark.kind.stringy": ["Stringy", "Faserig"],
  "bark.tint": ["Colour of bark", "Rindenfarbe"],
  "bark.tint.help": ["The colour that the pattern is painted with.", "Die Farbe, mit der das Muster gemalt wird."],
  "bark.relief": ["Relief", "Relief"],
  "bark.relief.help": ["How deep furrows and plates look.", "Wie tief Furchen und Schuppen wirken."],
  "bark.root_flare": ["Root flare", "Wurzelanlauf"],
  "bark.root_flare.help": [
    "How far the trunk widens where it meets the ground.",
    "Wie weit sich der Stamm am Boden verbreitert.",
  ],
  "bark.collar": ["Collars", "Astkragen"],
  "bark.collar.help": [
    "How thick the wood swells where a branch leaves another.",
    "Wie dick das Holz anschwillt, wo ein Ast abzweigt.",
  ],
  "bark.smoothing": ["Smooth curves", "Glatte Kurven"],
  "bark.smoothing.help": [
    "From every node a corner to branches that curve without one.",
    "Von einem Knick an jedem Knoten bis zu Ästen, die sich weich krümmen.",
  ],
} as const;
