import { execFile } from "node:child_process";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";
import { inflateRawSync } from "node:zlib";
import type { Browser } from "playwright-core";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { agreementOf } from "../exports/agreement";
import { type Shot, shotOf } from "../exports/shot";
import { type Seen, Viewer } from "../exports/viewer";
import { launchBrowser } from "./browser";
import { Darkroom, type Picture } from "./picture";
import { shrunk } from "./reference";
import { program } from "./server";

const run = promisify(execFile);

/** Pixels of a picture across and down, and of a cell of it. */
const SIDE = 240;
const CELL = 6;

let browser: Browser;
let viewer: Viewer;
let darkroom: Darkroom;
let folder: string;

beforeAll(async () => {
  folder = await mkdtemp(join(tmpdir(), "espalier-readers-"));
  browser = await launchBrowser();
  viewer = await Viewer.open(browser);
  darkroom = await Darkroom.open(browser);
});

afterAll(async () => {
  await browser?.close();
  await rm(folder, { recursive: true, force: true });
});

/** A species as a file of the program. */
async function exported(species: string, ending: string, options: readonly string[] = []): Promise<Buffer> {
  const file = join(folder, `tree.${ending}`);
  await run(program, ["grow", "--species", species, "--export", file, ...options]);
  const bytes = await readFile(file);
  await rm(file);
  return bytes;
}

async function shot(species: string): Promise<Shot> {
  return shotOf(JSON.parse((await exported(species, "json")).toString()));
}

async function cells(png: Buffer): Promise<Picture> {
  const whole = await darkroom.develop(png);
  return shrunk(whole, (CELL * whole.width) / SIDE);
}

/** How far what others see of two files is the same. */
async function agreement(one: Buffer, other: Buffer) {
  return agreementOf(await cells(one), await cells(other));
}

/** The first file of an archive in which it is deflated. */
function firstInflated(archive: Buffer): Buffer {
  const [nameLength, moreLength] = [archive.readUInt16LE(26), archive.readUInt16LE(28)];
  return inflateRawSync(archive.subarray(30 + nameLength + moreLength));
}

type Bounds = Seen["found"]["box"];

/** The most by which two boxes differ, in metres. */
function apart(one: Bounds, other: Bounds): number {
  return Math.max(...[0, 1].flatMap((end) => one[end]!.map((at, axis) => Math.abs(at - other[end]![axis]!))));
}

describe("three.js reads USD", () => {
  it.each([
    ["cherry", "usda"],
    ["cherry", "usda.zip"],
    ["cherry", "usdz"],
    ["maple", "usdz"],
  ])("and shows the wood of a %s in .%s, with the faces of its cuts, as in glTF", async (species, ending) => {
    const [eye, level] = [await shot(species), ["--lod", "1"]];
    const gltf = await exported(species, "glb", level);
    const plain = await viewer.see({ ending: "glb", bytes: gltf }, SIDE, SIDE, eye, { wood: true });
    const bytes = await exported(species, ending, level);
    const text = ending === "usda.zip" ? firstInflated(bytes) : bytes;
    expect(text.includes('def GeomSubset "Cut"'), "a thick tip ends in the face of a cut").toBe(true);
    const { found, wood, picture } = await viewer.see({ ending, bytes }, SIDE, SIDE, eye, { wood: true });
    expect(found.wood).toBe(plain.found.wood);
    expect(found.triangles).toBe(plain.found.triangles);
    const ofWood = await agreement(plain.wood!, wood!);
    expect(ofWood.overlap, JSON.stringify(ofWood)).toBeGreaterThan(0.95);
    const ofAll = await agreement(plain.picture, picture);
    // Text has no pictures, so its leaves are whole cards.
    const least = ending === "usda" ? 0.8 : 0.95;
    expect(ofAll.overlap, JSON.stringify(ofAll)).toBeGreaterThan(least);
    for (const steps of [...ofWood.colour, ...ofAll.colour]) expect(Math.abs(steps)).toBeLessThan(32);
  });
});

