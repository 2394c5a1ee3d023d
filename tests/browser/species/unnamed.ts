import { createHash } from "node:crypto";
import { mkdir, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { FINAL, Player } from "../gallery/player";
import { launchBrowser } from "../src/browser";
import { watchDrawing } from "../src/drawing-faults";
import { Server } from "../src/server";
import { chosen, type Species } from "./known";

/** From the front, from a little above. */
const SHOT = { yaw: 0, pitch: 4, zoom: 1, width: 640, height: 640 };

/**
 * Grows species from a seed and writes their pictures, numbered in an order that follows from the seed, for somebody to
 * name who does not know it. `key.txt` tells which is which. Gives the exit code.
 */
export async function writeUnnamed(slugs: readonly string[], seed: number, out: string): Promise<number> {
  await mkdir(out, { recursive: true });
  const server = new Server();
  const browser = watchDrawing(await launchBrowser());
  try {
    await server.start();
    const player = await Player.open(server, browser, FINAL);
    const order = shuffled(await chosen(server, slugs), seed);
    const key: string[] = [];
    for (const [index, species] of order.entries()) {
      const number = String(index + 1).padStart(2, "0");
      const picture = await player.play({ shot: SHOT }, [{ seed, commands: commandsOf(species) }]);
      await writeFile(join(out, `${number}.jpg`), picture);
      key.push(`${number} ${species.slug}`);
      console.log(`${number}.jpg`);
    }
    await writeFile(join(out, "key.txt"), `${key.join("\n")}\n`);
    return 0;
  } finally {
    await browser.close();
    await server.stop();
  }
}

/** What grows a seedling up as its species has it, with its looks. The place it stands in and the wind stay the session's. */
function commandsOf({ programme, appearance }: Species): readonly string[] {
  const { background: _, wind: __, ...looks } = appearance;
  const commands = [
    { kind: "set_programme", programme },
    { kind: "set_appearance", appearance: looks },
    { kind: "grow", steps: programme.age },
  ];
  return commands.map((command) => JSON.stringify(command));
}

/** Species in an order that tells nothing of them, the same for each seed. */
function shuffled(species: readonly Species[], seed: number): readonly Species[] {
  const rank = ({ slug }: Species) => createHash("sha256").update(`${seed} ${slug}`).digest("hex");
  return species.toSorted((a, b) => (rank(a) < rank(b) ? -1 : 1));
}
