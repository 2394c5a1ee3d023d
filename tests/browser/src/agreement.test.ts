import type { Browser } from "playwright-core";
import { afterAll, beforeAll, expect, it } from "vitest";
import { type Agreement, agreementOf } from "../exports/agreement";
import { Pairs, SPECIES } from "../exports/pairs";
import { launchBrowser } from "./browser";
import { Darkroom, type Picture } from "./picture";
import { shrunk } from "./reference";
import { Server } from "./server";

/** Pixels of a picture across and down. */
const SIDE = 240;
/** Pixels to a cell along each side: leaves are smaller than this, and edges of theirs may lie a little otherwise. */
const CELL = 6;

/** What the page's picture of a tree and another one may differ by: renderers light leaves differently. */
interface Tolerance {
  /** Cells that show the tree in both pictures, of those that do in either, are more than this share. */
  readonly overlap: number;
  /** Their mean colours are nearer than this, in steps of 256 a channel. */
  readonly colour: number;
}

/** That of what three.js makes of a file: the page's edges of leaves are soft. */
const FILE: Tolerance = { overlap: 0.82, colour: 32 };
/** That of the server's own picture, whose paper, seen through crowns, is lighter. */
const DRAWN: Tolerance = { overlap: 0.94, colour: 40 };

let browser: Browser;
let server: Server;
let pairs: Pairs;
let darkroom: Darkroom;
/** The page's picture of the species before. */
let before: Picture | null = null;

beforeAll(async () => {
  server = new Server();
  browser = await launchBrowser();
  await server.start();
  pairs = await Pairs.open(server, browser);
  darkroom = await Darkroom.open(browser);
});

afterAll(async () => {
  await browser?.close();
  await server?.stop();
});

it.each(SPECIES)("three.js and the server show a %s as the page does", async (species) => {
  const stood = await pairs.stand(species, SIDE);
  const { found, picture } = await stood.file("glb");
  expect(found.textures).toBeGreaterThan(0);
  const page = await cells(stood.onScreen);
  const file = await cells(picture);
  const drawn = await cells(await stood.picture());
  for (const [by, cells, tolerance] of [
    ["three.js", file, FILE],
    ["the server", drawn, DRAWN],
  ] as const) {
    const agreement = agreementOf(page, cells);
    expect(agreement, `${by}: ${JSON.stringify(agreement)}`).toSatisfy(within(tolerance));
    // So would not the picture of another species.
    if (before) expect(agreementOf(before, cells), by).not.toSatisfy(within(tolerance));
  }
  before = page;
});

function within(tolerance: Tolerance): (agreement: Agreement) => boolean {
  return ({ overlap, colour }) =>
    overlap > tolerance.overlap && colour.every((steps) => Math.abs(steps) < tolerance.colour);
}

async function cells(png: Buffer): Promise<Picture> {
  const whole = await darkroom.develop(png);
  return shrunk(whole, (CELL * whole.width) / SIDE);
}
