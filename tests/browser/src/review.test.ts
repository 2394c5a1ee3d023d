import { writeFile } from "node:fs/promises";
import { join } from "node:path";
import { expect, test } from "vitest";
import { screenshots } from "./browser";
import { misses } from "./hits";
import { guestsLink, ownersLink } from "./invitations";
import { print } from "./paper";
import { LANDSCAPE, PHONE, type Screen } from "./screens";
import { until } from "./server";
import { KEEPING, sideBySide } from "./side-by-side";
import type { Tablet } from "./tablet";
import { press } from "./visits";
import { middle, type Point, way } from "./ways";
import { seedling, sessionOf, Workshop } from "./workshop";

// People log in: on a server of one's own whoever sits at it would be the same person on both pages.
const workshop = Workshop.withItsOwnServer(["--auth"]);

const UPRIGHT: Screen = { ...LANDSCAPE, width: 834, height: 1194 };
/** As far as a finger turns the tree, in pixels. */
const TURN = 90;

/** As people see it where pictures are kept. */
function seen(screen: Screen): Screen {
  return { ...screen, detail: KEEPING ? 0.6 : 0.2, watched: KEEPING, moves: true };
}

/** Ann's page with a tree on it, places about its stem, and a link for Bo. */
async function anns(screen: Screen) {
  const ann = await workshop.open(ownersLink(workshop.server, "Ann"), seen(screen));
  await slender(ann);
  const seed = await seedling(ann);
  const at = (right: number, up: number): Point => ({ x: seed.x + right, y: seed.y - up });
  await ann.swipe([way(at(0, 0), at(0, 300))]);
  await ann.untilQuiet();
  await workshop.actAs(ann, [{ kind: "grow", steps: 5 }]);
  const link = await guestsLink(ann, "Oak by the gate", "Bo");
  await ann.untilQuiet();
  return { ann, link, at };
}

/** Takes the thinnest brush there is. */
async function slender(tablet: Tablet): Promise<void> {
  const slider = tablet.page.getByRole("slider", { name: "Brush radius" });
  const { x, y, width, height } = await tablet.boxOf(slider);
  await tablet.swipe([way({ x: x + width / 2, y: y + height / 2 }, { x: x + width / 2, y: y + height + 30 })]);
  await until("it is thin", async () => (await slider.getAttribute("aria-valuenow")) === "0");
}

/** How far the tree is turned on a page, in degrees. */
async function turned({ page }: Tablet): Promise<number> {
  return Number(await page.getByRole("slider", { name: "Turn the tree" }).getAttribute("aria-valuenow"));
}

/** One finger turns the tree by the strip at the foot. */
async function turn(tablet: Tablet, pixels: number): Promise<number> {
  const before = await turned(tablet);
  const { x, y } = middle(await tablet.boxOf(tablet.page.getByRole("slider", { name: "Turn the tree" })));
  await tablet.swipe([way({ x, y }, { x: x + pixels, y })]);
  await until("it has turned", async () => Math.abs((await turned(tablet)) - before) > 5);
  await tablet.untilStill();
  return turned(tablet);
}

/** Opens who is here, and presses one of the buttons there. */
async function amongPeople(tablet: Tablet, button: string): Promise<void> {
  await tablet.press(tablet.page.locator(".people-chip"));
  await tablet.press(tablet.page.getByRole("dialog").getByRole("button", { name: button }));
  await tablet.page.getByRole("dialog").waitFor({ state: "detached" });
}

/** Takes back what this page's person drew last; the page says so. */
async function undone(tablet: Tablet): Promise<void> {
  const said = await tablet.watchFor(".toast", "Undone: Stroke");
  await tablet.tap("Undo");
  await said();
  await tablet.untilQuiet();
}

/** Where the pin of the first thread is on a page, once it rests there. */
async function pinOn(tablet: Tablet): Promise<void> {
  await tablet.page.locator('.comment-pin[data-shown="true"][data-thread="1"]').waitFor({ state: "attached" });
  await tablet.untilStill();
}

