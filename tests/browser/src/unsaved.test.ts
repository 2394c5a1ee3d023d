import { expect, test } from "vitest";
import { PHONE, type Screen, SMALL } from "./screens";
import type { Tablet } from "./tablet";
import { press } from "./visits";
import { Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer();

/** What other tests have left is on no list. */
async function forgetAll(): Promise<void> {
  const server = workshop.server.address;
  const listed = await (await fetch(`${server}/api/v1/sessions?saved=false`)).json();
  for (const { session } of listed.sessions as { session: string }[])
    await fetch(`${server}/api/v1/sessions/${session}`, { method: "DELETE" });
}

/** A tablet with a tree that nobody has saved. */
async function unsaved(screen: Screen = SMALL): Promise<{ tablet: Tablet; metamers: number }> {
  await forgetAll();
  const { tablet, address } = await workshop.fresh(screen);
  await workshop.act(address, [{ kind: "grow", steps: 5 }]);
  await tablet.until("it has grown", ({ metamers }) => metamers > 0);
  return { tablet, metamers: (await tablet.untilQuiet()).metamers };
}

/** Begins a new tree, and answers where the one before stays. */
async function begin(tablet: Tablet, answer: string): Promise<void> {
  await tablet.tap("New tree");
  const asked = tablet.page.getByRole("dialog", { name: "A new tree" });
  await asked.getByRole("button", { name: answer }).tap();
  await asked.waitFor({ state: "detached" });
  await tablet.until("a new tree begins", ({ metamers, rows }) => metamers === 0 && rows > 0);
}

const recent = (tablet: Tablet) => tablet.page.getByRole("region", { name: "Go on with a tree" });

/** The library lists so many trees under Unsaved. */
async function listed(tablet: Tablet, count: number): Promise<void> {
  const answer = tablet.page.waitForResponse((response) => response.url().includes("/api/v1/sessions?"));
  await tablet.tap("Library");
  await tablet.page.getByRole("dialog", { name: "Library" }).waitFor();
  expect((await answer).status()).toBe(200);
  await tablet.untilSettled();
  const cards = tablet.page.getByRole("region", { name: "Unsaved" }).locator(".card");
  await expect.poll(() => cards.count()).toBe(count);
  await tablet.page.keyboard.press("Escape");
  await tablet.page.getByRole("dialog").waitFor({ state: "detached" });
}

test("a tree that is kept under Unsaved is found there, and on the first screen", async () => {
  const { tablet, metamers } = await unsaved();
  await begin(tablet, "Keep under Unsaved");
  await recent(tablet)
    .getByRole("button", { name: /^Unsaved/ })
    .waitFor();
  await listed(tablet, 1);
  await tablet.tap("Library");
  await tablet.page.getByRole("button", { name: /^Go on with the tree of/ }).tap();
  await tablet.until("it is the tree that was left", (facts) => facts.metamers === metamers);
  await tablet.page.getByRole("dialog").waitFor({ state: "detached" });
  expect(await recent(tablet).count(), "something has grown here").toBe(0);
  // It can be taken back and forth as before: it is the very session.
  await tablet.tap("Undo");
  await tablet.until("undo goes on", (facts) => facts.metamers === 0);
});

test("another browser of the same person lists the same trees, and goes on with them", async () => {
  const { tablet, metamers } = await unsaved();
  await begin(tablet, "Keep under Unsaved");
  const { tablet: other } = await workshop.fresh(SMALL);
  await listed(other, 1);
  await other.tap("Library");
  const section = other.page.getByRole("region", { name: "Unsaved" });
  await section.getByRole("button", { name: /^Go on with the tree of/ }).waitFor();
  await other.untilSettled();
  await other.show("unsaved-elsewhere");
  await section.getByRole("button", { name: /^Go on with the tree of/ }).tap();
  await other.until("it is the tree that was left", (facts) => facts.metamers === metamers);
});

test.each<[string, Screen]>([
  ["a tablet", SMALL],
  ["a phone", PHONE],
])("each answer to where a tree stays has a row of its own: %s", async (_, screen) => {
  const { tablet } = await unsaved(screen);
  await press(tablet, "New tree");
  const asked = tablet.page.getByRole("dialog", { name: "A new tree" });
  const boxes = [];
  for (const name of ["Save it", "Keep under Unsaved", "Do not keep it"])
    boxes.push(await tablet.boxOf(asked.getByRole("button", { name })));
  await tablet.show(`a-new-tree-${screen.width}`);
  expect(new Set(boxes.map(({ x }) => x)).size).toBe(1);
  expect(new Set(boxes.map(({ width }) => width)).size).toBe(1);
  expect(boxes.map(({ y }) => y)).toEqual(boxes.map(({ y }) => y).sort((a, b) => a - b));
});

test("a tree that is saved is not asked for again until it changes", async () => {
  const { tablet, metamers } = await unsaved();
  await begin(tablet, "Save it");
  await recent(tablet)
    .getByRole("button", { name: /^Tree / })
    .tap();
  await tablet.until("it is opened", (facts) => facts.metamers === metamers);
  await tablet.tap("New tree");
  await tablet.until("nothing is asked", (facts) => facts.metamers === 0 && facts.rows > 0);
  expect(await tablet.page.getByRole("dialog").count()).toBe(0);
  await listed(tablet, 0);
});

test("a tree that is not wanted is not kept; one that is left for another is", async () => {
  const { tablet, metamers } = await unsaved();
  await begin(tablet, "Do not keep it");
  await listed(tablet, 0);
  await tablet.page.goBack();
  await tablet.until("its link still leads to it", (facts) => facts.metamers === metamers);
  await tablet.tap("Save");
  await tablet.page.getByRole("button", { name: "Save tree" }).tap();
  await tablet.page.getByRole("dialog").waitFor({ state: "detached" });
  await tablet.page.keyboard.down("g");
  await tablet.until("it goes on", (facts) => facts.metamers > metamers);
  await tablet.page.keyboard.up("g");
  await tablet.untilQuiet();
  await tablet.tap("Library");
  await tablet.page
    .getByRole("button", { name: /^Open Tree/ })
    .first()
    .tap();
  await tablet.until("the saved one is opened", (facts) => facts.metamers === metamers);
  await listed(tablet, 1);
});

test("a tree is forgotten once that is sure", async () => {
  const { tablet } = await unsaved();
  await begin(tablet, "Keep under Unsaved");
  await tablet.tap("Library");
  const section = tablet.page.getByRole("region", { name: "Unsaved" });
  await section.getByRole("button", { name: /^Forget the tree/ }).tap();
  await section.getByRole("button", { name: "Keep", exact: true }).tap();
  await section.getByRole("button", { name: /^Forget the tree/ }).tap();
  await section.getByRole("button", { name: "Forget", exact: true }).tap();
  await section.waitFor({ state: "detached" });
});

test("a new tree begins without a question where nothing has grown", async () => {
  const { tablet } = await workshop.fresh(SMALL);
  const before = tablet.page.url();
  await tablet.tap("New tree");
  await expect.poll(() => tablet.page.url()).not.toBe(before);
  await tablet.untilReady();
  expect(await tablet.page.getByRole("dialog").count()).toBe(0);
});
