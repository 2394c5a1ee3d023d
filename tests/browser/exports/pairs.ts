import { execFile } from "node:child_process";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { promisify } from "node:util";
import type { Browser } from "playwright-core";
import { perform } from "../gallery/performance";
import { FINAL, Player } from "../gallery/player";
import { program, type Server } from "../src/server";
import { type Shot, STUDIO, shotOf, VIEW } from "./shot";
import { type Found, type Seen, Viewer } from "./viewer";

const run = promisify(execFile);

/** Those whose looks differ most: needles, blossom, hanging sprays, lobed leaves. */
export const SPECIES = ["scots-pine", "cherry", "weeping-willow", "maple"];

/** Files larger than this, in bytes, are shown coarser: with a text of 118 MB three.js ran out of the browser's memory. */
const LARGEST = 64e6;

/** A species as the page shows it, and as three.js shows its glTF file: same eye, same lamp. PNG, several pixels to one. */
export interface Pair {
  readonly onScreen: Buffer;
  readonly inFile: Buffer;
  readonly found: Found;
}

/** A species that has grown, as the page shows it and as others show what the program writes of it. */
export interface Stood {
  readonly onScreen: Buffer;
  /** What three.js shows of its file in the format of an ending, at the finest level of detail that it can load. */
  file(ending: string): Promise<Seen & { readonly level: number }>;
  /** The picture that the server makes, from the page's eye. */
  picture(): Promise<Buffer>;
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
    const stood = await this.stand(species, side);
    const seen = await stood.file("glb");
    return { onScreen: stood.onScreen, inFile: seen.picture, found: seen.found };
  }

  /** A grown species with the page's picture of it. */
  async stand(species: string, side: number): Promise<Stood> {
    const address = await sessionOf(species, this.server);
    await perform(this.player.blank, address.slice(address.lastIndexOf("/") + 1), [
      JSON.stringify({ kind: "set_appearance", appearance: { background: STUDIO } }),
    ]);
    const onScreen = await this.player.photograph(address, { shot: { ...VIEW, width: side, height: side } });
    const exported = (ending: string, options = "") =>
      bytesAt(`${address.replace("/s/", "/api/v1/sessions/")}/tree.${ending}${options}`);
    const shot = shotOf(JSON.parse((await exported("json")).toString()));
    return {
      onScreen,
      file: async (ending) => {
        let level = 0;
        let bytes = await exported(ending);
        if (bytes.length > LARGEST) bytes = await exported(ending, `?lod=${++level}`);
        return { level, ...(await this.viewer.see({ ending, bytes }, side, side, shot)) };
      },
      picture: () => exported("png", `?size=${2 * side}x${2 * side}&${cameraOf(shot)}`),
    };
  }
}

/** A shot as the server's options of a picture say it. */
function cameraOf({ eye, target, angle }: Shot): string {
  const [x, y, z] = [0, 1, 2].map((axis) => eye[axis]! - target[axis]!) as [number, number, number];
  const distance = Math.hypot(x, y, z);
  const degrees = (radians: number) => (radians * 180) / Math.PI;
  const options = {
    turn: degrees(Math.atan2(x, z)),
    rise: degrees(Math.asin(y / distance)),
    fov: angle,
    target: target.join(","),
    distance,
  };
  return Object.entries(options)
    .map(([name, value]) => `${name}=${value}`)
    .join("&");
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

async function bytesAt(address: string): Promise<Buffer> {
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`nothing at ${address}: ${await answer.text()}`);
  return Buffer.from(await answer.arrayBuffer());
}
