import type { GrammarDiagnostic } from "../../../wire/generated";
import type { Token } from "./grammar-tokens";

/** A stretch of a text. */
export interface Range {
  readonly from: number;
  readonly to: number;
}

/** Where a line and a column are, counted from 1 in characters, as the server counts; within the text whatever they say. */
export function placeAt(text: string, line: number, column: number): number {
  let from = 0;
  for (let passed = 1; passed < line; passed += 1) {
    const next = text.indexOf("\n", from);
    if (next < 0) {
      return text.length;
    }
    from = next + 1;
  }
  const end = text.indexOf("\n", from);
  return advanced(text, from, column - 1, end < 0 ? text.length : end);
}

/** Line and column of a place, counted from 1 in characters. */
export function lineAndColumn(text: string, place: number): { line: number; column: number } {
  const before = text.slice(0, Math.max(0, place));
  const start = before.lastIndexOf("\n") + 1;
  return { line: before.split("\n").length, column: [...before.slice(start)].length + 1 };
}

/** What a problem concerns; something that is missing is shown on the character before, or on the one behind. */
export function rangeOf(
  text: string,
  { line, column, length }: Pick<GrammarDiagnostic, "line" | "column" | "length">,
): Range {
  const from = placeAt(text, line, column);
  const end = text.indexOf("\n", from);
  const to = advanced(text, from, length, end < 0 ? text.length : end);
  if (to > from) {
    return { from, to };
  }
  const before = text[from - 1];
  return before !== undefined && before !== "\n"
    ? { from: from - 1, to: from }
    : { from, to: Math.min(from + 1, text.length) };
}

/** The first of the problems that a caret stands in or beside, by its number; those it stands in go first. */
export function problemAt(ranges: readonly Range[], caret: number): number | null {
  const inside = ranges.findIndex(({ from, to }) => from <= caret && caret < to);
  const beside = inside >= 0 ? inside : ranges.findIndex(({ from, to }) => from <= caret && caret <= to);
  return beside < 0 ? null : beside;
}

/** A piece of the highlighted layer: a token, or the part of one that lies in a problem. */
export interface Piece extends Token {
  /** The first problem that it lies in, by its number. */
  readonly problem?: number;
  /** Whether it belongs to the rule that is looked at. */
  readonly looked?: boolean;
}

/** Tokens, cut where problems begin and end. */
export function pieces(tokens: readonly Token[], ranges: readonly Range[], looked: Range | null = null): Piece[] {
  const edges = [...ranges, ...(looked ? [looked] : [])].flatMap(({ from, to }) => [from, to]).sort((a, b) => a - b);
  return tokens.flatMap((token) => {
    const inside = edges.filter((edge) => edge > token.from && edge < token.to);
    const cuts = [token.from, ...new Set(inside), token.to];
    return cuts.slice(1).map((to, i): Piece => {
      const from = cuts[i] ?? token.from;
      const problem = ranges.findIndex((range) => range.from < to && from < range.to);
      const isLooked = looked !== null && looked.from < to && from < looked.to;
      return { ...token, from, to, ...(problem < 0 ? {} : { problem }), ...(isLooked ? { looked: true } : {}) };
    });
  });
}

/** The lines that a rule takes: the one it begins on, and those that are indented below it. */
export function ruleRange(text: string, line: number): Range {
  const from = placeAt(text, line, 1);
  let end = endOfLine(text, from);
  for (;;) {
    const next = text.slice(end + 1, endOfLine(text, end + 1));
    if (end >= text.length || !/^[ \t]+\S/.test(next) || /-->|^\s*\p{L}[\p{L}\p{N}_ ]*[:=]/u.test(next)) {
      return { from, to: end };
    }
    end = endOfLine(text, end + 1);
  }
}

/** A text after something is put in the place of what is selected, and where the caret then stands. */
export function inserted(text: string, { from, to }: Range, sign: string): { text: string; caret: number } {
  return { text: text.slice(0, from) + sign + text.slice(to), caret: from + sign.length };
}

/** Where a caret stands after the text around it was changed by somebody else: with what it stood at, as far as that is left. */
export function carriedCaret(before: string, after: string, caret: number): number {
  let same = 0;
  while (same < caret && before[same] === after[same] && same < after.length) {
    same += 1;
  }
  if (same === caret) {
    return caret;
  }
  const behind = before.length - caret;
  let tail = 0;
  while (tail < behind && before[before.length - 1 - tail] === after[after.length - 1 - tail]) {
    tail += 1;
  }
  return tail === behind ? Math.max(0, after.length - behind) : Math.min(same, after.length);
}

function endOfLine(text: string, from: number): number {
  const end = text.indexOf("\n", from);
  return end < 0 ? text.length : end;
}

/** The place so many characters further, but not beyond an end. */
function advanced(text: string, from: number, characters: number, end: number): number {
  let at = from;
  for (let left = characters; left > 0 && at < end; left -= 1) {
    at += (text.codePointAt(at) ?? 0) > 0xffff ? 2 : 1;
  }
  return Math.min(at, end);
}
