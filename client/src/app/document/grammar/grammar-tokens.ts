import { FUNCTIONS, HEADERS, TURTLE, type TurtleKind } from "./grammar-names";

/** What a piece of a grammar's text is, as far as colours tell it. */
export type TokenKind =
  | TurtleKind
  | "plain"
  | "comment"
  | "header"
  | "text"
  | "rewritten"
  | "module"
  | "name"
  | "function"
  | "number"
  | "operator"
  | "arrow"
  | "foreign";

/** A piece of the text, by its places in it. */
export interface Token {
  readonly from: number;
  readonly to: number;
  readonly kind: TokenKind;
  /** How many branches lie around a bracket, the one that it begins or ends among them. */
  readonly nesting?: number;
}

const ARROW = "-->";
const WORD = /^[\p{L}_][\p{L}\p{N}_]*/u;
const NUMBER = /^(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?/;
/** Words that C and Python have and grammars have not. */
const FOREIGN = /^(?:if|else|for|while|def|return|import|from|print|nproduce|produce|Start|StartEach|End|EndEach)\b/;

/** What stands behind the name of a header; `definition` begins with a name and an equals sign. */
interface Head {
  readonly length: number;
  readonly content: "text" | "modules" | "rules" | "numbers";
}

/** Cuts a grammar's text into pieces that follow each other without gaps; never fails, for texts are wrong while they are typed. */
export function tokens(text: string): Token[] {
  return new Tokeniser(text).all();
}

class Tokeniser {
  readonly #text: string;
  readonly #found: Token[] = [];
  readonly #names: readonly string[];
  readonly #rewritten: ReadonlySet<string>;
  /** Whether a comment between signs has begun and not ended. */
  #insideComment = false;
  #at = 0;
  #end = 0;
  #nesting = 0;

  constructor(text: string) {
    this.#text = text;
    this.#names = namesIn(text);
    this.#rewritten = rewrittenIn(text, this.#names);
  }

  all(): Token[] {
    /** What an indented line goes on with. */
    let before: Head["content"] = "rules";
    let from = 0;
    for (const line of this.#text.split(/(?<=\n)/)) {
      [this.#at, this.#end] = [from, from + line.length];
      from = this.#end;
      if (!this.#insideComment) {
        before = this.#line(before);
      } else {
        this.#comment();
        this.#rest(before);
      }
    }
    return this.#found;
  }

  /** A line; what it was, for the next one may go on with it. */
  #line(before: Head["content"]): Head["content"] {
    const indent = /^[ \t]*/.exec(this.#left)?.[0] ?? "";
    this.#take("plain", indent.length);
    const left = this.#left;
    if (left.trim() === "") {
      this.#take("plain", left.length);
      return before;
    }
    if (this.#beginsComment(true)) {
      this.#rest(before);
      return before;
    }
    const head = headOf(left);
    if (head) {
      this.#nesting = 0;
      this.#take("header", head.length);
      this.#rest(head.content);
      return head.content;
    }
    if (FOREIGN.test(left) && !left.includes(ARROW)) {
      this.#take("foreign", left.trimEnd().length);
      this.#rest("rules");
      return "rules";
    }
    if (isDefinition(left)) {
      this.#rest("numbers");
      return "numbers";
    }
    if (left.includes(ARROW)) {
      this.#nesting = 0;
      this.#rest("rules");
      return "rules";
    }
    this.#rest(indent === "" ? "rules" : before);
    return before;
  }

  /** The rest of a line. */
  #rest(content: Head["content"]): void {
    if (content === "text") {
      this.#take("plain", this.#left.length - this.#left.trimStart().length);
      this.#take("text", this.#left.trimEnd().length);
      this.#take("plain", this.#left.length);
      return;
    }
    let isExpression = content === "numbers";
    /** Whether the arrow has been passed: before it `<` and `>` are contexts and a colon begins the condition. */
    let isBehind = !this.#left.includes(ARROW);
    while (this.#left !== "") {
      const left = this.#left;
      if (this.#beginsComment(false)) {
        continue;
      }
      if (left.startsWith(ARROW)) {
        this.#take("arrow", ARROW.length);
        [isExpression, isBehind] = [false, true];
        this.#nesting = 0;
      } else if (content === "rules" && left.startsWith(":")) {
        this.#take("operator", 1);
        isExpression = true;
      } else if (isExpression) {
        this.#term();
      } else if (!isBehind && /^[<>]/.test(left)) {
        this.#take("operator", 1);
      } else {
        this.#module();
      }
    }
  }

  /** A module with its parameters. */
  #module(): void {
    const left = this.#left;
    if (/^\s/.test(left)) {
      this.#take("plain", 1);
      return;
    }
    const number = /^\d/.test(left) ? NUMBER.exec(left)?.[0] : undefined;
    if (number !== undefined) {
      this.#take("number", number.length);
      return;
    }
    if (left.startsWith("(")) {
      this.#parameters();
      return;
    }
    const name = this.#nameAt(left);
    const turtle = TURTLE.get(name);
    if (turtle === "branch") {
      this.#bracket(name);
    } else if (turtle !== undefined) {
      this.#take(this.#rewritten.has(name) && turtle === "silent" ? "rewritten" : turtle, name.length);
    } else if (name.startsWith("~")) {
      this.#take("organ", name.length);
    } else if (WORD.test(name)) {
      this.#take(this.#rewritten.has(name) ? "rewritten" : "module", name.length);
    } else {
      this.#take("plain", name.length);
    }
  }

  #bracket(name: string): void {
    if (name === "[") {
      this.#nesting += 1;
      this.#take("branch", 1, this.#nesting);
    } else {
      this.#take("branch", 1, this.#nesting);
      this.#nesting = Math.max(0, this.#nesting - 1);
    }
  }

  /** What stands in parentheses behind a module; where the closing one is missing, the rest of the line. */
  #parameters(): void {
    let open = 0;
    while (this.#left !== "") {
      const sign = this.#left[0];
      if (this.#left.startsWith(ARROW) || sign === "\n") {
        return;
      }
      open += sign === "(" ? 1 : sign === ")" ? -1 : 0;
      this.#term();
      if (open === 0) {
        return;
      }
    }
  }

  /** A piece of an expression. */
  #term(): void {
    const left = this.#left;
    const blanks = /^\s+/.exec(left)?.[0];
    if (blanks !== undefined) {
      this.#take("plain", blanks.length);
      return;
    }
    const word = WORD.exec(left)?.[0];
    if (word !== undefined) {
      this.#take(FUNCTIONS.has(word) ? "function" : "name", word.length);
      return;
    }
    const number = NUMBER.exec(left)?.[0];
    if (number !== undefined) {
      this.#take("number", number.length);
      return;
    }
    this.#take("operator", /^(?:\|\||&&|[=!<>]=|\*\*)/.test(left) ? 2 : pointLength(left));
  }

  /** The name of the module that a text begins with: the longest that is declared, else one character. */
  #nameAt(left: string): string {
    return (
      (left.startsWith("nF(") ? "nF" : undefined) ??
      this.#names.find((name) => left.startsWith(name)) ??
      /^~[\p{L}\p{N}]/u.exec(left)?.[0] ??
      left.slice(0, pointLength(left))
    );
  }

  /** Takes a comment, if one begins here. */
  #beginsComment(isLineStart: boolean): boolean {
    const left = this.#left;
    if (left.startsWith("/*")) {
      this.#comment();
      return true;
    }
    const before = this.#text[this.#at - 1] ?? "\n";
    if (/\s/.test(before) && isLineComment(left, isLineStart)) {
      const length = left.trimEnd().length;
      this.#take("comment", length);
      this.#take("plain", this.#left.length);
      return true;
    }
    return false;
  }

  /** Takes what belongs to a comment between signs, up to the end of the line at most. */
  #comment(): void {
    const left = this.#left;
    const end = left.indexOf("*/", this.#insideComment ? 0 : 2);
    this.#insideComment = end < 0;
    this.#take("comment", end < 0 ? left.length : end + 2);
  }

  get #left(): string {
    return this.#text.slice(this.#at, this.#end);
  }

  #take(kind: TokenKind, length: number, nesting?: number): void {
    if (length === 0) {
      return;
    }
    const [from, to] = [this.#at, this.#at + length];
    this.#at = to;
    const last = this.#found[this.#found.length - 1];
    if (last && last.kind === kind && nesting === undefined && last.nesting === undefined && JOINED.has(kind)) {
      this.#found[this.#found.length - 1] = { ...last, to };
    } else {
      this.#found.push(nesting === undefined ? { from, to, kind } : { from, to, kind, nesting });
    }
  }
}

