import type { Browser } from "playwright-core";
import { afterAll, beforeAll, expect, it } from "vitest";
import { Pairs, SPECIES } from "../exports/pairs";
import { launchBrowser } from "./browser";
import { Darkroom, type Picture } from "./picture";
import { shrunk } from "./reference";
import { Server } from "./server";

/** Pixels of a picture across and down. */
const SIDE = 240;
/** Pixels to a cell along each side: leaves are smaller than this, and edges of theirs may lie a little otherwise. */
const CELL = 6;
/** A cell that differs from the paper by more than this in one of its channels, of 256 steps, shows the tree. */
const APART = 20;
/** The feet of trees stand below this share of the picture, where the page alone has ground and shadow. */
const ABOVE_GROUND = 0.82;

/** What the page's picture of a tree and that of its file may differ by: renderers light leaves differently. */
const TOLERANCE = {
  /** Cells that show the tree in both pictures, of those that do in either. */
  overlap: 0.82,
  /** The mean colour of these, in steps of 256 a channel. */
  colour: 32,
};

let browser: Browser;
let server: Server;
let pairs: Pairs;
let darkroom: Darkroom;
/** The pictures of the species before. */
let before: readonly [Picture, Picture] | null = null;

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

it.each(SPECIES)("three.js shows the file of a %s as the page shows the tree", async (species) => {
  const { onScreen, inFile, found } = await pairs.of(species, SIDE);
  expect(found.textures).toBeGreaterThan(0);
  const [page, file] = [await cells(onScreen), await cells(inFile)];
  const agreement = agreementOf(page, file);
  expect(agreement, JSON.stringify(agreement)).toSatisfy(agrees);
  // So would not the file of another species.
  if (before) expect(agreementOf(before[0], file)).not.toSatisfy(agrees);
  before = [page, file];
});

function agrees({ overlap, colour }: Agreement): boolean {
  return overlap > TOLERANCE.overlap && colour.every((steps) => Math.abs(steps) < TOLERANCE.colour);
}

async function cells(png: Buffer): Promise<Picture> {
  const whole = await darkroom.develop(png);
  return shrunk(whole, (CELL * whole.width) / SIDE);
}

interface Agreement {
  readonly overlap: number;
  /** The file's mean colour over the cells of the tree, less the page's. */
  readonly colour: readonly number[];
}

function agreementOf(page: Picture, file: Picture): Agreement {
  const [inPage, inFile] = [treeIn(page), treeIn(file)];
  let [both, either] = [0, 0];
  const sum = [0, 0, 0];
  for (const [cell, there] of inPage.entries()) {
    if (there || inFile[cell]) either += 1;
    if (!there || !inFile[cell]) continue;
    both += 1;
    for (const channel of [0, 1, 2])
      sum[channel]! += file.pixels[cell * 4 + channel]! - page.pixels[cell * 4 + channel]!;
  }
  return { overlap: both / either, colour: sum.map((all) => all / both) };
}

/** Which cells show the tree: those that are not as the paper is at the left end of their row. */
function treeIn({ width, height, pixels }: Picture): boolean[] {
  const shown: boolean[] = [];
  for (let y = 0; y < Math.floor(height * ABOVE_GROUND); y++) {
    for (let x = 0; x < width; x++) {
      const apart = [0, 1, 2].map((channel) =>
        Math.abs(pixels[(y * width + x) * 4 + channel]! - pixels[y * width * 4 + channel]!),
      );
      shown.push(Math.max(...apart) > APART);
    }
  }
  return shown;
}
