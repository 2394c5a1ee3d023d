import type { NewMention } from "../../wire/generated";

/** So many letters after an @ may still be a name. */
const LONGEST = 40;
const ASKED = new RegExp(`(?:^|\\s|\\()@([^@\\n]{0,${LONGEST}})$`, "u");

/** Words of a text, and the name of whom they mention if they do. */
export interface Piece {
  readonly text: string;
  readonly name: string | null;
}

/** Somebody whom a comment may be for. */
export interface Candidate {
  readonly name: string;
  /** Their number where they are here; null of somebody who has written and is not. */
  readonly person: number | null;
}

/** Those who are here, and by name those who have written and are not; each once. */
export function candidates(here: readonly Candidate[], authors: readonly string[]): Candidate[] {
  const once = here.filter(({ person }, i) => here.findIndex((one) => one.person === person) === i);
  const others = authors.filter((name) => !once.some((one) => isSameName(one.name, name)));
  return [...once, ...others.map((name) => ({ name, person: null }))];
}

/** What one of them is shown as: where several have the name, with their number. */
export function labelOf(one: Candidate, all: readonly Candidate[]): string {
  const isShared = all.some((other) => other !== one && isSameName(other.name, one.name));
  return isShared && one.person !== null ? `${one.name} (${one.person})` : one.name;
}

/** Whom a comment is for: those who were chosen, and those whom its text names; `picked` says who was meant by a name. */
export function mentionsOf(
  text: string,
  all: readonly Candidate[],
  chosen: readonly Candidate[],
  picked: readonly Candidate[],
): NewMention[] {
  const named = mentionedIn(
    text,
    all.map(({ name }) => name),
  );
  const others = named.filter((name) => !chosen.some((one) => isSameName(one.name, name)));
  const meant = others.map((name): Candidate => {
    const called = (one: Candidate) => isSameName(one.name, name);
    const [only, ...more] = all.filter(called);
    return picked.findLast(called) ?? (only && more.length === 0 ? only : { name, person: null });
  });
  return [...chosen, ...meant].map(({ name, person }) => (person === null ? { name } : { name, person }));
}

/** What somebody types before the caret of a name, after an @; null where they type no name. */
export function asked(text: string, caret: number): string | null {
  return ASKED.exec(text.slice(0, caret))?.[1] ?? null;
}

/** Whom what was typed may become: those whose names begin so, then those of which a word does. */
export function matching(all: readonly Candidate[], typed: string): Candidate[] {
  const wanted = folded(typed);
  const begins = all.filter(({ name }) => folded(name).startsWith(wanted));
  const within = all.filter((one) => !begins.includes(one) && folded(one.name).includes(` ${wanted}`));
  // Whoever was named whole is not asked for any more.
  return [...begins, ...within].filter(({ name }) => folded(name) !== wanted.trim());
}

/** The text with the name in the place of what was typed of it, and where the caret then is. */
export function completed(
  text: string,
  caret: number,
  name: string,
): { readonly text: string; readonly caret: number } {
  const typed = asked(text, caret) ?? "";
  const before = `${text.slice(0, caret - typed.length)}${name} `;
  return { text: before + text.slice(caret).replace(/^ /u, ""), caret: before.length };
}

/** A text in pieces: mentions of these names, and what is between. */
export function piecesOf(text: string, names: readonly string[]): Piece[] {
  const pieces: Piece[] = [];
  // Of two names that begin alike the longer one is meant.
  const longestFirst = [...names].filter((name) => name !== "").sort((a, b) => b.length - a.length);
  let plain = 0;
  for (let at = text.indexOf("@"); at >= 0; at = text.indexOf("@", at + 1)) {
    const name = /[\p{L}\p{N}]$/u.test(text.slice(0, at))
      ? undefined
      : longestFirst.find((one) => isNamed(text, at, one));
    if (name === undefined || at < plain) {
      continue;
    }
    const end = at + 1 + name.length;
    pieces.push({ text: text.slice(plain, at), name: null }, { text: text.slice(at, end), name });
    plain = end;
  }
  return [...pieces, { text: text.slice(plain), name: null }].filter((piece) => piece.text !== "");
}

/** Who of these is mentioned in a text, each once. */
export function mentionedIn(text: string, names: readonly string[]): string[] {
  return [...new Set(piecesOf(text, names).flatMap(({ name }) => (name === null ? [] : [name])))];
}

/** Whether two names are the same but for how they are written. */
export function isSameName(name: string, other: string): boolean {
  return other !== "" && folded(name) === folded(other);
}

function isNamed(text: string, at: number, name: string): boolean {
  const end = at + 1 + name.length;
  return isSameName(text.slice(at + 1, end), name) && !/^[\p{L}\p{N}]/u.test(text.slice(end));
}

function folded(text: string): string {
  return text.normalize("NFKD").replace(/\p{M}/gu, "").toLowerCase();
}
