import { execFile } from "node:child_process";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { join, resolve } from "node:path";
import { promisify } from "node:util";
import { perform } from "../gallery/performance";
import { FINAL, Player } from "../gallery/player";
import { print } from "../gallery/print";
import { launchBrowser } from "../src/browser";
import { treeAt } from "../src/by-hand";
import { program, Server } from "../src/server";
import { STUDIO, shotOf, VIEW } from "./shot";
import { Viewer } from "./viewer";

const run = promisify(execFile);
const SPECIES = ["scots-pine", "cherry", "weeping-willow", "maple"];
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
    const viewer = await Viewer.open(browser);
    const player = await Player.open(server, browser, FINAL);
    for (const species of SPECIES) {
      const address = await sessionOf(species, server);
      await perform(player.blank, address.slice(address.lastIndexOf("/") + 1), [
        JSON.stringify({ kind: "set_appearance", appearance: { background: STUDIO } }),
      ]);
      const onScreen = await player.photograph(address, { shot: { ...VIEW, width: SIDE, height: SIDE } });
      const skeleton = await fetch(`${address.replace("/s/", "/api/v1/sessions/")}/tree.json`);
      const seen = await viewer.see(await treeAt(address), SIDE, SIDE, shotOf(await skeleton.json()));
      const both = await print(player.blank, [onScreen, seen.picture], SIDE, SIDE);
      await writeFile(join(folder, `${species}.jpg`), both);
      console.log(`${species}.jpg  ${Math.round(both.length / 1024)} kB  ${seen.found.triangles} triangles`);
    }
  } finally {
    await browser.close();
    await server.stop();
  }
}

/** Grows a species, and opens it in a session of its own; gives its address. */
async function sessionOf(species: string, { address, folder }: Server): Promise<string> {
  const path = join(folder, `${species}.espalier`);
  await run(program, ["grow", "--species", species, "--export", path]);
  const { id } = await posted(`${address}/api/v1/trees/import?format=espalier&name=${species}`, await readFile(path));
  const { session } = await posted(`${address}/api/v1/sessions`, JSON.stringify({ tree: id }));
  return `${address}/s/${session}`;
}

async function posted(address: string, body: Buffer | string): Promise<{ id: string; session: string }> {
  const type = typeof body === "string" ? "application/json" : "application/octet-stream";
  const sent = typeof body === "string" ? body : new Uint8Array(body);
  const answer = await fetch(address, { method: "POST", headers: { "content-type": type }, body: sent });
  if (!answer.ok) throw new Error(`${address}: ${await answer.text()}`);
  return (await answer.json()) as { id: string; session: string };
}
