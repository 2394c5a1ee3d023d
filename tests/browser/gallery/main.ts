import { mkdir, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { launchBrowser } from "../src/browser";
import { Server } from "../src/server";
import { chosen, readCatalogue, readScript } from "./catalogue";
import { readOrder } from "./order";
import { DRAFT, FINAL, Player } from "./player";

/** Plays the sketches with these names, or all, and writes their pictures. Gives the exit code. */
export async function main(words: readonly string[]): Promise<number> {
  // npm runs a script in its package's folder; a path is meant from where the command was given.
  const { names, draft, out } = readOrder(words, process.env.INIT_CWD ?? process.cwd());
  const entries = chosen(await readCatalogue(), names);
  await mkdir(out, { recursive: true });
  const server = new Server();
  const browser = await launchBrowser();
  let failed = 0;
  try {
    await server.start();
    const player = await Player.open(server, browser, draft ? DRAFT : FINAL);
    for (const entry of entries) {
      const began = Date.now();
      try {
        const picture = await player.play(entry, await readScript(entry));
        await writeFile(join(out, `${entry.name}.jpg`), picture);
        const seconds = ((Date.now() - began) / 1000).toFixed(1);
        console.log(`${entry.name}.jpg  ${Math.round(picture.length / 1024)} kB  ${seconds} s`);
      } catch (error) {
        failed += 1;
        console.error(`${entry.name}: ${error instanceof Error ? error.message : error}`);
      }
    }
  } finally {
    await browser.close();
    await server.stop();
  }
  return failed === 0 ? 0 : 1;
}
