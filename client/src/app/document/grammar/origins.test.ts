import { signal } from "@preact/signals";
import { describe, expect, it } from "vitest";
import type { GrammarInForce, GrammarOrigins } from "../../../wire/generated";
import { Origins } from "./origins";

const TEXT = "axiom: A\nA --> F[+A]A\n";
const ORIGINS: GrammarOrigins = {
  depth: 1,
  rules: [
    { line: 1, column: 1 },
    { line: 2, column: 1 },
  ],
  rows: [3, 5],
  by: [1, 1],
};

/** Origins whose server answers when it is let. */
function waiting() {
  const answers: ((origins: GrammarOrigins) => void)[] = [];
  const origins = new Origins({
    ask: () => new Promise((resolve) => answers.push(resolve)),
    inForce: signal({ text: TEXT } as GrammarInForce),
    revision: signal(0),
    failed: (error) => expect.unreachable(String(error)),
  });
  const answer = async () => {
    answers.shift()?.(ORIGINS);
    await new Promise((resolve) => setTimeout(resolve));
  };
  return { origins, answer };
}

describe("which rule made what", () => {
  it("is found for a line that was tapped before the server had answered", async () => {
    const { origins, answer } = waiting();
    origins.wanted.value = true;
    origins.lookAt(TEXT, TEXT.indexOf("-->"));
    expect(origins.line.value).toBe(null);
    await answer();
    expect(origins.line.value).toBe(2);
    expect(origins.rows.value).toEqual([3, 5]);
  });

  it("is found for a branch that was tapped before, the last one if there were several", async () => {
    const { origins, answer } = waiting();
    const found: (number | null)[] = [];
    origins.wanted.value = true;
    origins.look(4, (line) => found.push(line));
    origins.look(5, (line) => found.push(line));
    expect(found).toEqual([]);
    await answer();
    expect(found).toEqual([2]);
    origins.look(4, (line) => found.push(line));
    expect(found).toEqual([2, null]);
  });

  it("is not found any more when nobody wants to know", async () => {
    const { origins, answer } = waiting();
    origins.wanted.value = true;
    origins.lookAt(TEXT, TEXT.indexOf("-->"));
    origins.wanted.value = false;
    await answer();
    expect(origins.line.value).toBe(null);
  });
});
