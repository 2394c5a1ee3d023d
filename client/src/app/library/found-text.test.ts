import { expect, it } from "vitest";
import { pieces } from "./found-text";

const marked = (text: string, words: string) =>
  pieces(text, words)
    .map(({ text, found }) => (found ? `[${text}]` : text))
    .join("");

it("words are marked wherever they stand, whatever their case and accents", () => {
  expect(marked("Érable by the lake", "LAKE erab")).toBe("[Érab]le by the [lake]");
  expect(marked("banana", "ana")).toBe("b[anana]");
  expect(marked("ﬁr 🌲 Fir", "ir")).toBe("[ﬁr] 🌲 F[ir]");
  expect(marked("I\u0307ris 𝔬ak", "ak")).toBe("I\u0307ris 𝔬[ak]");
  expect([marked("Oak", ""), marked("Oak", "elm"), marked("", "x")]).toEqual(["Oak", "Oak", ""]);
});
