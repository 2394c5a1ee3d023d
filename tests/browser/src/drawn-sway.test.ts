import { readFile } from "node:fs/promises";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import type { DrawnRow, drawnSway } from "../../../client/test/drawn-sway";
import { perform } from "../gallery/performance";
import { bundled } from "./bundled";
import { theBrowser, theServer } from "./shared";

const CLIENT = join(import.meta.dirname, "../../../client");
const BINARY = join(import.meta.dirname, "../../../server/grammar/grammars/barron-binary.lsys");
const STORM = { speed: 18, direction: 40, rise: 1, turbulence: 0.8, suppleness: 1.5, sag: 0.3 };
/** Seconds after the storm was set. */
const TIMES = [1.1, 7.3, 61.7];
/** Rows that are compared of each plant and time. */
const COMPARED = 60;
/** Shares of the plant's height by which what is drawn may be elsewhere than what a finger meets. */
const CLOSE = 1e-4;
/** So much the numbers of a turn may differ. */
const ALIKE = 1e-3;

let page: Page;
let code: string;
beforeAll(async () => {
  code = await bundled(join(CLIENT, "test/drawn-sway.ts"), CLIENT);
  page = await (await theBrowser()).newPage();
});
afterAll(() => page.close());

const server = theServer();

/** A session in which commands are done. */
async function planted(commands: readonly object[]): Promise<string> {
  const address = await server.newSession(5);
  const session = address.slice(address.lastIndexOf("/") + 1);
  await page.goto(`${server.address}/health`);
  await perform(
    page,
    session,
    commands.map((each) => JSON.stringify(each)),
  );
  return session;
}

async function ofSpecies(slug: string, steps: number): Promise<string> {
  const species = (await (await fetch(`${server.address}/api/v1/species`)).json()) as {
    readonly slug: string;
    readonly programme: object;
  }[];
  const { programme } = species.find((each) => each.slug === slug)!;
  return planted([
    { kind: "set_programme", programme },
    { kind: "grow", steps },
  ]);
}

async function ofBarron(): Promise<string> {
  const text = await readFile(BINARY, "utf8");
  return planted([{ kind: "set_grammar", text, position: [0, 0, 0], depth: 8 }]);
}

/** Trunk, forks and tips alike: of each so many, spread over the plant from its lowest row to its highest. */
function spread(rows: readonly DrawnRow[]): DrawnRow[] {
  const kinds = [
    rows.filter(({ isFork }) => isFork),
    rows.filter(({ isTip }) => isTip),
    rows.filter(({ isFork, isTip }) => !isFork && !isTip),
  ];
  return kinds.flatMap((kind) => {
    const byDepth = kind.toSorted((a, b) => a.depth - b.depth);
    const many = Math.min(kind.length, COMPARED / kinds.length);
    return Array.from({ length: many }, (_, i) => byDepth[Math.floor((i * byDepth.length) / many)]!);
  });
}

const apart = (a: readonly number[], b: readonly number[]) => Math.hypot(...a.map((each, i) => each - b[i]!));

test.each<[string, () => Promise<string>]>([
  ["a weeping willow", () => ofSpecies("weeping-willow", 9)],
  ["a Scots pine", () => ofSpecies("scots-pine", 12)],
  ["Barron's binary tree", ofBarron],
])("in a storm the graphics card draws %s where fingers meet it", async (_name, plant) => {
  const session = await plant();
  await page.goto(`${server.address}/health`);
  // Joints are made on the page, which is none of the client's and has no file of its worker.
  await page.evaluate("Worker = undefined");
  await page.evaluate(code);
  for (const seconds of TIMES) {
    const rows = await page.evaluate(
      ([session, storm, seconds]) =>
        (globalThis as unknown as { bundled: { drawnSway: typeof drawnSway } }).bundled.drawnSway(
          session,
          storm,
          seconds,
        ),
      [session, STORM, seconds] as const,
    );
    const height = Math.max(...rows.map(({ rest }) => rest[1]));
    const compared = spread(rows);
    expect(compared.length).toBeGreaterThan(45);
    const stiff = compared.filter(({ shivers }) => shivers === null);
    expect(stiff.length, "of rows that bend").toBeGreaterThan(15);
    for (const { row, drawn, met } of stiff) {
      expect(apart(drawn.shift, met.shift) / height, `row ${row} after ${seconds} s`).toBeLessThan(CLOSE);
      expect(apart(drawn.turn, met.turn), `turn of row ${row} after ${seconds} s`).toBeLessThan(ALIKE);
    }
    // A twig that is too stiff to bend shivers about its foot beside that, in the fastest air by less than a tenth.
    const shivering = compared.filter(({ shivers }) => shivers !== null);
    for (const { row, drawn, met, shivers } of shivering) {
      const within = 0.1 * shivers! + CLOSE * height;
      expect(apart(drawn.shift, met.shift), `twig at row ${row} after ${seconds} s`).toBeLessThan(within);
    }
    const trembles = Math.max(...shivering.map(({ drawn, met, shivers }) => apart(drawn.shift, met.shift) / shivers!));
    expect(trembles, "radians about its foot").toBeGreaterThan(0.005);
    const shift = Math.max(...compared.map(({ met }) => Math.hypot(...met.shift)));
    expect(shift / height, "and it is a storm").toBeGreaterThan(0.02);
  }
});
