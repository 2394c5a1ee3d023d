import { expect, it } from "vitest";

const sources = import.meta.glob<string>(["./glsl/*.ts", "./motion/sway-shaders.ts"], {
  query: "?raw",
  import: "default",
  eager: true,
});

it("no shader chooses between structures with a ternary, which WebGL refuses", () => {
  const texts = Object.entries(sources);
  const names = texts.flatMap(([, text]) => [...text.matchAll(/\bstruct (\w+)/g)].map(([, name]) => name));
  expect(names).toContain("Bark");
  const structures = names.join("|");
  const chosen = new RegExp(`\\b(?:${structures}) \\w+ = [^;(]*\\?|\\? ?(?:${structures})\\(`);
  expect(chosen.test("Bark bark = uShown.z > 0.5 ? barkAt(a) : plainBark(a);")).toBe(true);
  expect(texts.filter(([, text]) => chosen.test(text)).map(([file]) => file)).toEqual([]);
});

const modules = import.meta.glob<Record<string, unknown>>("./glsl/*.ts", { eager: true });

it("no vertex shader asks how something differs from pixel to pixel, which only fragments know", () => {
  const exported = Object.values(modules).flatMap((module) => Object.entries(module));
  const vertices = exported.filter(([name]) => /vertex/i.test(name));
  expect(vertices.length).toBeGreaterThan(5);
  for (const [name, made] of vertices) {
    const text = typeof made === "function" ? (made as () => unknown)() : made;
    expect(String(text), name).not.toMatch(/\b(dFdx|dFdy|fwidth)\b/);
  }
});
