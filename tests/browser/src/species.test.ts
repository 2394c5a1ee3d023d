import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";
import { program } from "./server";
import { middle, SMALL, way } from "./tablet";
import { Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer();

const digest = (bytes: Uint8Array) => createHash("sha256").update(bytes).digest("hex");

test.each(["scots-pine", "baobab"])("PG2: %s grown with the lever is the tree of the contact sheet", async (slug) => {
  const address = await workshop.server.newSession(1);
  const tablet = await workshop.open(address, SMALL);
  await tablet.tap("Architecture");
  await tablet.turnTo("Species");
  await tablet.page.locator(`[data-species="${slug}"]`).tap();
  await tablet.untilQuiet();
  await tablet.tap("Architecture");
  const lever = await tablet.boxOf(tablet.page.getByLabel("Grow", { exact: true }));
  await tablet.lead([way(middle(lever), { x: middle(lever).x, y: lever.y + 4 }, 4)]);
  await tablet.page.getByText("Grown up, as its species has it").waitFor();
  await tablet.touch("touchEnd", []);
  await tablet.untilQuiet();
  const own = join(workshop.server.folder, `${slug}.glb`);
  const grown = spawnSync(program, ["grow", "--species", slug, "--seed", "1", "--export", own]);
  expect(grown.status).toBe(0);
  const answer = await fetch(`${address.replace("/s/", "/api/sessions/")}/tree.glb`);
  expect(digest(new Uint8Array(await answer.arrayBuffer()))).toBe(digest(readFileSync(own)));
});
