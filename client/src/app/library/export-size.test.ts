import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { PlainTable } from "../../../test/plain-table";
import { sampleTree } from "../../../test/sample-tree";
import { DEFAULT_APPEARANCE, type ExportFormat } from "../../wire/generated";
import { amountOf, bytesExpected } from "./export-size";

const GLB: ExportFormat = {
  ending: "glb",
  label: ["Model", "Modell"],
  text: ["Wood and leaves.", "Holz und Blätter."],
  options: ["lod", "quantised", "author"],
  bytes: [1000, 10, 20],
  levels: [1, 0.5, 0.1, 0],
  shares: { quantised: [0.5, 0.25] },
};

interface Sizes {
  readonly trees: readonly {
    readonly species: string;
    readonly metamers: number;
    readonly leaves: number;
    readonly borne: number;
    readonly sprays: boolean;
  }[];
  readonly files: readonly {
    readonly ending: string;
    readonly options: Readonly<Record<string, string>>;
    readonly bytes: readonly number[];
  }[];
}

const here = (path: string) => readFileSync(new URL(path, import.meta.url), "utf8");
const sizes = JSON.parse(here("../../../test/export-sizes.json")) as Sizes;

/** The server's formats, from the table in its sources. */
function formats(): ReadonlyMap<string, ExportFormat> {
  const source = here("../../../../server/src/formats.rs");
  const numbers = (text: string) => text.split(",").map(Number);
  const levels = (name: string) =>
    numbers(new RegExp(`const ${name}: \\[f64; 4\\] = \\[(.*?)\\];`).exec(source)![1]!) as ExportFormat["levels"];
  const shares = Object.fromEntries(
    [...source.matchAll(/\(option::(\w+), \[([\d., ]+)\]\)/g)].map(([, name, both]) => [
      name!.toLowerCase(),
      numbers(both!) as [number, number],
    ]),
  );
  const rows = source.matchAll(/row\(\s*Format::(\w+),\s*\["([^"]+)"[^\]]*\],([^;]*?)\[([\d.e, ]+)\],?\s*\)[,;]/g);
  return new Map(
    [...rows].map(([, format, ending, options, bytes]) => [
      ending!,
      {
        ...GLB,
        ending: ending!,
        options: /LOD|MESHES|SCENES/.test(options!) ? ["lod"] : [],
        bytes: numbers(bytes!) as ExportFormat["bytes"],
        levels: levels(/Obj|UsdaZip/.test(format!) ? "PACKED_LEVELS" : /Usd/.test(format!) ? "USD_LEVELS" : "LEVELS"),
        shares,
      },
    ]),
  );
}

/** What is shown is no less than this. */
const SHOWN = 100_000;
/** Pictures go by what is seen on them, documents by what was done in them. */
const LOOSE = ["png", "espalier"];

describe("the size of a file", () => {
  it("goes by metamers, leaves, level and options", () => {
    const tree = { metamers: 100, leaves: 10, sprays: false, borne: 0 };
    expect(bytesExpected(GLB, new Map(), tree)).toBe(2200);
    expect(bytesExpected(GLB, new Map([["quantised", "true"]]), tree)).toBe(1550);
    expect(bytesExpected(GLB, new Map([["lod", "set"]]), tree)).toBeCloseTo(2920);
    expect(bytesExpected(GLB, new Map([["lod", "3"]]), { ...tree, borne: 5 })).toBe(1000);
    expect(bytesExpected(GLB, new Map(), { ...tree, borne: 5 })).toBe(2300);
    expect(bytesExpected(GLB, new Map(), { ...tree, sprays: true })).toBe(2450);
  });

  it("of pictures goes by their pixels", () => {
    const tree = { metamers: 100, leaves: 10, sprays: false, borne: 0 };
    const picture = { ...GLB, ending: "png", options: ["size", "frames"], bytes: [1000, 0, 0] } as ExportFormat;
    const bytes = (options: Record<string, string>) => bytesExpected(picture, new Map(Object.entries(options)), tree);
    expect(bytes({})).toBe(1000);
    expect(bytes({ size: "2000x2000", frames: "3" })).toBe(12_000);
  });

  it("is within a factor of 1.5 of five species in every format with triangles or structure", () => {
    const known = formats();
    expect(sizes.files.length).toBeGreaterThan(30);
    const far: string[] = [];
    for (const { ending, options, bytes } of sizes.files) {
      const format = known.get(ending)!;
      for (const [i, tree] of sizes.trees.entries()) {
        const expected = bytesExpected(format, new Map(Object.entries(options)), tree);
        const ratio = Math.max(SHOWN, expected) / Math.max(SHOWN, bytes[i]!);
        const most = LOOSE.includes(ending) ? 4 : 1.5;
        if (ratio > most || ratio < 1 / most) {
          far.push(`${tree.species} ${ending} ${JSON.stringify(options)}: ${ratio.toFixed(2)}`);
        }
      }
    }
    expect(far).toEqual([]);
  });

  it("counts what the tree has in its look", () => {
    const table = new PlainTable(() => 0);
    table.apply(sampleTree({ seed: 5, height: 30, orders: 3 }));
    const bare = amountOf(table, DEFAULT_APPEARANCE);
    expect(bare.metamers).toBe(table.rows - 1);
    expect(bare.leaves).toBeGreaterThan(100);
    expect([bare.borne, bare.sprays]).toEqual([0, false]);
    const { leaves, flowers } = DEFAULT_APPEARANCE;
    const inBlossom = { ...DEFAULT_APPEARANCE, flowers: { ...flowers, kind: "rosette", share: 1 } as const };
    expect(amountOf(table, inBlossom).borne).toBeGreaterThan(100);
    const winter = { ...DEFAULT_APPEARANCE, leaves: { ...leaves, season: 3 } };
    expect(amountOf(table, winter).leaves).toBeLessThan(0.1 * bare.leaves);
    expect(amountOf(table, { ...winter, leaves: { ...leaves, shape: "needle" } }).sprays).toBe(true);
  });
});