it.each(["usda", "usdz"])("three.js moves the bones of a cherry in .%s as those in glTF", async (ending) => {
  const [eye, options] = [await shot("cherry"), ["--lod", "2", "--sway", "64"]];
  const still = await exported("cherry", "glb", ["--lod", "2"]);
  const { found: atRest } = await viewer.see({ ending: "glb", bytes: still }, SIDE, SIDE, eye);
  const [gltf, usd] = [await exported("cherry", "glb", options), await exported("cherry", ending, options)];
  for (const time of [0, 2.5]) {
    const one = await viewer.see({ ending: "glb", bytes: gltf }, SIDE, SIDE, eye, { time });
    const { found, picture } = await viewer.see({ ending, bytes: usd }, SIDE, SIDE, eye, { time });
    expect(found.bones).toBeGreaterThan(20);
    expect([found.bones, found.seconds, found.triangles]).toEqual([one.found.bones, 8, one.found.triangles]);
    // Shares of bones are rounded to a thousandth in one file, to a 255th in the other.
    expect(apart(found.box, one.found.box)).toBeLessThan(0.005);
    expect(apart(found.box, atRest.box), "it has moved").toBeGreaterThan(0.02);
    expect((await agreement(one.picture, picture)).overlap).toBeGreaterThan(ending === "usda" ? 0.8 : 0.95);
  }
});

it("three.js reads a model with pivots, and each element finds the ground by its bearers", async () => {
  const [eye, options] = [await shot("cherry"), ["--lod", "2"]];
  const plain = await viewer.see({ ending: "glb", bytes: await exported("cherry", "glb", options) }, SIDE, SIDE, eye);
  const bytes = await exported("cherry", "pivots.zip", options);
  const { found, picture } = await viewer.see({ ending: "pivots.zip", bytes }, SIDE, SIDE, eye);
  expect([found.triangles, found.box]).toEqual([plain.found.triangles, plain.found.box]);
  expect((await agreement(plain.picture, picture)).overlap).toBe(1);
  const { width, height, bits } = found.floats!;
  expect(bits.length).toBe(4 * width * height);
  const texel = (element: number) => {
    const row = height - 1 - Math.floor(element / width);
    const start = 4 * (row * width + (element % width));
    return bits.slice(start, start + 4);
  };
  expect(texel(0), "the trunk turns at the origin and bears itself").toEqual([0, 0, 0, 1024]);
  let deepest = 0;
  for (let element = 0; element < width * height; element++) {
    const parent = (of: number) => texel(of)[3]! - 1024;
    let level = 0;
    for (let at = element; at !== 0; at = parent(at)) {
      expect(parent(at)).toBeLessThan(at);
      level += 1;
    }
    deepest = Math.max(deepest, level);
  }
  expect(deepest).toBe(3);
});

describe("three.js reads packed glTF", () => {
  let plain: Seen;
  let eye: Shot;

  beforeAll(async () => {
    eye = await shot("cherry");
    plain = await viewer.see({ ending: "glb", bytes: await exported("cherry", "glb") }, SIDE, SIDE, eye);
    expect(plain.found.instances).toBe(0);
  });

  it.each([
    // What is compressed is the same to the bit.
    [["--compressed"], 0],
    // A place is off by less than a 65,000th of the plant's extent.
    [["--quantised"], 65_000],
    [["--quantised", "--compressed"], 65_000],
  ] as const)("with %j as the plain file: the same triangles in the same place", async (options, parts) => {
    const seen = await viewer.see({ ending: "glb", bytes: await exported("cherry", "glb", options) }, SIDE, SIDE, eye);
    expect(seen.found).toEqual({ ...plain.found, box: seen.found.box });
    const extent = Math.max(...plain.found.box[1].map((most, axis) => most - plain.found.box[0][axis]!));
    expect(apart(seen.found.box, plain.found.box)).toBeLessThanOrEqual(parts === 0 ? 0 : extent / parts);
    const { overlap, colour } = await agreement(plain.picture, seen.picture);
    expect(overlap).toBeGreaterThan(0.99);
    for (const steps of colour) expect(Math.abs(steps)).toBeLessThan(2);
  });

  it.each([[["--instanced"]], [["--instanced", "--quantised", "--compressed"]]])(
    "with %j as the plain file: each leaf is there, in its own colour",
    async (options) => {
      const seen = await viewer.see(
        { ending: "glb", bytes: await exported("cherry", "glb", options) },
        SIDE,
        SIDE,
        eye,
      );
      expect(seen.found.instances).toBeGreaterThan(1000);
      expect(seen.found.triangles).toBe(plain.found.triangles);
      expect(seen.found.wood).toBe(plain.found.wood);
      // All leaves have one bow and fold here, so that tips lie a little otherwise.
      expect(apart(seen.found.box, plain.found.box)).toBeLessThan(0.02);
      const { overlap, colour } = await agreement(plain.picture, seen.picture);
      expect(overlap).toBeGreaterThan(0.97);
      for (const steps of colour) expect(Math.abs(steps)).toBeLessThan(6);
    },
  );
});
