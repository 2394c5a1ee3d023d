import { readFileSync } from "node:fs";
import { expect, it } from "vitest";
import type { ExportFormat } from "../../wire/generated";
import {
  isDrawn,
  LEAST_SIDE,
  MOST_DRAWN,
  MOST_PIXELS,
  PICTURE_SIZES,
  pixelsDrawn,
  sizeIn,
  sizeText,
  USUAL_SIZES,
  withSide,
} from "./picture-size";

const PICTURE: ExportFormat = {
  ending: "png",
  label: ["Picture", "Bild"],
  text: ["A picture.", "Ein Bild."],
  options: ["size", "frames"],
  bytes: [1000, 0, 0],
  levels: [1, 1, 1, 1],
  shares: {},
};

it("EX6: sizes and their limits are the server's", () => {
  const source = (path: string) => readFileSync(new URL(`../../../../server/src/${path}`, import.meta.url), "utf8");
  const number = (text: string, name: string) =>
    Number(new RegExp(`const ${name}: \\w+ = ([\\d_]+);`).exec(text)?.[1]?.replaceAll("_", ""));
  const options = source("export_options.rs");
  expect(number(options, "MOST_PIXELS")).toBe(MOST_PIXELS);
  expect(Number(/width >= (\d+) && height >= /.exec(options)?.[1])).toBe(LEAST_SIDE);
  expect(number(source("http/exports.rs"), "MOST_DRAWN")).toBe(MOST_DRAWN);
  const usual = (name: string) =>
    new RegExp(`const ${name}: \\(Size, u16\\) = \\(Size\\((\\d+), (\\d+)\\)`).exec(source("formats.rs"))?.slice(1, 3);
  expect([usual("STILL")?.join("x"), usual("LOOP")?.join("x")]).toEqual(
    ["png", "sway.png"].map((ending) => sizeText(USUAL_SIZES[ending]!)),
  );
});

it("every size that is offered is one that the server makes", () => {
  for (const text of PICTURE_SIZES) {
    const size = sizeIn(text)!;
    expect(size.width * size.height).toBeLessThanOrEqual(MOST_PIXELS);
    expect(sizeText(size)).toBe(text);
  }
  expect([sizeIn(""), sizeIn(undefined), sizeIn("12"), sizeIn("axb")]).toEqual([null, null, null, null]);
});

it("a side that is typed stays within what a picture may have", () => {
  const size = { width: 1000, height: 8000 };
  const changed = (side: "width" | "height", pixels: number) => {
    const { size: now, kept } = withSide(size, side, pixels);
    return [sizeText(now), kept?.to, kept?.pixels];
  };
  expect(changed("width", 1500.4)).toEqual(["1500x8000", undefined, undefined]);
  expect(changed("width", 2000), "just so much").toEqual(["2000x8000", undefined, undefined]);
  expect(changed("width", 9000), "and says what it was cut to").toEqual(["2000x8000", "most", 2000]);
  expect(changed("height", 3)).toEqual([`1000x${LEAST_SIDE}`, "least", LEAST_SIDE]);
});

it("EX6: counts the pixels of all pictures of a file", () => {
  const of = (size: string, frames: string) =>
    new Map(Object.entries({ size, frames }).filter(([, value]) => value !== ""));
  expect(pixelsDrawn(PICTURE, of("", ""))).toBe(1_000_000);
  expect(pixelsDrawn(PICTURE, of("100x50", "36"))).toBe(180_000);
  expect(pixelsDrawn({ ...PICTURE, ending: "glb" }, of("", ""))).toBe(0);
  expect([isDrawn(PICTURE, of("3840x2160", "36")), isDrawn(PICTURE, of("3840x2160", "72"))]).toEqual([true, false]);
});
