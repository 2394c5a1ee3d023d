import { mkdir, writeFile } from "node:fs/promises";
import { join, resolve } from "node:path";
import { print } from "../gallery/print";
import { launchBrowser } from "../src/browser";
import { Server } from "../src/server";
import { Pairs, SPECIES } from "./pairs";

/** Pixels of each picture across and down. */
const SIDE = 480;

/** The same of each in the sheets of several. */
const SMALL = 320;
/** Endings of what three.js shows besides glTF, in the order of a sheet, in which the screen comes first and the server's picture last. */
const OTHERS = ["obj.zip", "usdz", "usda", "ply"];
/** Pictures in a row of a sheet. */
const ROW = 3;

/**
 * Writes pictures of some species to a folder: as the page shows one and beside it what three.js shows of its glTF file,
 * and a sheet of its other files.
 */
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
      const stood = await pairs.stand(species, SIDE);
      const write = async (name: string, pictures: readonly Buffer[], side: number, row?: number) => {
        const sheet = await print(pairs.player.blank, pictures, side, side, row);
        await writeFile(join(folder, name), sheet);
        console.log(`${name}  ${Math.round(sheet.length / 1024)} kB`);
      };
      const inFile = await stood.file("glb");
      await write(`${species}.jpg`, [stood.onScreen, inFile.picture], SIDE);
      const sheet = [stood.onScreen];
      for (const ending of OTHERS) {
        const { level, found, picture } = await stood.file(ending);
        console.log(`  ${ending}: level ${level}, ${found.triangles} triangles, ${found.points} points`);
        sheet.push(picture);
      }
      await write(`${species}-formats.jpg`, [...sheet, await stood.picture()], SMALL, ROW);
    }
  } finally {
    await browser.close();
    await server.stop();
  }
}
