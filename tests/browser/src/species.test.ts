import { createHash } from "node:crypto";
import { expect, test } from "vitest";
import { growByHand, treeAt, treeOfTheSheet } from "./by-hand";
import { SMALL } from "./screens";
import { Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer();

const digest = (bytes: Uint8Array) => createHash("sha256").update(bytes).digest("hex");

// `npm run species` does the same with all of them.
test.each(["scots-pine", "baobab"])("PG2: %s grown with the lever is the tree of the contact sheet", async (slug) => {
  const address = await workshop.server.newSession(1);
  const tablet = await workshop.open(address, SMALL);
  await growByHand(tablet, slug);
  expect(digest(await treeAt(address))).toBe(digest(treeOfTheSheet(slug, workshop.server.folder)));
});