/** Where the metamers of the tree are, as the server has it. */
async function wood(tablet: Tablet): Promise<Set<string>> {
  return new Set(
    await tablet.page.evaluate(async (session) => {
      const { metamers } = await (await fetch(`/api/v1/sessions/${session}/tree.json`)).json();
      return (metamers as { position: number[] }[]).map(({ position }) => position.map((at) => at.toFixed(3)).join());
    }, sessionOf(tablet)),
  );
}

/** Draws a limb from the trunk, seen in the middle of the picture, so far to the side as a share of it; gives what wood has come. */
async function limb(tablet: Tablet, up: number, across: number): Promise<Set<string>> {
  const before = await wood(tablet);
  const { metamers } = await tablet.facts();
  const { x, y, width, height } = await tablet.boxOf(tablet.page.locator("#workspace"));
  const foot = { x: x + width / 2, y: y + height * (1 - up) };
  // On narrow glass it would be nothing but a twig.
  const reach = Math.sign(across) * Math.max(Math.abs(across) * width, 120);
  await tablet.swipe([way(foot, { x: foot.x + reach, y: foot.y - 0.7 * Math.abs(reach) })]);
  await tablet.until("it grows", (facts) => facts.metamers > metamers + 3);
  await tablet.untilQuiet();
  return without(await wood(tablet), before);
}

function without(all: ReadonlySet<string>, some: ReadonlySet<string>): Set<string> {
  return new Set([...all].filter((one) => !some.has(one)));
}

function stands(all: ReadonlySet<string>, some: ReadonlySet<string>): string {
  const count = [...some].filter((one) => all.has(one)).length;
  return count === some.size ? "all of it" : count === 0 ? "none of it" : `${count} of ${some.size}`;
}

/** A finger that rests on what both drew at once reads whose it is, and goes nowhere in time. */
async function namesByTouch(ann: Tablet, name: string): Promise<void> {
  const { page } = ann;
  const fold = page.getByRole("button", { name: "Show the timeline" });
  if ((await fold.count()) > 0) await ann.press(fold);
  const { present, sent, operations } = await ann.facts();
  const signs = page.locator(".timeline .timeline-sign");
  const kinds = operations.split(" ");
  await until("each operation has a sign of its own", async () => (await signs.count()) === kinds.length);
  await ann.touch("touchStart", [middle(await ann.boxOf(signs.nth(kinds.lastIndexOf("stroke"))))]);
  const bubble = page.locator(".timeline-bubble");
  await bubble.locator("em", { hasText: "Bo" }).waitFor();
  const names = () =>
    bubble.locator("em").evaluateAll((all) => all.map(({ textContent, dataset }) => [textContent, dataset.away]));
  expect((await names()).sort()).toEqual([
    ["Ann", "true"],
    ["Bo", "false"],
  ]);
  await ann.showNow(`79-names-by-touch-${name}`);
  const box = (await bubble.boundingBox())!;
  const { width } = page.viewportSize()!;
  expect([box.x >= 0, box.x + box.width <= width], "all of it is on the glass").toEqual([true, true]);
  // By now a button would have said its name.
  await page.waitForTimeout(600);
  expect(await page.locator(".button-label:popover-open").count(), "nothing else is said there").toBe(0);
  await ann.touch("touchEnd", []);
  expect((await names()).length, "it stays to be read").toBe(2);
  await bubble.waitFor({ state: "detached" });
  const after = await ann.facts();
  expect([after.present, after.sent], "nobody travels").toEqual([present, sent]);
}

