import { describe, expect, it } from "vitest";
import type { ExportFormat } from "../../wire/generated";
import { FIRST_CHOICE, framesOf, framesOffered, isExportChoice, optionsOf } from "./export-choice";

const GLB: ExportFormat = {
  ending: "glb",
  label: ["Model", "Modell"],
  text: ["Wood and leaves.", "Holz und Blätter."],
  options: ["lod", "quantised", "author"],
  bytes: [1000, 10, 20],
  levels: [1, 0.5, 0.1, 0],
  shares: { quantised: [0.5, 0.25] },
};

describe("a choice", () => {
  it("asks only for what the format has", () => {
    const choice = { ...FIRST_CHOICE, lod: "2", on: ["quantised", "hull"], author: " Ada ", licence: "CC0-1.0" };
    expect([...optionsOf(choice, GLB)]).toEqual([
      ["lod", "2"],
      ["quantised", "true"],
      ["author", "Ada"],
    ]);
    expect([...optionsOf(FIRST_CHOICE, GLB)]).toEqual([]);
  });

  it("asks for one picture of a turntable, and for several of a loop, which would stand still else", () => {
    const [turntable, loop] = ["png", "sway.png"].map((ending) => ({ ...GLB, ending, options: ["frames"] }));
    const one = { ...FIRST_CHOICE, frames: "1" };
    expect([framesOffered(turntable!).includes("1"), framesOffered(loop!).includes("1")]).toEqual([true, false]);
    expect([...optionsOf(one, turntable!)]).toEqual([["frames", "1"]]);
    expect([...optionsOf(one, loop!)]).toEqual([["frames", framesOf(one, loop!)]]);
    expect(framesOffered(loop!)).toContain(framesOf(one, loop!));
    expect(framesOf({ ...one, frames: "72" }, loop!)).toBe("72");
  });

  it("asks for light maps of so many texels where the format can have them", () => {
    const lit = { ...GLB, options: ["lightmap"] };
    expect([...optionsOf({ ...FIRST_CHOICE, lightmap: "1024" }, lit)]).toEqual([["lightmap", "1024"]]);
    expect([...optionsOf({ ...FIRST_CHOICE, lightmap: "1024" }, GLB)]).toEqual([]);
    expect([...optionsOf({ ...FIRST_CHOICE, lightmap: "" }, lit)]).toEqual([]);
    const swaying = { ...GLB, options: ["sway", "instanced"] };
    const choice = { ...FIRST_CHOICE, sway: "64", on: ["instanced"] };
    expect([...optionsOf(choice, swaying)], "leaves that are instances stand still").toEqual([["sway", "64"]]);
    const weighed = { ...GLB, options: ["wind_weights", "instanced"] };
    expect([...optionsOf({ ...choice, on: ["instanced", "wind_weights"] }, weighed)]).toEqual([
      ["wind_weights", "true"],
    ]);
    expect([...optionsOf({ ...choice, sway: "" }, swaying)]).toEqual([["instanced", "true"]]);
    expect([
      isExportChoice({ ...FIRST_CHOICE, lightmap: "1024" }),
      isExportChoice({ ...FIRST_CHOICE, lightmap: 1 }),
    ]).toEqual([true, false]);
  });

  it("asks for the page's own view where it is wanted and the format has one", () => {
    const seen = new Map([
      ["turn", "30"],
      ["fov", "32"],
    ]);
    const picture = { ...GLB, options: ["turn", "fov"] };
    const choice = { ...FIRST_CHOICE, camera: "seen" };
    expect([...optionsOf(choice, picture, seen)]).toEqual([...seen]);
    expect([...optionsOf(choice, GLB, seen), ...optionsOf(FIRST_CHOICE, picture, seen)]).toEqual([]);
    expect([...optionsOf(choice, picture, null), ...optionsOf(choice, picture)]).toEqual([]);
    expect([isExportChoice(choice), isExportChoice({ ...choice, camera: true })]).toEqual([true, false]);
  });

  it("asks for pictures of so many pixels, also from the page's own view", () => {
    const picture = { ...GLB, options: ["size", "turn"] };
    const seen = new Map([
      ["size", "800x500"],
      ["turn", "30"],
    ]);
    const choice = { ...FIRST_CHOICE, size: "1920x1080" };
    expect([...optionsOf(choice, picture)]).toEqual([["size", "1920x1080"]]);
    expect(optionsOf({ ...choice, camera: "seen" }, picture, seen).get("size")).toBe("1920x1080");
    expect(optionsOf({ ...choice, size: "", camera: "seen" }, picture, seen).get("size")).toBe("800x500");
    expect([...optionsOf(choice, GLB), ...optionsOf(FIRST_CHOICE, picture)]).toEqual([]);
    expect([isExportChoice(choice), isExportChoice({ ...choice, size: 1080 })]).toEqual([true, false]);
  });

  it("asks for so many points where the format is made of them", () => {
    const cloud = { ...GLB, options: ["points"] };
    expect([...optionsOf(FIRST_CHOICE, cloud)]).toEqual([["points", "1000000"]]);
    expect([...optionsOf({ ...FIRST_CHOICE, points: "5000000" }, cloud)]).toEqual([["points", "5000000"]]);
    expect([...optionsOf({ ...FIRST_CHOICE, points: "5000000" }, GLB)]).toEqual([]);
  });

  it("that something else was kept as is none", () => {
    expect(isExportChoice(FIRST_CHOICE)).toBe(true);
    for (const other of [null, 3, {}, { ...FIRST_CHOICE, on: "hull" }, { ...FIRST_CHOICE, lod: 1 }]) {
      expect(isExportChoice(other)).toBe(false);
    }
  });
});
