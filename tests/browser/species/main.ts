import { writeFile } from "node:fs/promises";
import { join, resolve } from "node:path";
import { parseArgs } from "node:util";
import { FINAL, Player } from "../gallery/player";
import { launchBrowser } from "../src/browser";
import { growByHand, treeAt, treeOfTheSheet } from "../src/by-hand";
import { Darkroom } from "../src/picture";
import { SMALL } from "../src/screens";
import { Server } from "../src/server";
import { Tablet } from "../src/tablet";
import { chosen } from "./known";
import { layOut, type Pair, SIZE } from "./pairs";
import { writeUnnamed } from "./unnamed";

const PICTURE = join(import.meta.dirname, "../../../docs/species-by-hand.jpg");
/** The seed of the contact sheet. */
const SEED = 1;
/** A processor that has other work as well may need long to grow a tree, in milliseconds. */
const PATIENCE = 300_000;
/** From the front, as on the sheet. */
const SHOT = { yaw: 0, pitch: 4, zoom: 1.15, ...SIZE };

/**
 * Grows the species with these slugs, or all, by hand in the page, holds each tree against that of the contact sheet,
 * and writes one picture of the pairs; with `--unnamed FOLDER` writes pictures of them to be named instead, grown from
 * another seed. Gives the exit code.
 */
export async function main(words: readonly string[]): Promise<number> {
  const { values, positionals } = parseArgs({
    args: [...words],
    allowPositionals: true,
    options: { out: { type: "string" }, unnamed: { type: "string" }, seed: { type: "string", default: "2" } },
  });
  // npm runs a script in its package's folder; a path is meant from where the command was given.
  const here = process.env.INIT_CWD ?? process.cwd();
  if (values.unnamed !== undefined) {
    const seed = Number(values.seed);
    if (!Number.isSafeInteger(seed) || seed < 0) throw new Error(`a seed is a whole number, not ${values.seed}`);
    return writeUnnamed(positionals, seed, resolve(here, values.unnamed));
  }
  const out = values.out === undefined ? PICTURE : resolve(here, values.out);
  const server = new Server();
  const browser = await launchBrowser();
  let failed = 0;
  try {
    await server.start();
    const species = await chosen(server, positionals);
    const player = await Player.open(server, browser, FINAL);
    const darkroom = await Darkroom.open(browser);
    const pairs: Pair[] = [];
    for (const { slug, name } of species) {
      try {
        const address = await server.newSession(SEED);
        const tablet = await Tablet.open(browser, darkroom, address, SMALL);
        tablet.page.setDefaultTimeout(PATIENCE);
        try {
          await growByHand(tablet, slug);
        } finally {
          await tablet.close();
        }
        const isSame = (await treeAt(address)).equals(treeOfTheSheet(slug, server.folder));
        const byHand = await player.photograph(address, { shot: SHOT });
        pairs.push({ name, sheet: await pictureOf(server, slug), byHand });
        console.log(`${slug}  ${isSame ? "the tree of the sheet" : "ANOTHER TREE"}`);
        if (!isSame) failed += 1;
      } catch (error) {
        failed += 1;
        console.error(`${slug}: ${error instanceof Error ? error.message : error}`);
      }
    }
    await writeFile(out, await layOut(player.blank, pairs));
    console.log(`${pairs.length} of ${species.length} in ${out}`);
  } finally {
    await browser.close();
    await server.stop();
  }
  return failed === 0 ? 0 : 1;
}

/** The tree of the contact sheet, drawn by the server as it is there. */
async function pictureOf({ address }: Server, slug: string): Promise<Buffer> {
  const answer = await fetch(`${address}/api/v1/species/${slug}/picture`);
  if (!answer.ok) throw new Error(`no picture of ${slug}`);
  return Buffer.from(await answer.arrayBuffer());
}