/** Says something of the trunk, for Bo. */
async function askBo(ann: Tablet): Promise<void> {
  await press(ann, "Comments");
  await ann.press(ann.page.getByRole("button", { name: "Comment on a place" }));
  await ann.page.locator(".comment-glass[data-placing]").waitFor();
  await ann.untilStill();
  // The panel has moved the tree aside; its trunk stays in the middle of the picture.
  const { x, y, width, height } = await ann.boxOf(ann.page.locator("#workspace"));
  let up = 0.2;
  await until("the place is on wood", async () => {
    if ((await ann.page.locator(".comment-compose").count()) > 0) return true;
    up = up > 0.5 ? 0.2 : up + 0.04;
    await ann.tapAt({ x: x + width / 2, y: y + height * (1 - up) });
    return false;
  });
  const words = ann.page.getByLabel("What you want to say");
  await words.fill("Could this limb come lower? ");
  await words.pressSequentially("@");
  await ann.press(ann.page.getByRole("button", { name: "@Bo", exact: true }));
  await expect.poll(() => words.inputValue()).toBe("Could this limb come lower? @Bo ");
  await ann.press(ann.page.getByRole("button", { name: "Send" }));
  await ann.page.locator(".mention", { hasText: "@Bo" }).waitFor();
}

/** Reads what is asked of him, and answers. */
async function answer(bo: Tablet): Promise<void> {
  await bo.press(bo.page.locator('.comment-pin[data-thread="1"] button'));
  await bo.page.locator('.mention[data-me="true"]').waitFor();
  await until("it is read", async () => (await bo.page.locator(".unread").count()) === 0);
  expect(await bo.page.locator(".toast", { hasText: "Ann has said" }).count(), "he is told no more").toBe(0);
  await bo.press(bo.page.getByRole("button", { name: "Answer" }));
  await bo.page.getByLabel("What you want to say").fill("I will draw one.");
  await bo.press(bo.page.getByRole("button", { name: "Send" }));
}

const closePanel = (tablet: Tablet) => tablet.press(tablet.page.getByRole("button", { name: "Close Comments" }));

/** Plays the design to its end, and gives what each was shown to do. */
async function played(tablet: Tablet): Promise<Map<string, Set<string>>> {
  const { page } = tablet;
  const fold = page.getByRole("button", { name: "Show the timeline" });
  if ((await fold.count()) > 0) await tablet.press(fold);
  await tablet.press(page.getByRole("button", { name: "Replay", exact: true }));
  const control = (name: string | RegExp) => page.locator(".replay").getByRole("button", { name });
  await tablet.press(control("Pause"));
  const by = new Map<string, Set<string>>();
  const { x, y, width, height } = await tablet.boxOf(page.locator(".replay").getByRole("slider", { name: "Time" }));
  for (let share = 0.02; share < 1; share += 0.06) {
    await tablet.tapAt({ x: x + share * width, y: y + height / 2 });
    await tablet.untilSettled();
    const caption = page.locator(".replay-caption");
    const name = (await caption.locator("em").count()) > 0 ? await caption.locator("em").innerText() : "";
    by.set(name, (by.get(name) ?? new Set()).add((await caption.innerText()).replace(name, "").trim()));
  }
  return by;
}

const WALKS: readonly [string, Screen, Screen][] = [
  ["tablets", LANDSCAPE, LANDSCAPE],
  ["upright", UPRIGHT, UPRIGHT],
  ["phone", LANDSCAPE, PHONE],
];

