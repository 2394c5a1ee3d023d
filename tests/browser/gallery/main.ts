import { mkdir, readFile, writeFile } from "node:fs/promises";
import { join, resolve } from "node:path";
import { launchBrowser } from "../src/browser";
import { watchDrawing } from "../src/drawing-faults";
import { Server } from "../src/server";
import { chosen, readCatalogue, readScript, treesOf } from "./catalogue";
import { loopOf } from "./loop";
import { readOrder } from "./order";
import { DRAFT, FINAL, Player } from "./player";

/**
 * Plays the sketches with these names, or all, and writes their pictures; `loop IN OUT` packs an animated PNG as WebP. Gives the
 * exit code.
 */
export async function main(words: readonly string[]): Promise<number> {
  const [word, from, to] = words;
  if (word === "loop") {
    if (from === undefined || to === undefined) throw new Error("say which animated PNG becomes which file of WebP");
    const here = process.env.INIT_CWD ?? process.cwd();
    await pack(resolve(here, from), resolve(here, to));
    return 0;
  }
  // npm runs a script in its package's folder; a path is meant from where the command was given.
  const { names, draft, out } = readOrder(words, process.env.INIT_CWD ?? process.cwd());
  const entries = chosen(await readCatalogue(), names);
  await mkdir(out, { recursive: true });
  const server = new Server();
  const browser = watchDrawing(await launchBrowser());
  let failed = 0;
  try {
    await server.start();
    const player = await Player.open(server, browser, draft ? DRAFT : FINAL);
    for (const entry of entries) {
      const began = Date.now();
      try {
        const trees = treesOf(entry).map(async (tree) => ({ seed: tree.seed, commands: await readScript(tree) }));
        const picture = await player.play(entry, await Promise.all(trees));
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

/** Packs an animated PNG as animated WebP. */
async function pack(from: string, to: string): Promise<void> {
  const server = new Server();
  const browser = await launchBrowser();
  try {
    await server.start();
    const page = await browser.newPage();
    // Browsers unpack moving pictures for pages that came from a server only.
    await page.goto(`${server.address}/health`);
    const loop = await loopOf(page, await readFile(from));
    await writeFile(to, loop);
    console.log(`${to}  ${Math.round(loop.length / 1024)} kB`);
  } finally {
    await browser.close();
    await server.stop();
  }
}
