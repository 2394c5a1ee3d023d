import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { language } from "../words/say";
import { plainly } from "./plain-words";
import { ALLOWED, REFUSALS } from "./refusal-table";

const SERVER = join(import.meta.dirname, "../../../../server");

/** Where the server makes problems, and where the errors are worded that it passes on. */
const SOURCES = ["session/src", "src/http", "src/import.rs", "../proto/src/thumbnail.rs"];
const PASSED_ON = ["growth/src/edit_error.rs", "src/live/restoring.rs", "../proto/src/mesh.rs"];
/** What the types of `proto` allow that a person can get wrong. */
const OF_TYPES = ["1 to 1000", "0.01 to 100", "box, sphere or plane"];
/** What `proto/src/reading.rs` puts together from a field and what stands there. */
const OF_FIELDS = ["outline has 7 entries; allowed: a list of 7 to 7 entries"];
const OF_FILES = ["import/src/lib.rs"];
const OF_SHAPES = ["growth/src/obstacles/checks.rs"];

/** One place where a problem is worded. */
interface Wording {
  readonly place: string;
  /** The words with something in each hole; null where they are put together elsewhere. */
  readonly words: string | null;
  readonly source: string;
}

/** Where problems are made without words of their own: the words come from what is looked through besides. */
const BORROWED = new Set([
  // An `EditError`, a range of parameters or of looks.
  "error.to_string()",
  "ProblemCode::Malformed, error.to_string()",
  // Functions that are given the words, and variables that hold them.
  "impl Into<String>",
  "message: impl Into<String>",
  "ProblemCode::Refused, message",
  "ProblemCode::Refused, sentence",
  "ProblemCode::Stale, sentence",
  "ProblemCode::Malformed, message",
  "ProblemCode::Unavailable, sentence",
  "ProblemCode::TooMany, message",
  "None, &allowed, sentence",
  "sentence",
  "",
  // What is no problem but has such a name.
  "species.sentence.to_owned()",
  "ClientMessage::from_json(text)",
  "transparent",
]);

function rustOf(path: string): readonly (readonly [string, string])[] {
  const files = path.endsWith(".rs")
    ? [path]
    : (readdirSync(join(SERVER, path), { recursive: true, encoding: "utf8" }) as string[])
        .filter((file) => file.endsWith(".rs") && !file.includes("tests"))
        .map((file) => join(path, file));
  return files.map((file) => {
    const [shipped = ""] = readFileSync(join(SERVER, file), "utf8").split("#[cfg(test)]\nmod ");
    return [file, shipped.replace(/^\s*\/\/.*$/gm, "")];
  });
}

/** What stands between a place and the end of its list or value. */
function upToEnd(text: string, from: number, ends: string): string {
  let depth = 0;
  for (let i = from; i < text.length; i++) {
    const sign = text.charAt(i);
    if (sign === '"') {
      for (i++; text.charAt(i) !== '"'; i++) if (text.charAt(i) === "\\") i++;
    } else if ("([{".includes(sign)) depth++;
    else if (")]}".includes(sign) && depth-- === 0) return text.slice(from, i);
    else if (depth === 0 && ends.includes(sign)) return text.slice(from, i);
  }
  return text.slice(from);
}

const literalsIn = (text: string) =>
  [...text.matchAll(/"((?:[^"\\]|\\[\s\S])*)"/g)].map(([, words = ""]) =>
    words.replace(/\\\n\s*/g, "").replace(/\{[^}]*\}/g, "7"),
  );

/** Every wording after a marker in the sources. */
function wordings(
  paths: readonly string[],
  marker: RegExp,
  ends: string,
  pick: (words: string[]) => string | undefined,
) {
  return paths.flatMap(rustOf).flatMap(([file, text]) =>
    [...text.matchAll(marker)].map((match): Wording => {
      const from = match.index + match[0].length;
      const source = upToEnd(text, from, ends);
      const line = text.slice(0, match.index).split("\n").length;
      return {
        place: `${file}:${line}`,
        words: pick(literalsIn(source)) ?? null,
        source: source.trim().replace(/\s+/g, " "),
      };
    }),
  );
}

const first = (words: string[]) => words[0];
const last = (words: string[]) => words[words.length - 1];

