import type { Text } from "./say";

/**
 * What the signs of the turtle and of rules do, in few words, as the keys of the editor and its short reference show
 * them: in pairs, the most used first.
 */
export const SIGNS: readonly (readonly [sign: string, does: Text])[] = [
  ["[", ["a branch begins", "ein Ast beginnt"]],
  ["]", ["the branch ends", "der Ast endet"]],
  ["(", ["numbers begin", "Zahlen beginnen"]],
  [")", ["numbers end", "Zahlen enden"]],
  ["+", ["turn left", "nach links drehen"]],
  ["-", ["turn right", "nach rechts drehen"]],
  ["&", ["pitch down", "nach unten neigen"]],
  ["^", ["pitch up", "nach oben neigen"]],
  ["/", ["roll right", "nach rechts rollen"]],
  ["\\", ["roll left", "nach links rollen"]],
  ["F", ["wood, one step forward", "Holz, ein Schritt vorwärts"]],
  ["A", ["a module of your own", "ein eigenes Modul"]],
  ["-->", ["becomes", "wird zu"]],
  [":", ["condition, or probability", "Bedingung oder Wahrscheinlichkeit"]],
  [",", ["between numbers", "zwischen Zahlen"]],
  ["!", ["width", "Dicke"]],
  ["<", ["what stands below", "was darunter steht"]],
  [">", ["what stands above", "was darüber steht"]],
  ["*", ["times, or nothing", "mal, oder nichts"]],
  ["=", ["a number gets a name", "eine Zahl bekommt einen Namen"]],
  ["|", ["turn about", "umdrehen"]],
  ["$", ["level", "waagrecht stellen"]],
  ["%", ["cut the rest of the branch", "den Rest des Asts abschneiden"]],
  ["~l", ["a leaf: read, not drawn", "ein Blatt: wird gelesen, nicht gezeichnet"]],
  ["{", ["no wood from here", "ab hier kein Holz"]],
  ["}", ["wood again", "wieder Holz"]],
];

/** Lines of a file, and what they say. */
export const LINES: readonly (readonly [line: string, says: Text])[] = [
  [
    "axiom: A",
    ["what it begins with; the one line that must be there", "womit es beginnt; die einzige Zeile, die sein muss"],
  ],
  ["A --> F[+A]A", ["in each step each A becomes this", "in jedem Schritt wird jedes A hierzu"]],
  ["A(x) : x > 1 --> F(x)A(x/2)", ["only where the condition holds", "nur wo die Bedingung gilt"]],
  ["A --> F : 0.3", ["one of several, by chance", "eine von mehreren, nach Zufall"]],
  ["L < A > R --> F", ["only between L and R", "nur zwischen L und R"]],
  ["derivation length: 6", ["how often rules are used", "wie oft Regeln angewandt werden"]],
  ["angle: 30", ["degrees of turns without a number", "Grad für Drehungen ohne Zahl"]],
  ["scale: 5", ["internodes in one F", "Internodien in einem F"]],
  ["a = 28", ["a number with a name", "eine Zahl mit Namen"]],
  ["slider: a 10 60", ["makes a slider of it", "macht einen Regler daraus"]],
  ["ignore: + - F", ["what contexts do not see", "was Kontexte nicht sehen"]],
  ["module Leaf", ["a name of several letters", "ein Name aus mehreren Buchstaben"]],
  ["homomorphism:", ["rules below it are for drawing alone", "Regeln darunter gelten nur fürs Zeichnen"]],
  ["// note", ["for readers", "für Leser"]],
];
