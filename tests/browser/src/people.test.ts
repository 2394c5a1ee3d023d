import { expect, test } from "vitest";
import { misses } from "./hits";
import { editorsLink, guestsLink, ownersLink } from "./invitations";
import { LANDSCAPE, PHONE, type Screen } from "./screens";
import { until } from "./server";
import { press } from "./visits";
import { way } from "./ways";
import { seedling, Workshop } from "./workshop";

// Nobody is let in merely for sitting at the machine.
const workshop = Workshop.withItsOwnServer(["--auth"]);

test.each([
  ["tablet", LANDSCAPE],
  ["phone", PHONE],
] as const)(
  "AC17, AC18: on a %s a guest is handed the tree, has it taken back, and is removed",
  async (name, screen) => {
    const owner = await workshop.open(ownersLink(workshop.server, "Ann"), screen);
    const { page } = owner;
    const link = await guestsLink(owner, "Beech", "Bo");
    const guest = await workshop.open(link, { width: 600, height: 500, detail: 0.3 });
    await owner.press(page.locator(".people-chip"));
    const people = page.getByRole("dialog").locator(".people").first();
    const bo = people.locator("li").filter({ hasText: "Bo" });
    await bo.getByRole("button", { name: "Hand the tree over to Bo" }).waitFor();
    await owner.show(`people-here-${name}`);
    await owner.press(bo.getByRole("button", { name: "Hand the tree over to Bo" }));
    await owner.show(`people-hand-over-${name}`);
    await owner.press(bo.getByRole("button", { name: "Hand over", exact: true }));
    await page.getByText("This tree was handed over to Bo.").waitFor();
    await bo.getByText("Owner", { exact: true }).waitFor();
    expect(await bo.getByRole("button", { name: "Remove Bo" }).count(), "owners stay").toBe(0);
    await owner.show(`people-heir-${name}`);
    await owner.press(page.getByRole("button", { name: "Take that back" }));
    await owner.press(bo.getByRole("button", { name: "Remove Bo" }));
    await owner.show(`people-remove-${name}`);
    await owner.press(bo.getByRole("button", { name: "Remove", exact: true }));
    await page.getByText("Bo was removed; their link works no longer").waitFor();
    await bo.waitFor({ state: "detached" });
    await guest.page.getByText("has removed you from this tree. Your link works no longer", { exact: false }).waitFor();
    await guest.showNow(`people-removed-${name}`);
    await expect.poll(() => guest.page.evaluate(async () => (await fetch("/api/v1/me")).status)).toBe(401);
  },
);

test.each<[string, Screen]>([
  ["tablet", LANDSCAPE],
  ["upright", { ...LANDSCAPE, width: LANDSCAPE.height, height: LANDSCAPE.width }],
  ["phone", PHONE],
])("AC12: on a %s the owner lets whoever is here do more or less", async (name, screen) => {
  const owner = await workshop.open(ownersLink(workshop.server, "Ann"), screen);
  const { page } = owner;
  const link = await guestsLink(owner, `Larch of the ${name}`, "Bo");
  const guest = await workshop.open(link, { width: 600, height: 500, detail: 0.3 });
  await owner.press(page.locator(".people-chip"));
  const bo = page.getByRole("dialog").locator(".people").first().locator("li").filter({ hasText: "Bo" });
  const may = (text: string) => bo.getByText(text, { exact: true }).waitFor();
  const role = bo.getByRole("combobox", { name: "What Bo may do" });
  await may("May draw");
  await role.waitFor();
  expect(await role.inputValue()).toBe("editor");
  expect(await misses(owner, "the list", ".sheet", false)).toEqual([]);
  await owner.show(`people-roles-${name}`);
  await role.selectOption("commenter");
  await may("May comment");
  await guest.page.locator(".toast", { hasText: "You may no longer draw on this tree" }).waitFor();
  await until("the choice stays", async () => (await role.inputValue()) === "commenter");
  await role.selectOption("viewer");
  await may("May look");
  await role.selectOption("editor");
  await may("May draw");
  await guest.page.locator(".toast", { hasText: "You may draw on this tree now" }).waitFor();

  // Who came otherwise has their role elsewhere: the list says so, and leads to what may have given it to them.
  const cy = await workshop.open(editorsLink(workshop.server, "Cy"), { width: 600, height: 500, detail: 0.3 });
  await cy.page.goto(page.url());
  const cys = page.getByRole("dialog").locator(".people").first().locator("li").filter({ hasText: "Cy" });
  await cys.getByText("this tree was shared with them by name", { exact: false }).waitFor();
  expect(await cys.getByRole("combobox").count()).toBe(0);
  await until("no note is left", async () => (await page.locator(".toast").count()) === 0, 20_000);
  expect(await misses(owner, "the list with Cy", ".sheet", false)).toEqual([]);
  await owner.show(`people-roles-elsewhere-${name}`);
  await owner.press(cys.getByRole("button", { name: "Share with people…" }));
  await page.getByRole("dialog", { name: "Share with people" }).waitFor();
  await owner.press(page.getByRole("button", { name: "Back to who is here" }));
  await cys.waitFor();
});

