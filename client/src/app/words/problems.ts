/** What a server refuses, for people; what it says that is not here is shown as it says it. */
export const PROBLEMS = {
  "problems.branch-gone": [
    "That branch is gone: someone has just cut it, or the tree has shed it.",
    "Diesen Ast gibt es nicht mehr: Jemand hat ihn gerade geschnitten, oder der Baum hat ihn abgeworfen.",
  ],
  "problems.nothing-to-undo": ["There is nothing to undo.", "Es gibt nichts rückgängig zu machen."],
  "problems.nothing-to-redo": ["There is nothing to redo.", "Es gibt nichts zu wiederholen."],
  "problems.nothing-to-ungrow": [
    "The tree is a seed; it cannot grow back any further.",
    "Der Baum ist ein Samen; weiter kann er nicht zurückwachsen.",
  ],
  "problems.no-dim-branch": ["No branch stands in so little light.", "Kein Ast steht in so wenig Licht."],
  "problems.trunk-foot": [
    "That branch is the foot of a trunk, which cannot be turned.",
    "Dieser Ast ist der Fuß eines Stamms; der lässt sich nicht drehen.",
  ],
  "problems.trunk-moved": [
    "That is the foot of a trunk, which cannot be moved.",
    "Das ist der Fuß eines Stamms; er lässt sich nicht versetzen.",
  ],
  "problems.trunk-cut": [
    "The trunk cannot be cut off: nothing branches off below.",
    "Der Stamm lässt sich nicht abschneiden: Darunter zweigt nichts ab.",
  ],
  "problems.being-bent": [
    "Someone is bending that branch; wait until it is let go.",
    "Jemand biegt diesen Ast gerade; warte, bis er losgelassen wird.",
  ],
  "problems.own-branch": ["A branch cannot be set on itself.", "Ein Ast lässt sich nicht auf sich selbst setzen."],
  "problems.world": ["The branch would leave the world.", "Der Ast würde über den Rand der Welt hinausragen."],
  "problems.outline": [
    "Nothing can grow into this outline. Draw it around some room.",
    "In diesen Umriss kann nichts wachsen. Zeichne ihn um etwas Raum herum.",
  ],
  "problems.widths": [
    "There are {limit} widths set, which is the most. Remove some first.",
    "Es sind schon {limit} Dicken festgelegt, mehr geht nicht. Entferne zuerst einige.",
  ],
  "problems.places": [
    "The history holds as much moved wood as it can. Undo something first.",
    "Die Vorgeschichte fasst nicht mehr bewegtes Holz. Nimm zuerst etwas zurück.",
  ],
  "problems.full": [
    "The tree has all the growth this document holds.",
    "Der Baum ist so groß, wie dieses Dokument es erlaubt.",
  ],
  "problems.obstacles": [
    "There are {limit} obstacles in the scene; remove one first.",
    "In der Szene sind schon {limit} Hindernisse; entferne zuerst eines.",
  ],
  "problems.people": ["Too many people are here already.", "Hier sind schon zu viele Leute."],
  "problems.out-of-range": ["That value is not possible.", "Dieser Wert ist nicht möglich."],
  "problems.out-of-range.allowed": ["Allowed there: {allowed}.", "Möglich ist dort: {allowed}."],
  "problems.silent": ["The server does not answer. Is it running?", "Der Server antwortet nicht. Läuft er?"],
  "problems.unexplained": [
    "The server answered with status {status} and no reason.",
    "Der Server antwortete mit Status {status} und ohne Grund.",
  ],
} as const;
