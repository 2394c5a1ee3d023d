import { expect, test } from "vitest";
import { misses } from "./hits";
import { LANDSCAPE, type Screen } from "./screens";
import type { Tablet } from "./tablet";
import { atWork, openPart, PARTS, press, SHEETS } from "./visits";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** Nothing is looked at here, so there are few pixels; but what slides in ends where it is to be hit. */
const SEEN = { detail: 0.2, moves: true };
const SCREENS = {
  landscape: { ...LANDSCAPE, ...SEEN },
  portrait: { width: 834, height: 1194, ...SEEN },
  phone: { width: 390, height: 844, ...SEEN },
} as const satisfies Record<string, Screen>;

/** Each by a finger; a mouse, which needs no larger controls, on the glass that has most of them at once. */
const CASES = [
  ...Object.entries(SCREENS).map(([name, screen]) => ({ name, pointer: "a finger", screen })),
  { name: "landscape", pointer: "a mouse", screen: { ...SCREENS.landscape, mouse: true } },
];

/** A page with a tree, which one that was saved stands beside in the library. */
async function grown(screen: Screen): Promise<Tablet> {
  const { tablet, address } = await workshop.fresh(screen);
  await workshop.act(address, [{ kind: "grow", steps: 4 }]);
  await tablet.until("it has grown", ({ metamers }) => metamers > 0);
  await tablet.untilQuiet();
  await tablet.page.evaluate(async () => {
    const session = location.pathname.slice(location.pathname.lastIndexOf("/") + 1);
    const headers = { "content-type": "application/json" };
    const post = async (address: string, body: object) =>
      (await fetch(address, { method: "POST", headers, body: JSON.stringify(body) })).json();
    const { id } = await post("/api/v1/trees", { session, name: "A tree that was saved" });
    await post(`/api/v1/trees/${id}/versions`, { session });
    const gone = await post("/api/v1/trees", { session, name: "A tree that was deleted" });
    await fetch(`/api/v1/trees/${gone.id}`, { method: "DELETE" });
  });
  return tablet;
}

/** The library with what it unfolds: a tree's menu and its name, choosing, templates, versions. */
async function lookIntoLibrary(tablet: Tablet, look: (where: string, within: string) => Promise<void>): Promise<void> {
  const { page } = tablet;
  const menu = page.locator(".card-menu");
  const unfold = () => page.getByRole("button", { name: "More for A tree that was saved" }).first().click();
  await unfold();
  await look("the menu of a tree", ".card-menu");
  await menu.getByRole("button", { name: "Rename" }).click();
  await look("Rename in the library", ".card-form");
  await page.keyboard.press("Escape");
  for (const deed of ["Edit tags", "Move to…"]) {
    await unfold();
    await menu.getByRole("button", { name: deed }).click();
    await look(`${deed} in the library`, ".card-form");
    await page.keyboard.press("Escape");
  }
  await page.getByRole("button", { name: "New collection", exact: true }).click();
  await look("a new collection", ".collections");
  await page.keyboard.press("Escape");
  await page.getByRole("searchbox").fill("that was");
  await page.getByRole("button", { name: /^No longer/ }).waitFor();
  await page.getByRole("button", { name: "Filters", exact: true }).click();
  await look("what is searched", ".library-sections");
  await page.getByRole("button", { name: "Clear filters" }).click();
  await page.getByRole("button", { name: "Select", exact: true }).click();
  await page.getByRole("button", { name: "Select A tree that was saved" }).first().click();
  await look("chosen trees", ".selection-bar");
  await page.getByRole("button", { name: "Done", exact: true }).click();
  await page.getByRole("radio", { name: "Templates", exact: true }).check();
  await page.getByRole("region", { name: "Species" }).waitFor();
  await look("the sections", ".library-bar");
  await page.getByRole("radio", { name: "Deleted", exact: true }).check();
  await page.getByText("A tree that was deleted").first().waitFor();
  await look("deleted trees", "dialog");
  await page.getByRole("radio", { name: "Trees", exact: true }).check();
  await unfold();
  await menu.getByRole("button", { name: "Versions (2)" }).click();
  for (const number of [1, 2]) await page.getByLabel(`Compare version ${number}`).check();
  await tablet.untilSettled();
  await look("versions", "dialog");
  await page.getByRole("button", { name: "Compare", exact: true }).click();
  await page.getByRole("region", { name: "Compare" }).waitFor();
  await tablet.untilSettled();
  await look("two versions side by side", "dialog");
}

