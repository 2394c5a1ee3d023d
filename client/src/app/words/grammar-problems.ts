import type { GrammarDiagnostic, GrammarEnd } from "../../wire/generated";
import { GERMAN } from "./grammar-german";
import type { Text } from "./say";
import { say } from "./say";

/** What kinds of problems a grammar's text can have, in few words. */
const KINDS: Readonly<Record<string, Text>> = {
  "no-text": ["No text", "Kein Text"],
  "too-long": ["Too long", "Zu lang"],
  "too-deep": ["Too deep", "Zu tief"],
  "too-many-rules": ["Too many rules", "Zu viele Regeln"],
  "too-many-symbols": ["Too many names", "Zu viele Namen"],
  bracket: ["Brackets", "Klammern passen nicht"],
  missing: ["Something is missing", "Etwas fehlt"],
  unexpected: ["Too much", "Hier ist etwas zu viel"],
  "no-expression": ["No number", "Hier fehlt ein Ausdruck"],
  "bad-number": ["No number", "Keine Zahl"],
  "unknown-name": ["Unknown name", "Unbekannter Name"],
  "unknown-function": ["Unknown function", "Unbekannte Funktion"],
  "unknown-curve": ["Unknown curve", "Unbekannte Kurve"],
  "parameter-count": ["Number of parameters", "Anzahl der Parameter"],
  assignment: ["Assignment", "Zuweisung statt Vergleich"],
  python: ["Python", "Python"],
  c: ["C", "C"],
  "cpfg-statements": ["Statements of cpfg", "Anweisungen von cpfg"],
  groups: ["Groups", "Gruppen"],
  "sub-l-systems": ["Sub-L-systems", "Unter-L-Systeme"],
  "new-context": ["New context", "Neuer Kontext"],
  header: ["Header", "Kopfzeile"],
  "no-rule": ["No rule", "Keine Regel"],
  "no-axiom": ["No axiom", "Das Axiom fehlt"],
  "no-name": ["No name", "Ein Name fehlt"],
  "no-symbol": ["No module", "Kein Modul"],
  "no-choice": ["None of the choices", "Keine der Möglichkeiten"],
  "two-arrows": ["Two arrows", "Zwei Pfeile"],
  predecessor: ["Left side", "Linke Seite"],
  "bad-context": ["Context", "Kontext"],
  misplaced: ["Misplaced", "Am falschen Ort"],
  twice: ["Twice", "Doppelt"],
  "empty-range": ["Empty range", "Leerer Bereich"],
  "out-of-range": ["Out of range", "Außerhalb des Bereichs"],
  "bad-curve": ["Curve", "Kurve"],
  "no-probability": ["Probability", "Wahrscheinlichkeit"],
  "never-fires": ["Never used", "Wird nie angewendet"],
  "does-nothing": ["Does nothing", "Bewirkt nichts"],
  "not-drawn": ["Not drawn", "Wird nicht gezeichnet"],
  "lost-organs": ["On no wood", "Auf keinem Holz"],
  "surface-as-leaf": ["A leaf instead", "Ein Blatt dafür"],
  "no-angle": ["No angle", "Kein Winkel"],
  "tiny-pieces": ["Very small", "Sehr klein"],
};

/** What kind a problem is; of a kind that the page does not know, its code. */
export function kindText(code: string): string {
  const kind = KINDS[code];
  return kind ? say(kind) : code;
}

const SENTENCES: Readonly<Record<string, readonly [message: string, hint?: string]>> = GERMAN;

/** What is wrong with a text and what to write instead; of a sentence that the page does not know, as the server says it. */
export function sentenceOf({ id, values, message, hint }: Said): Pick<GrammarDiagnostic, "message" | "hint"> {
  const german = SENTENCES[id];
  const filled = (values ?? {}) as Readonly<Record<string, string>>;
  return {
    message: say([message, german?.[0] ?? message], filled),
    hint: hint === null ? null : say([hint, german?.[1] ?? hint], filled),
  };
}

/** Why a grammar cannot be derived further, without a full stop. */
export function endText(end: GrammarEnd): string {
  return sentenceOf({ ...end, hint: null }).message;
}

type Said = Pick<GrammarDiagnostic, "id" | "values" | "message" | "hint">;