// The walk of docs/review.md. Fingers do all of it, but for what is written. It takes minutes where the processor draws: all
// three are walked when pictures are taken of them.
test("UD4: two draw at the same time, and each takes back their own", async () => {
  const { ann, link, at } = await anns(LANDSCAPE);
  const bo = await workshop.open(link, seen(LANDSCAPE));
  for (const page of [ann, bo]) {
    await until("the other one is shown", async () => (await page.page.locator(".people-chip").count()) === 1);
  }
  // Both see the same place at the same place of the glass.
  await amongPeople(bo, "Follow");
  await bo.page.locator("[data-following]").waitFor();
  await bo.untilStill();
  await slender(bo);
  const before = await wood(ann);
  const limbs: [Tablet, Point[]][] = [
    [ann, way(at(0, 300), at(170, 380))],
    [bo, way(at(0, 200), at(-170, 280))],
  ];
  const move = async (i: number) => {
    for (const [page, limb] of limbs) await page.touch("touchMove", [limb[i]!]);
  };
  const leaving = 4;
  // Fingers that the machine keeps waiting where they came down would not draw but hold what is there.
  await ann.inNoTime(() =>
    bo.inNoTime(async () => {
      for (const [page, limb] of limbs) await page.touch("touchStart", [limb[0]!]);
      for (let i = 1; i <= leaving; i++) await move(i);
    }),
  );
  for (let i = leaving + 1; i < limbs[0]![1].length; i++) await move(i);
  for (const [page] of limbs) await page.touch("touchEnd", []);
  await ann.until("both limbs have grown", ({ metamers }) => metamers >= before.size + 16);
  for (const page of [ann, bo]) await page.untilQuiet();
  const drawn = without(await wood(ann), before);
  const undo = async (page: Tablet) => {
    await undone(page);
    return wood(ann);
  };
  await ann.show("77-drawn-at-once");
  const left = await undo(ann);
  await ann.show("78-own-limb-taken-back");
  const hers = without(drawn, left);
  const his = without(drawn, hers);
  const side = (rows: ReadonlySet<string>) =>
    [...rows].reduce((sum, row) => sum + Math.sign(Number.parseFloat(row)), 0);
  expect(hers.size).toBeGreaterThan(3);
  expect(his.size).toBeGreaterThan(3);
  expect(Math.sign(side(hers)), "each one's is where they drew").toBe(-Math.sign(side(his)));
  expect(without(before, left).size, "nothing else has gone").toBe(0);
  for (const [name, { width, height }] of Object.entries({ across: LANDSCAPE, upright: UPRIGHT, phone: PHONE })) {
    await ann.page.setViewportSize({ width, height });
    await namesByTouch(ann, name);
  }
  await ann.page.setViewportSize({ width: LANDSCAPE.width, height: LANDSCAPE.height });
  expect(without(await undo(bo), before).size, "all that was drawn has gone").toBe(0);
});

