import { execFile } from "node:child_process";
import { mkdir, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { promisify } from "node:util";
import { print } from "../gallery/print";
import { launchBrowser } from "../src/browser";
import { program } from "../src/server";
import { Viewer } from "./viewer";

const run = promisify(execFile);
const SPECIES = ["scots-pine", "cherry", "weeping-willow", "maple"];
/** Pixels of each picture across and down. */
const SIDE = 480;

/** Writes a picture of some species to a folder: drawn by the program, and beside it what three.js shows of its glTF file. */
export async function main([out = "exports"]: readonly string[]): Promise<void> {
  // npm runs a script in its package's folder; a path is meant from where the command was given.
  const folder = resolve(process.env.INIT_CWD ?? process.cwd(), out);
  await mkdir(folder, { recursive: true });
  const scratch = await mkdtemp(join(tmpdir(), "espalier-exports-"));
  const browser = await launchBrowser();
  try {
    const viewer = await Viewer.open(browser);
    const page = await browser.newPage();
    for (const species of SPECIES) {
      const [picture, file] = ["png", "glb"].map((ending) => join(scratch, `${species}.${ending}`)) as [string, string];
      for (const path of [picture, file]) await run(program, ["grow", "--species", species, "--export", path]);
      const seen = await viewer.see(await readFile(file), SIDE, SIDE);
      const both = await print(page, [await readFile(picture), seen.picture], SIDE, SIDE);
      await writeFile(join(folder, `${species}.jpg`), both);
      console.log(`${species}.jpg  ${Math.round(both.length / 1024)} kB  ${seen.found.triangles} triangles`);
    }
  } finally {
    await browser.close();
    await rm(scratch, { recursive: true, force: true });
  }
}
