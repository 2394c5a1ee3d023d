import { readFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { describe, expect, it } from "vitest";
import { FIRST } from "./first";
import { LATER } from "./later";

const SOURCES = join(import.meta.dirname, "../..");

/** The files that a file loads together with itself. */
function importsOf(file: string, source: string): string[] {
  const found = source.matchAll(/^(?:import|export) (?!type )(?:[^;"]*? from )?"(\.[^"]+)";/gm);
  return [...found]
    .map(([, path]) => join(dirname(file), path!))
    .flatMap((path) => [path, `${path}.ts`, `${path}.tsx`].filter((path) => /\.tsx?$/.test(path) && isFile(path)));
}

function isFile(path: string): boolean {
  return sourceOf(path) !== null;
}

function sourceOf(path: string): string | null {
  try {
    return readFileSync(path, "utf8");
  } catch {
    return null;
  }
}

/** Everything that is loaded with a file, itself among it. */
function loadedWith(file: string): ReadonlyMap<string, string> {
  const loaded = new Map<string, string>();
  const waiting = [file];
  for (let next = waiting.pop(); next !== undefined; next = waiting.pop()) {
    const source = sourceOf(next);
    if (source !== null && !loaded.has(next)) {
      loaded.set(next, source);
      waiting.push(...importsOf(next, source));
    }
  }
  return loaded;
}

/** The names of texts in a source that a page has only later: whole names, and those that begin as a template does. */
function laterKeys(source: string): string[] {
  const keys = Object.keys(LATER);
  const whole = [...source.matchAll(/"([a-z][\w-]*\.[\w.-]+)"/g)].map(([, key]) => key!).filter((key) => key in LATER);
  const begun = [...source.matchAll(/say\(`([^`$]*)\$/g)].map(([, start]) => start!);
  return [...whole, ...begun.filter((start) => keys.some((key) => key.startsWith(start)))];
}

describe("texts of the first picture", () => {
  const loaded = loadedWith(join(SOURCES, "main.tsx"));

  it("what is loaded with the page says nothing that the page has only later", () => {
    expect(loaded.size).toBeGreaterThan(100);
    const early = [...loaded]
      .filter(([file]) => !file.startsWith(import.meta.dirname))
      .flatMap(([file, source]) => laterKeys(source).map((key) => `${relative(SOURCES, file)}: ${key}`));
    expect(early).toEqual([]);
  });

  it("later texts are found where they are said", () => {
    const source = `say("help.search"); say("bars.undo"); say(\`help.card.\${name}\`)`;
    expect(laterKeys(source)).toEqual(["help.search", "help.card."]);
  });

  it("no text is in both tables", () => {
    expect(Object.keys(FIRST).filter((key) => key in LATER)).toEqual([]);
  });
});