/** What shares a tree: a link to be made, one that was made, and one that is to be revoked. */
async function lookAtSharing(tablet: Tablet, look: (where: string, within: string) => Promise<void>): Promise<void> {
  const { page } = tablet;
  await press(tablet, "Library");
  await page.getByRole("button", { name: "More for A tree that was saved" }).first().click();
  await page.locator(".card-menu").getByRole("button", { name: "Share by link…" }).click();
  await page.getByText("Nobody has been invited").waitFor();
  await tablet.untilSettled();
  await look("what a link is to be for", "dialog");
  await page.getByRole("button", { name: "Make a link" }).click();
  await page.getByRole("img", { name: "The link as a QR code" }).waitFor();
  await page.locator(".link-row").waitFor();
  await tablet.untilSettled();
  await look("a link that was made", "dialog");
  await page.getByRole("button", { name: "Revoke the link of Guest" }).click();
  await look("a link to be revoked", ".link-row");
  await page.getByRole("button", { name: "Revoke", exact: true }).click();
  await page.getByText("Nobody has been invited").waitFor();
  await page.keyboard.press("Escape");
  await page.getByRole("dialog").waitFor({ state: "detached" });
}

/** What orders many trees, with what it can be asked for, and what came of it. */
async function lookAtVariations(tablet: Tablet, look: (where: string, within: string) => Promise<void>): Promise<void> {
  const { page } = tablet;
  await press(tablet, "Library");
  await page.getByRole("radio", { name: "Templates", exact: true }).check();
  await page.getByRole("button", { name: "More for Oak", exact: true }).click();
  await look("the menu of a species", ".card-menu");
  await page.locator(".card-menu").getByRole("button", { name: "Grow variations…" }).click();
  await page.getByRole("radio", { name: "Model (glTF)" }).check();
  await page.getByRole("radio", { name: "Larger" }).check();
  await page.getByLabel("Metamers at least: value", { exact: true }).fill("40");
  await tablet.untilSettled();
  await look("how many trees are ordered, and as what", ".order-form");
  await page.getByRole("radio", { name: "Skeleton (JSON)" }).check();
  await page.getByLabel("How many: value", { exact: true }).fill("1");
  await page.keyboard.press("Enter");
  await page.locator(".job").getByText("Done", { exact: true }).waitFor();
  await tablet.untilSettled();
  await look("trees that were ordered", "dialog");
  await page.getByRole("button", { name: "Remove the trees like Oak" }).click();
  await look("ordered trees to be removed", ".job");
  await page.getByRole("button", { name: "Remove", exact: true }).click();
  await page.locator(".job").waitFor({ state: "detached" });
  await page.keyboard.press("Escape");
  await page.getByRole("dialog").waitFor({ state: "detached" });
}

/** What can be chosen of each format. */
async function lookAtFormats(tablet: Tablet, look: (where: string, within: string) => Promise<void>): Promise<void> {
  const formats = tablet.page.locator('input[name="format"]');
  await formats.nth(1).waitFor({ state: "attached" });
  for (let i = 0; i < (await formats.count()); i += 1) {
    await formats.nth(i).check();
    await tablet.untilSettled();
    await look(`format ${i + 1} of downloads`, "dialog");
  }
}