/** What needs no piece of its own for each sign. */
const JOINED: ReadonlySet<TokenKind> = new Set(["plain", "comment", "operator", "turn", "silent"]);

/** The header that a line begins with. */
function headOf(line: string): Head | null {
  for (const [name, needsColon, content] of HEADERS) {
    const found = headPattern(name, needsColon).exec(line);
    if (found && (found[0].trimEnd().endsWith(":") || !line.includes(ARROW))) {
      return { length: found[0].length, content };
    }
  }
  return null;
}

const PATTERNS = new Map<string, RegExp>();

function headPattern(name: string, needsColon: boolean): RegExp {
  const known = PATTERNS.get(name);
  if (known) {
    return known;
  }
  const words = name.replaceAll(" ", "[ \\t]+");
  const made = new RegExp(`^${words}${needsColon ? "\\s*:" : "(?:\\s*:|(?=\\s|$))"}`, "i");
  PATTERNS.set(name, made);
  return made;
}

/** Whether a line gives a number a name. */
function isDefinition(line: string): boolean {
  return /^\p{L}[\p{L}\p{N}_]*\s*=(?!=)/u.test(line) && !line.includes(ARROW);
}

/** Whether what a line goes on with is a comment, which the signs of the turtle begin with as well. */
function isLineComment(left: string, isLineStart: boolean): boolean {
  if (left.startsWith("//")) {
    return /^\/\/(?:\s|$)/.test(left) || (isLineStart && /^\/\/[^/([]/.test(left));
  }
  const isDirective = /^#(?:define|include|if|ifdef|ifndef|else|endif|undef)(?![\p{L}\p{N}])/u.test(left);
  return left.startsWith("#") && (/^#(?:\s|$)/.test(left) || (isLineStart && !isDirective && /^#[^/([]/.test(left)));
}

/** Names of more than one character, the longest first: those of the turtle, and those that the text declares. */
function namesIn(text: string): string[] {
  const long = [...TURTLE.keys()].filter((name) => name.length > 1 && name !== "nF");
  for (const [, declared = ""] of text.matchAll(/^[ \t]*module[ \t:]+(.*)$/gim)) {
    for (const part of declared.split(",")) {
      const name = WORD.exec(part.trim())?.[0];
      if (name !== undefined && name.length > 1) {
        long.push(name);
      }
    }
  }
  return long.sort((a, b) => b.length - a.length);
}

/** The modules that rules rewrite. */
function rewrittenIn(text: string, names: readonly string[]): ReadonlySet<string> {
  const found = new Set<string>();
  for (const line of text.split("\n")) {
    const arrow = line.indexOf(ARROW);
    if (arrow >= 0) {
      found.add(strictOf(line.slice(0, arrow), names));
    }
  }
  return found;
}

/** The module that a rule rewrites, of what stands before its arrow. */
export function strictOf(before: string, names: readonly string[]): string {
  // What stands in parentheses may hold the signs of contexts.
  const bare = before.replace(/\([^()]*\)/g, "").split(":")[0] ?? "";
  const behind = bare.split("<").pop() ?? "";
  const strict = behind.split(">")[0]?.trim() ?? "";
  return names.find((name) => strict.startsWith(name)) ?? strict.slice(0, pointLength(strict));
}

/** How many units of a text its first character takes. */
function pointLength(text: string): number {
  return (text.codePointAt(0) ?? 0) > 0xffff ? 2 : 1;
}
