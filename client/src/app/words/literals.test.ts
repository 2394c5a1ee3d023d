import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import ts from "typescript";
import { describe, expect, it } from "vitest";
import { LANGUAGES } from "./languages";

const APP = join(import.meta.dirname, "..");

/** Attributes that are read to people or shown to them. */
const READ = new Set([
  "title",
  "alt",
  "placeholder",
  "label",
  "aria-label",
  "aria-valuetext",
  "aria-description",
  "hint",
]);
/** Functions whose argument is shown to people as it is. */
const SHOWN = /(?:\btoasts\.show|\bnew Error|\bnew RequestFailed)$/;
/** A word of a language: units, signs, names of keys and figures are none. */
const WORD = /\p{L}{3,}/u;
/** A literal that is a sentence or a heading wherever it stands. */
const PROSE = /^\p{Lu}[\p{Ll}’']+[ ,.:…!?]/u;
/** Where a tool says what it is, each text in all languages side by side (`Text`). */
const OWN_TEXTS = /^tools\/\w+\/(descriptor|later)\.tsx$/;
/** A literal that is a name within the program, as a class or a sheet's, and no text. */
const NAME = /^[a-z0-9_-]*$/;

const sources = (readdirSync(APP, { recursive: true, encoding: "utf8" }) as string[]).filter(
  (file) => /\.tsx?$/.test(file) && !/\.test\.|^words/.test(file),
);

/** Texts for people that stand in a source, and not in the table. */
function literals(name: string, text: string): string[] {
  const source = ts.createSourceFile(name, text, ts.ScriptTarget.Latest, true, ts.ScriptKind.TSX);
  const found: string[] = [];
  const note = (node: ts.Node, words: string) => {
    const { line } = source.getLineAndCharacterOfPosition(node.getStart());
    found.push(`${name}:${line + 1}: ${words.trim()}`);
  };
  /** The literals an expression may have as its value. */
  const values = (node: ts.Node): ts.Node[] => {
    if (ts.isConditionalExpression(node)) return [...values(node.whenTrue), ...values(node.whenFalse)];
    if (ts.isBinaryExpression(node)) return [...values(node.left), ...values(node.right)];
    if (ts.isParenthesizedExpression(node) || ts.isAsExpression(node)) return values(node.expression);
    return [node];
  };
  const check = (expression: ts.Node) => {
    for (const node of values(expression)) {
      if (ts.isStringLiteralLike(node) && WORD.test(node.text) && !NAME.test(node.text)) note(node, node.text);
      if (ts.isTemplateExpression(node)) {
        const words = [node.head.text, ...node.templateSpans.map(({ literal }) => literal.text)].join(" ");
        if (WORD.test(words)) note(node, node.getText());
      }
    }
  };
  const visit = (node: ts.Node): void => {
    if (ts.isJsxText(node) && WORD.test(node.text)) note(node, node.text);
    if (ts.isJsxExpression(node) && node.expression && !ts.isJsxAttribute(node.parent)) check(node.expression);
    if (ts.isJsxAttribute(node) && node.initializer && READ.has(node.name.getText())) {
      const value = ts.isJsxExpression(node.initializer) ? node.initializer.expression : node.initializer;
      if (value && ts.isStringLiteral(value) && /\p{L}/u.test(value.text)) note(value, value.text);
      else if (value) check(value);
    }
    if (ts.isStringLiteralLike(node) && PROSE.test(node.text) && !isLogged(node) && !isOwn(name, node))
      note(node, node.text);
    const called = ts.isCallExpression(node) || ts.isNewExpression(node) ? node : null;
    const callee = called && `${ts.isNewExpression(called) ? "new " : ""}${called.expression.getText()}`;
    if (called && callee && SHOWN.test(callee)) called.arguments?.forEach(check);
    ts.forEachChild(node, visit);
  };
  visit(source);
  return [...new Set(found)];
}

/** Whether it is one of a tool's own texts, with its translation beside it. */
function isOwn(name: string, { parent }: ts.Node): boolean {
  return OWN_TEXTS.test(name) && ts.isArrayLiteralExpression(parent) && parent.elements.length === LANGUAGES.length;
}

/** Whether it goes to the console, which is for programmers. */
function isLogged({ parent }: ts.Node): boolean {
  return ts.isCallExpression(parent) && parent.expression.getText().startsWith("console.");
}

/** Errors nobody but a programmer sees. */
const FOR_PROGRAMMERS: readonly RegExp[] = [/connection\.ts:.*is out of order/, /replaced\.ts:/];

describe("texts in the sources", () => {
  it("are found where they stand", () => {
    const caught = literals(
      "a.tsx",
      `<p title="Hi" class="big one">{a ? "Grow it" : b}<b>Leaf</b>{\`\${n} steps\`}{say("x.y")}</p>; toasts.show("Too far"); const a = ["Two fingers", "two"]; console.warn("No tree here");`,
    );
    expect(caught.map((line) => line.replace(/^.*?: /, ""))).toEqual([
      "Hi",
      "Grow it",
      "Leaf",
      `\`\${n} steps\``,
      "Too far",
      "Two fingers",
    ]);
  });

  it("a tool's own stand beside their translations", () => {
    const source = `const label = ["Cut it", "Ab damit"]; const alone = ["Cut all"];`;
    expect(literals("tools/saw/descriptor.tsx", source)).toHaveLength(1);
    expect(literals("tools/saw/saw-tool.ts", source)).toHaveLength(3);
  });

  it("none is left: each is in the table", () => {
    expect(sources.length).toBeGreaterThan(80);
    const left = sources
      .flatMap((file) => literals(file, readFileSync(join(APP, file), "utf8")))
      .filter((line) => !FOR_PROGRAMMERS.some((known) => known.test(line)));
    expect(left).toEqual([]);
  });
});