test.each<[string, Screen]>([
  ["tablet", { ...LANDSCAPE, detail: 0.3 }],
  ["phone", { ...PHONE, detail: 0.3 }],
])("AC16: a tree is locked under the hand of a guest on a %s, who may then comment alone", async (name, screen) => {
  const owner = await workshop.open(ownersLink(workshop.server, "Ann"), { ...LANDSCAPE, detail: 0.3 });
  const guest = await workshop.open(await guestsLink(owner, "Rowan", "Bo"), screen);
  const tools = guest.page.getByRole("button", {
    name: /^(Brush|All tools|Lasso|Undo|Redo|Save|Architecture|Plant a seed)/,
  });
  expect(await tools.count()).toBeGreaterThan(1);
  // He is drawing.
  const seed = await seedling(guest);
  await guest.lead([way(seed, { x: seed.x, y: seed.y - 150 })]);
  await guest.until("it grows", ({ metamers }) => metamers > 3);
  await press(owner, "Share");
  await owner.press(owner.page.getByRole("button", { name: "Lock the tree" }));
  await owner.page.getByText("Locked by Ann", { exact: false }).waitFor();
  await guest.page.locator(".toast", { hasText: "You may no longer draw on this tree" }).waitFor();
  await guest.page.getByText("You may comment, not draw").waitFor();
  await guest.touch("touchEnd", []);
  await until("no tool is left", async () => (await tools.count()) === 0);
  const { metamers } = await guest.untilQuiet();
  expect(metamers, "what he has drawn stays").toBeGreaterThan(3);
  await guest.show(`people-locked-${name}`);
  // One finger turns the tree now, and draws nothing.
  await guest.swipe([way({ x: seed.x, y: seed.y - 200 }, { x: seed.x + 80, y: seed.y - 200 })]);
  expect(await guest.untilQuiet()).toMatchObject({ metamers });
  await press(guest, "Comments");
  await guest.press(guest.page.getByRole("button", { name: "Comment on the whole tree" }));
  await guest.page.getByLabel("What you want to say").fill("I was not done yet.");
  await guest.press(guest.page.getByRole("button", { name: "Send" }));
  await guest.page.locator(".comment-text", { hasText: "I was not done yet." }).waitFor();
  await owner.press(owner.page.getByRole("button", { name: "Unlock the tree" }));
  await guest.page.locator(".toast", { hasText: "You may draw on this tree now" }).waitFor();
  await until("the tools are back", async () => (await tools.count()) > 1);
  await guest.press(guest.page.getByRole("button", { name: "Close Comments" }));
  const { sent } = await guest.facts();
  await guest.swipe([way({ x: seed.x, y: seed.y - 100 }, { x: seed.x + 80, y: seed.y - 180 })]);
  await guest.until("he draws on", (facts) => facts.sent > sent && facts.sent === facts.acknowledged);
});

test.each([
  ["tablet", { ...LANDSCAPE, detail: 0.3 }],
  ["phone", { ...PHONE, detail: 0.5 }],
] as const)(
  "RP1, CT5: on a %s who may only comment sees the step that a comment is of, and moves nobody",
  async (name, screen) => {
    const owner = await workshop.open(ownersLink(workshop.server, "Ann"), { ...LANDSCAPE, detail: 0.3 });
    const link = await guestsLink(owner, `Birch of the ${name}`, "Bo", "commenter");
    const seed = await seedling(owner);
    await owner.swipe([way(seed, { x: seed.x, y: seed.y - 150 })]);
    const { present: early } = await owner.untilQuiet();
    await press(owner, "Comments");
    await owner.press(owner.page.getByRole("button", { name: "Comment on the whole tree" }));
    await owner.page.getByLabel("What you want to say").fill("To slender so far");
    await owner.press(owner.page.getByRole("button", { name: "Send" }));
    const said = owner.page.locator(".comment-text");
    await said.waitFor();
    await owner.swipe([way({ x: seed.x, y: seed.y - 140 }, { x: seed.x + 60, y: seed.y - 260 })]);
    const { present: late } = await owner.untilQuiet();
    expect(late).toBeGreaterThan(early);

    const guest = await workshop.open(link, screen);
    const { page } = guest;
    await guest.until("the tree of now is there", ({ present }) => present === late);
    const faces = owner.page.getByRole("button", { name: "Bo (May comment)", exact: false });
    await faces.waitFor();
    await press(guest, "Comments");
    await guest.press(page.locator(".comment-threads button").first());
    expect(await page.getByRole("button", { name: /for everyone/ }).count(), "time is not theirs to move").toBe(0);
    await guest.press(page.getByRole("button", { name: `See step ${early}` }));
    await page.locator(".replay").waitFor();
    await guest.until("the tree of then is there", ({ present }) => present === early);
    await page.locator(".comment-text").waitFor();
    await guest.show(`comment-look-${name}`);
    expect(await owner.untilQuiet(), "nobody is moved").toMatchObject({ present: late });
    await guest.press(page.locator(".replay").getByRole("button", { name: "Back to the tree" }));
    await guest.until("they are back", ({ present }) => present === late);
    await page.locator(".comment-text", { hasText: "To slender so far" }).waitFor();

    // One's own words are changed, and only by whoever wrote them.
    expect(await page.getByRole("button", { name: "Change", exact: true }).count()).toBe(0);
    await owner.press(owner.page.getByRole("button", { name: "Change", exact: true }));
    await owner.page.getByLabel("What you want to say").fill("Too slender so far");
    await owner.show(`comment-edit-${name}`);
    await owner.press(owner.page.getByRole("button", { name: "Save the words" }));
    await page.locator(".comment-text", { hasText: "Too slender so far" }).waitFor();
    await page.locator(".comment-head", { hasText: "changed" }).waitFor();
  },
);
