import { expect, test } from "vitest";
import { factsOf } from "./facts";
import { guestsLink, ownersLink } from "./invitations";
import { LANDSCAPE, PHONE, type Screen } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import { type Point, way } from "./ways";
import { seedling, Workshop } from "./workshop";

// People come by links of their own: whoever sits at the machine would be the same person on all pages.
const workshop = Workshop.withItsOwnServer(["--auth"]);

const THEIRS = "Nothing of yours is left to undo. What was done last is by Bo";

/** Draws from a place to another one; gives how much stands then. */
async function draw(tablet: Tablet, from: Point, to: Point): Promise<number> {
  const { metamers } = await tablet.facts();
  await tablet.swipe([way(from, to)]);
  await tablet.until("it grows", (facts) => facts.metamers > metamers + 3);
  return (await tablet.untilQuiet()).metamers;
}

/** Presses Undo, until the page says so. */
async function undo(tablet: Tablet, words: string): Promise<number> {
  const said = await tablet.watchFor(".toast", words);
  await tablet.tap("Undo");
  await said();
  return (await tablet.untilQuiet()).metamers;
}

test.each<[string, Screen]>([
  ["tablet", { ...LANDSCAPE, detail: 0.3 }],
  ["phone", { ...PHONE, detail: 0.3 }],
])("UD1, UD7: on a %s undo leaves what somebody drew who has left, and says whose it is", async (name, screen) => {
  const ann = await workshop.open(ownersLink(workshop.server, "Ann"), screen);
  const bo = await workshop.open(await guestsLink(ann, `Elm of the ${name}`, "Bo"), { ...LANDSCAPE, detail: 0.2 });
  const foot = await seedling(ann);
  const seed = await seedling(bo);
  const bos = await draw(bo, seed, { x: seed.x, y: seed.y - 300 });
  await ann.page.locator(".people-chip").waitFor();
  await ann.until("his stem is here", ({ metamers }) => metamers === bos);
  await bo.page.close();
  await ann.page.locator(".people-chip").waitFor({ state: "detached" });

  expect(await undo(ann, THEIRS), "his stays").toBe(bos);
  await ann.showNow(`80-undo-of-others-${name}`);
  const both = await draw(ann, { x: foot.x, y: foot.y - 60 }, { x: foot.x + 100, y: foot.y - 150 });
  expect(both).toBeGreaterThan(bos);
  expect(await undo(ann, "Undone: Stroke"), "hers goes").toBe(bos);
  expect(await undo(ann, THEIRS), "his stays").toBe(bos);
  const redo = ann.page.getByRole("button", { name: "Redo", exact: true });
  const isDim = async () => (await redo.getAttribute("aria-disabled")) === "true";
  expect(await isDim(), "hers can come back").toBe(false);
  const said = await ann.watchFor(".toast", "Redone: Stroke");
  await ann.tap("Redo");
  await said();
  await until("nothing else can come back", isDim);
  await ann.showNow(`81-redone-${name}`);
  expect((await ann.untilQuiet()).metamers).toBe(both);
});

test("UD8: undo takes back what the same person did on another page, and all that one did alone", async () => {
  const ann = await workshop.open(ownersLink(workshop.server, "Ann"), { ...LANDSCAPE, detail: 0.2 });
  const seed = await seedling(ann);
  const stem = await draw(ann, seed, { x: seed.x, y: seed.y - 300 });
  const limbed = await draw(ann, { x: seed.x, y: seed.y - 150 }, { x: seed.x + 120, y: seed.y - 250 });
  expect(limbed).toBeGreaterThan(stem);
  const later = await ann.page.context().newPage();
  await later.goto(ann.page.url());
  await ann.page.close();
  const untilThere = (what: string, metamers: number) =>
    until(what, async () => {
      const facts = await factsOf(later);
      return facts.connection === "connected" && facts.metamers === metamers;
    });
  await untilThere("the tree is there", limbed);
  const button = (name: string) => later.getByRole("button", { name, exact: true });
  await button("Undo").click();
  await untilThere("the limb has gone", stem);
  await button("Undo").click();
  await untilThere("the seed is left", 0);
  expect(await button("Undo").getAttribute("aria-disabled"), "that is all").toBe("true");
  await button("Redo").click();
  await untilThere("the stem is back", stem);
  expect((await factsOf(later)).operations, "alone on the line one goes back in time").toBe("stroke stroke");
});
