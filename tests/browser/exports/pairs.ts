import { execFile } from "node:child_process";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { promisify } from "node:util";
import type { Browser } from "playwright-core";
import { perform } from "../gallery/performance";
import { FINAL, Player } from "../gallery/player";
import { treeAt } from "../src/by-hand";
import { program, type Server } from "../src/server";
import { STUDIO, shotOf, VIEW } from "./shot";
import { type Found, Viewer } from "./viewer";

const run = promisify(execFile);

/** Those whose looks differ most: needles, blossom, hanging sprays, lobed leaves. */
export const SPECIES = ["scots-pine", "cherry", "weeping-willow", "maple"];

/** A species as the page shows it, and as three.js shows its glTF file: same eye, same lamp. PNG, several pixels to one. */
export interface Pair {
  readonly onScreen: Buffer;
  readonly inFile: Buffer;
  readonly found: Found;
}

/** Takes pictures of species, on the screen and in files. */
export class Pairs {
  private constructor(
    private readonly server: Server,
    readonly player: Player,
    private readonly viewer: Viewer,
  ) {}

  static async open(server: Server, browser: Browser): Promise<Pairs> {
    return new Pairs(server, await Player.open(server, browser, FINAL), await Viewer.open(browser));
  }

  /** Pictures as wide as they are high, of so many pixels a side once their detail is averaged. */
  async of(species: string, side: number): Promise<Pair> {
    const address = await sessionOf(species, this.server);
    await perform(this.player.blank, address.slice(address.lastIndexOf("/") + 1), [
      JSON.stringify({ kind: "set_appearance", appearance: { background: STUDIO } }),
    ]);
    const onScreen = await this.player.photograph(address, { shot: { ...VIEW, width: side, height: side } });
    const skeleton = await fetch(`${address.replace("/s/", "/api/v1/sessions/")}/tree.json`);
    const seen = await this.viewer.see(await treeAt(address), side, side, shotOf(await skeleton.json()));
    return { onScreen, inFile: seen.picture, found: seen.found };
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