test.each(CASES)("every control is hit where it is drawn: $name, by $pointer", async ({ screen }) => {
  const tablet = await grown(screen);
  const { page } = tablet;
  const found: string[] = [];
  const look = async (where: string, within?: string) => void found.push(...(await misses(tablet, where, within)));
  /** Opens what a button unfolds, looks, and closes it. */
  const unfold = async (name: RegExp, within: string) => {
    const button = page.getByRole("button", { name, expanded: false });
    if ((await button.count()) === 0) return;
    await button.click();
    await look(`${name}`, within);
    await page.keyboard.press("Escape");
  };
  await look("the page");
  await page.getByRole("button", { name: /timeline$/ }).click();
  await look("the line of time, otherwise", ".foot");
  await unfold(/^All tools/, ".flyout");
  await unfold(/^Way of drawing/, ".draw-modes");
  await unfold(/^More$/, ".menu");
  for (const key of ["l", "n", "w", "x", "t", "p", "b"]) {
    await page.keyboard.press(key);
    await tablet.untilSettled();
    if ((await page.locator(".tool-options button").count()) > 0) await look(`the options of ${key}`, ".tool-options");
  }
  await page.keyboard.press("d");
  await look("a legend", ".workspace");
  await page.keyboard.press("Shift+d");
  for (const part of PARTS) {
    await openPart(tablet, part);
    await look(`${part.panel} ${part.tab ?? ""}`, ".drawer");
  }
  await openPart(tablet, { panel: "Architecture", tab: "Species", least: 0 });
  await look("Architecture Species", ".drawer");
  // Its programme has stages nearer to each other than fingers are wide.
  await page.locator('.species-card[data-species="stone-pine"]').click();
  await tablet.untilQuiet();
  await openPart(tablet, { panel: "Architecture", tab: "Growth", least: 0 });
  await page.getByRole("button", { name: "The next stage" }).click();
  await look("the programme of a species", ".programme");
  await openPart(tablet, { panel: "Scene", least: 0 });
  await look("Scene", ".drawer");
  for (const thing of ["Box", "Sphere", "Plane"]) {
    await page.locator(".kinds").getByRole("button", { name: thing, exact: true }).click();
    await page.locator(".obstacles [aria-expanded=true]", { hasText: thing }).waitFor();
    await look(`Scene with ${thing}`, ".drawer");
  }
  await page
    .locator(".drawer")
    .getByRole("button", { name: /^Close/ })
    .click();
  for (const sheet of SHEETS) {
    await press(tablet, sheet);
    await page.getByRole("dialog").waitFor();
    await tablet.untilSettled();
    await look(sheet, "dialog");
    if (sheet === "Library") await lookIntoLibrary(tablet, look);
    // A mouse needs no larger controls than a finger.
    if (sheet === "Download" && tablet.touches) await lookAtFormats(tablet, look);
    await page.keyboard.press("Escape");
    await page.getByRole("dialog").waitFor({ state: "detached" });
  }
  await page.keyboard.press("h");
  await look("everything hidden", ".workspace");
  expect(found).toEqual([]);
});

test.each(CASES)(
  "every control is hit where it is drawn when a tree is shared and many like one are ordered: $name, by $pointer",
  async ({ screen }) => {
    const tablet = await grown(screen);
    const found: string[] = [];
    const look = async (where: string, within: string) => void found.push(...(await misses(tablet, where, within)));
    await lookAtSharing(tablet, look);
    await lookAtVariations(tablet, look);
    expect(found).toEqual([]);
  },
);

test.each(CASES)(
  "every control is hit where it is drawn when a tree is left: $name, by $pointer",
  async ({ screen }) => {
    const { tablet, address } = await workshop.fresh(screen);
    const { page } = tablet;
    const found: string[] = [];
    await workshop.act(address, [{ kind: "grow", steps: 4 }]);
    await tablet.until("it has grown", ({ metamers }) => metamers > 0);
    await tablet.untilQuiet();
    await press(tablet, "New tree");
    const asked = page.getByRole("dialog", { name: "A new tree" });
    await asked.waitFor();
    await tablet.untilSettled();
    found.push(...(await misses(tablet, "what is asked before a new tree", "dialog")));
    await asked.getByRole("button", { name: "Keep under Unsaved" }).click();
    await page.getByRole("region", { name: "Go on with a tree" }).waitFor();
    await tablet.untilSettled();
    found.push(...(await misses(tablet, "the first screen with a tree of before")));
    await page.evaluate(() => localStorage.setItem("espalier.tour", "false"));
    await page.reload();
    await tablet.untilReady();
    await page.getByText("1 of 3").waitFor();
    await tablet.untilSettled();
    found.push(...(await misses(tablet, "the tour")));
    expect(found).toEqual([]);
  },
);

test.each(CASES)(
  "every control is hit where it is drawn while tools are at work: $name, by $pointer",
  async ({ screen }) => {
    const stem = await workshop.stem(screen);
    const found: string[] = [];
    const look = async (where: string) => void found.push(...(await misses(stem.tablet, where, ".workspace", false)));
    await atWork(stem, look);
    expect(found).toEqual([]);
  },
);