test.each(KEEPING ? WALKS : WALKS.slice(0, 1))(
  "two review a tree in one room, on %s",
  async (name, annsScreen, bosScreen) => {
    const picture = (step: string, first?: () => Promise<void>) =>
      sideBySide(
        `${name}-${step}`,
        [
          ["Ann", ann],
          ["Bo", bo],
        ],
        first,
      );
    const { ann, link, at } = await anns(annsScreen);
    const bo = await workshop.open(link, seen(bosScreen));
    for (const page of [ann, bo]) {
      await until("the other one is shown", async () => (await page.page.locator(".people-chip").count()) === 1);
    }
    await ann.untilStill();

    // Ann draws: Bo sees her name, her brush and the tree grow.
    const before = await wood(ann);
    const stroke = way(at(0, 230), at(170, 360));
    await ann.lead([stroke]);
    await bo.page.locator('.companion[data-shown="true"]').waitFor({ state: "attached" });
    // Names go from pointers that rest.
    await picture("1-presence", () =>
      ann.touch("touchMove", [{ x: stroke.at(-1)!.x + 4 * Math.random(), y: stroke.at(-1)!.y }]),
    );
    await ann.touch("touchEnd", []);
    await ann.untilQuiet();
    const annsLimb = without(await wood(ann), before);
    expect(annsLimb.size).toBeGreaterThan(3);

    // Bo follows her, until he touches his picture.
    const followed = await ann.watchFor(".toast", "Bo follows your view");
    await amongPeople(bo, "Follow");
    await bo.page.locator("[data-following]").waitFor();
    await followed();
    const first = await turn(ann, TURN);
    await until("both see the same side", async () => Math.abs(first - (await turned(bo))) <= 1);
    await bo.untilStill();
    await picture("2-follow");
    const glass = middle(await bo.boxOf(bo.page.locator("#workspace")));
    const finger = (aside: number, moved: number) => ({ x: glass.x + aside, y: glass.y - 60 + moved });
    await bo.swipe([way(finger(-50, 0), finger(-50, 30)), way(finger(50, 0), finger(50, 30))]);
    await until("it has ended", async () => (await bo.page.locator("[data-following]").count()) === 0);
    await turn(ann, -TURN);
    await bo.untilStill();
    expect(Math.abs(first - (await turned(bo))), "he sees what he saw").toBeLessThanOrEqual(1);

    // She comments on a place, for Bo; he is told that something is for him, and answers.
    const called = await bo.watchFor(".toast", "Ann has said something to you");
    await askBo(ann);
    await called();
    await bo.page.locator('.unread[data-me="true"]').first().waitFor();
    await pinOn(bo);
    await picture("3-comment");
    await answer(bo);
    await ann.page.locator(".comment-text", { hasText: "I will draw one." }).waitFor();
    await picture("4-answer");
    for (const page of [ann, bo]) await closePanel(page);

    // She brings him to what she sees.
    const view = await turn(ann, -TURN);
    const brought = await bo.watchFor(".toast", "Ann has brought you here");
    await amongPeople(ann, "Bring everyone here");
    await brought();
    await until("he is there", async () => Math.abs(view - (await turned(bo))) <= 1);
    await bo.untilStill();
    await picture("5-gather");

    // Each draws, and takes back what is their own: what the other has drawn stays.
    await slender(bo);
    const bosLimb = await limb(bo, 0.36, -0.14);
    const another = await limb(bo, 0.5, 0.12);
    await ann.untilQuiet();
    await undone(ann);
    await bo.untilQuiet();
    const afterHers = await wood(ann);
    expect([annsLimb, bosLimb, another].map((one) => stands(afterHers, one))).toEqual([
      "none of it",
      "all of it",
      "all of it",
    ]);
    for (const page of [ann, bo]) await page.untilStill();
    await picture("6-undo");
    await undone(bo);
    const afterHis = await wood(bo);
    expect([bosLimb, another].map((one) => stands(afterHis, one))).toEqual(["all of it", "none of it"]);
    expect(without(before, afterHis).size, "what was there before stays").toBe(0);
    await ann.untilQuiet();
    expect((await ann.facts()).metamers).toBe((await bo.facts()).metamers);

    // It is done.
    await ann.press(ann.page.locator('.comment-pin[data-thread="1"] button'));
    await ann.press(ann.page.getByRole("button", { name: "Resolve" }));
    await ann.page.getByText("Resolved by Ann").waitFor();
    await bo.page.locator('.comment-pin[data-thread="1"]').waitFor({ state: "detached" });
    await picture("7-resolved");

    // The summary opens as a page of its own, and is printed whole.
    await ann.press(ann.page.getByRole("button", { name: "All comments" }));
    expect(await misses(ann, "the list of comments", ".drawer")).toEqual([]);
    const opened = ann.page.context().waitForEvent("page");
    await ann.press(ann.page.getByRole("link", { name: "Summary to read and print" }));
    const summary = await opened;
    await summary.getByRole("heading", { name: "Comments on Oak by the gate" }).waitFor();
    for (const words of ["Could this limb come lower? @Bo", "I will draw one.", "resolved by Ann"]) {
      await summary.getByText(words).waitFor();
    }
    const { pdf, pages, faults } = await print(summary);
    if (KEEPING) await writeFile(join(screenshots, `review-${name}.pdf`), pdf);
    expect(faults).toEqual([]);
    expect(pages.flatMap(({ pictures }) => pictures)).toHaveLength(1);
    await summary.close();

    // The design is played, with who did what.
    await closePanel(ann);
    const done = await played(ann);
    await picture("8-replay");
    expect([...done.keys()].sort()).toEqual(["", "Ann", "Bo"]);
    expect(done.get("Bo"), "what he drew").toContain("Stroke");
  },
  900_000,
);
