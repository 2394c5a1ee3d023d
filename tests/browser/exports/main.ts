import { mkdir, writeFile } from "node:fs/promises";
import { join, resolve } from "node:path";
import { print } from "../gallery/print";
import { launchBrowser } from "../src/browser";
import { Server } from "../src/server";
import { Pairs, SPECIES } from "./pairs";

/** Pixels of each picture across and down. */
const SIDE = 480;

/** Writes a picture of some species to a folder: as the page shows it, and beside it what three.js shows of its glTF file. */
export async function main([out = "exports"]: readonly string[]): Promise<void> {
  // npm runs a script in its package's folder; a path is meant from where the command was given.
  const folder = resolve(process.env.INIT_CWD ?? process.cwd(), out);
  await mkdir(folder, { recursive: true });
  const server = new Server();
  const browser = await launchBrowser();
  try {
    await server.start();
    const pairs = await Pairs.open(server, browser);
    for (const species of SPECIES) {
      const { onScreen, inFile, found } = await pairs.of(species, SIDE);
      const both = await print(pairs.player.blank, [onScreen, inFile], SIDE, SIDE);
      await writeFile(join(folder, `${species}.jpg`), both);
      console.log(`${species}.jpg  ${Math.round(both.length / 1024)} kB  ${found.triangles} triangles`);
    }
  } finally {
    await browser.close();
    await server.stop();
  }
}