/** All problems but those of ranges. */
function refusals(): readonly Wording[] {
  return [
    ...wordings(SOURCES, /(?<!fn )\brefused\(|\bProblem::new\(/g, "", first),
    ...wordings(SOURCES, /(?<=\n\s*)(?:let )?(?:message|sentence)(?:: | = )(?![&,])/g, ",;", first),
    ...wordings(SOURCES, /\b(?:Failure|Self)::(?:unavailable|conflict|too_large)\(/g, "", last),
    ...wordings(SOURCES, /\bFailure::not_found\(/g, "", first).map((one) => ({
      ...one,
      words: `There is no such ${one.words}.`,
    })),
    ...wordings(PASSED_ON, /#\[error\(/g, "", first),
  ];
}

const known = (table: typeof REFUSALS, words: string) => table.some(([pattern]) => pattern.test(words));

/** What a client of this very server can only say wrongly; it is shown in one sentence. */
const FOR_PROGRAMMERS =
  /^the message is|^the command cannot be read|cannot be read: 7$|^kind is|^hello is|^clients send|^The request (must|cannot)|first message|^this server speaks|client key has|^after is not|^ticket is/;
/** Why a session was not restored is written to the log, why a socket closes to nobody. */
const FOR_THE_LOG = /^The session cannot be read|^7: 7$/;

describe("what the server refuses", () => {
  it("is found in its sources, none without words", () => {
    const all = refusals();
    expect(all.length).toBeGreaterThan(60);
    expect(all.filter(({ words, source }) => words === null && !BORROWED.has(source))).toEqual([]);
    expect(all.filter(({ words }) => words !== null).length).toBeGreaterThan(50);
  });

  it("is among our words, all of it", () => {
    const foreign = refusals().filter(
      ({ words }) =>
        words !== null && !known(REFUSALS, words) && !FOR_PROGRAMMERS.test(words) && !FOR_THE_LOG.test(words),
    );
    expect(foreign.map(({ place, words }) => `${place}: ${words}`)).toEqual([]);
  });

  it("so are causes why a file or shape is none", () => {
    const ofFiles = wordings(OF_FILES, /#\[error\(/g, "", first);
    const ofShapes = wordings(OF_SHAPES, /#\[error\(/g, "", first);
    expect([ofFiles.length > 5, ofShapes.length > 5]).toEqual([true, true]);
    language.value = "de";
    try {
      for (const { words } of ofFiles) {
        const shown = plainly({ code: "malformed", message: `The file cannot be an obstacle: ${words}.` });
        expect(shown, `${words}`).toMatch(/Datei|Modell/);
      }
      for (const { words } of ofShapes) {
        const shown = plainly({ code: "out_of_range", message: `the shape cannot be an obstacle: ${words}` });
        expect(shown, `${words}`).toMatch(/Form|Modell/);
      }
    } finally {
      language.value = "en";
    }
  });

  it("what would be allowed is shown as well", () => {
    const all = wordings(SOURCES, /\bProblem::out_of_range\(/g, "", last).map((one) => {
      // The last of three arguments.
      const [words] = literalsIn(one.source.slice(lastComma(one.source)));
      return { ...one, words: words ?? null };
    });
    expect(all.length).toBeGreaterThan(5);
    expect(OF_TYPES.filter((words) => !known(ALLOWED, words))).toEqual([]);
    const foreign = all.filter(({ words }) => words !== null && !known(ALLOWED, words) && !OF_HANDS.test(words));
    expect(foreign.map(({ place, words }) => `${place}: ${words}`)).toEqual([]);
  });

  it("every entry of the table is needed", () => {
    const files = wordings(OF_FILES, /#\[error\(/g, "", first).map(({ words }) => `it cannot be: ${words}`);
    const shapes = wordings(OF_SHAPES, /#\[error\(/g, "", first).map(({ words }) => `it cannot be: ${words}`);
    const own = refusals().flatMap(({ words }) => [words ?? "", (words ?? "").replace(/7$/, "turned")]);
    const said = [...own, ...files, ...shapes, ...OF_FIELDS];
    const idle = REFUSALS.filter(([pattern]) => !said.some((words) => pattern.test(words)));
    expect(idle.map(([pattern]) => String(pattern))).toEqual([]);
  });
});

/** Where the last argument of a call begins. */
function lastComma(call: string): number {
  let at = 0;
  for (let from = 0; from < call.length; ) {
    const argument = upToEnd(call, from, ",");
    if (argument.trim() !== "") at = from;
    from += argument.length + 1;
  }
  return at;
}

/** What no user can do wrongly, only a program: it is shown without what would be allowed. */
const OF_HANDS =
  /length 1|perpendicular|finite number|touched once|^7 to 7 rows|^parameters$|path|^the ending of a file$|^more than 0$/;
