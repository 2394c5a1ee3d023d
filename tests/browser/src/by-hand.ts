import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { program } from "./server";
import type { Tablet } from "./tablet";
import { middle, way } from "./ways";

/** Picks a species in the page. */
export async function pickSpecies(tablet: Tablet, slug: string): Promise<void> {
  await tablet.tap("Architecture");
  await tablet.turnTo("Species");
  await tablet.page.locator(`[data-species="${slug}"]`).tap();
  await tablet.untilQuiet();
  await tablet.tap("Architecture");
}

/** Picks a species in the page of a seedling, and pulls the lever of growth until the tree is grown up. */
export async function growByHand(tablet: Tablet, slug: string): Promise<void> {
  await pickSpecies(tablet, slug);
  const lever = await tablet.boxOf(tablet.page.getByLabel("Grow", { exact: true }));
  await tablet.lead([way(middle(lever), { x: middle(lever).x, y: lever.y + 4 }, 4)]);
  await tablet.page.getByText("Grown up, as its species has it").waitFor();
  await tablet.touch("touchEnd", []);
  await tablet.untilQuiet();
}

/** The tree of a session as a glTF file. */
export async function treeAt(address: string): Promise<Buffer> {
  const answer = await fetch(`${address.replace("/s/", "/api/v1/sessions/")}/tree.glb`);
  if (!answer.ok) throw new Error(`no tree at ${address}: ${await answer.text()}`);
  return Buffer.from(await answer.arrayBuffer());
}

/** The tree that the contact sheet shows of a species, as a glTF file, by way of a file in a folder. */
export function treeOfTheSheet(slug: string, folder: string): Buffer {
  const path = join(folder, `${slug}.glb`);
  const grown = spawnSync(program, ["grow", "--species", slug, "--seed", "1", "--export", path], { encoding: "utf8" });
  if (grown.status !== 0) throw new Error(`${slug} did not grow: ${grown.stderr}`);
  return readFileSync(path);
}
