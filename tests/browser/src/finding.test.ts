import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";
import { misses } from "./hits";
import { LANDSCAPE, PHONE, type Screen } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import { middle, type Point, way } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer();

const DETAIL = 0.5;
const SCREENS = {
  landscape: { ...LANDSCAPE, detail: DETAIL },
  upright: { width: 834, height: 1194, detail: DETAIL },
  phone: { ...PHONE, detail: DETAIL },
} as const satisfies Record<string, Screen>;

/** A finger is held this long at least before it drags, by the page's own clock. */
const HELD = "1 selected";

/** A tablet with the library open, in which trees of these names lie and no others, the last one saved last. */
async function library(screen: Screen, names: readonly string[]): Promise<Tablet> {
  const { tablet, address } = await workshop.fresh(screen);
  await workshop.act(address, [{ kind: "grow", steps: 4 }]);
  await tablet.until("it has grown", ({ metamers }) => metamers > 0);
  await tablet.untilQuiet();
  await tablet.page.evaluate(async (names) => {
    const session = location.pathname.slice(location.pathname.lastIndexOf("/") + 1);
    for (const { id } of (await (await fetch("/api/v1/trees")).json()).trees) {
      await fetch(`/api/v1/trees/${id}`, { method: "DELETE" });
    }
    for (const name of names) {
      const body = JSON.stringify({ session, name, author: "Ann" });
      await fetch("/api/v1/trees", { method: "POST", headers: { "content-type": "application/json" }, body });
    }
  }, names);
  await open(tablet);
  return tablet;
}

async function open(tablet: Tablet): Promise<void> {
  await tablet.tap("Library");
  await tablet.page.getByRole("dialog").waitFor();
  await tablet.untilSettled();
}

/** Waits until exactly these trees are listed, in this order. */
async function listed(tablet: Tablet, what: string, names: readonly string[]): Promise<void> {
  const cards = tablet.page.locator(".library-main > .library .card-name");
  let found: string[] = [];
  await until(`${what}: ${names.join(", ")}`, async () => {
    found = await cards.allTextContents();
    return found.join() === names.join();
  }).catch((error) => {
    throw new Error(`${error}; listed are ${found.join(", ")}`);
  });
}

/** Chooses from the menu of a tree or a collection. */
async function choose(tablet: Tablet, of: string, deed: string): Promise<void> {
  await tablet.page.getByRole("button", { name: `More for ${of}`, exact: true }).tap();
  await tablet.page.locator(".card-menu").getByRole("button", { name: deed, exact: true }).tap();
}

async function makeCollection(tablet: Tablet, name: string): Promise<void> {
  await tablet.page.getByRole("button", { name: "New collection", exact: true }).tap();
  await tablet.page.getByLabel("Name of the new collection").fill(name);
  await tablet.page.keyboard.press("Enter");
  await tablet.page.getByText(`“${name}” is there.`).waitFor();
  await place(tablet, name).waitFor({ state: "attached" });
}

/** Looks into a collection: on a phone they are picked from a list. */
async function lookInto(tablet: Tablet, name: string): Promise<void> {
  const list = tablet.page.getByRole("combobox", { name: "Collections", exact: true });
  await ((await list.isVisible()) ? list.selectOption(name) : place(tablet, name).tap());
}

const place = (tablet: Tablet, name: string) =>
  tablet.page.locator(".collection", { has: tablet.page.getByText(name, { exact: true }) });

/** The middle of a part of the page, once it is in sight. */
async function middleOf(tablet: Tablet, found: ReturnType<Tablet["page"]["locator"]>): Promise<Point> {
  // Away from what lies over the edges of the sheet.
  await found.evaluate((element) => element.scrollIntoView({ block: "center", inline: "center" }));
  return middle(await tablet.boxOf(found));
}

/** Holds a finger on a tree until it is chosen, and drags it to a collection. */
async function drag(tablet: Tablet, name: string, collection: string, chosen = HELD): Promise<void> {
  const { page } = tablet;
  const from = await middleOf(tablet, page.getByRole("button", { name: new RegExp(`^(Open|Select) ${name}$`) }));
  await tablet.touch("touchStart", [from]);
  await page.getByText(chosen).waitFor();
  const to = middle((await place(tablet, collection).boundingBox())!);
  for (const point of way(from, to, 8).slice(1)) await tablet.touch("touchMove", [point]);
  await page.locator(".drag-ghost[data-over=true]").waitFor();
  await tablet.showNow(`library-drag-${collection}`);
  await tablet.touch("touchEnd", []);
  await page.locator(".drag-ghost").waitFor({ state: "detached" });
}

test.each(Object.entries(SCREENS))("trees are searched, filtered, starred and tagged: %s", async (name, screen) => {
  const tablet = await library(screen, ["Érable", "Pear", "Apple"]);
  const { page } = tablet;
  const all = ["Apple", "Pear", "Érable"];
  await listed(tablet, "all of them", all);
  expect(await misses(tablet, "the library", "dialog")).toEqual([]);
  await choose(tablet, "Érable", "Edit tags");
  await page.getByLabel("New tag").fill("old, Red maple");
  await page.getByRole("button", { name: "Remove the tag Red maple" }).waitFor();
  expect(await misses(tablet, "the tags of a tree", ".card-form")).toEqual([]);
  await page.locator(".card-form").getByRole("button", { name: "Save" }).tap();
  await page.locator(".card-tags", { hasText: "Red maple" }).waitFor();
  await choose(tablet, "Pear", "Edit note");
  await page.getByLabel("Note on Pear").fill("By the lake");
  await page.locator(".card-form").getByRole("button", { name: "Save" }).tap();
  await page.getByText("By the lake").waitFor();

  await page.keyboard.press("/");
  await page.keyboard.type("LAK");
  await listed(tablet, "found in the note", ["Pear"]);
  expect(await page.locator(".card mark").allTextContents(), "it is shown what was found").toEqual(["lak"]);
  await tablet.show(`library-search-${name}`);
  await page.getByRole("button", { name: "Clear the search" }).tap();
  await listed(tablet, "all again", all);
  await page.getByRole("searchbox").fill("erab maple");
  await listed(tablet, "found in the name and a tag", ["Érable"]);
  await page.getByRole("button", { name: "No longer: “erab maple”" }).tap();
  await listed(tablet, "all again", all);
  expect(await page.getByRole("searchbox").inputValue()).toBe("");

  const star = page.getByRole("button", { name: "Favourite: Apple" });
  await star.tap();
  await page.locator(".card-star[aria-pressed=true]").waitFor();
  await page.getByRole("button", { name: /^Filters/ }).tap();
  await page.getByRole("button", { name: "Favourites", exact: true }).tap();
  await listed(tablet, "favourites", ["Apple"]);
  await page.locator(".filter-tags").getByRole("button", { name: /^old/ }).tap();
  await page.getByText("Nothing fits all of this: Tag: old, Favourites.").waitFor();
  await tablet.show(`library-filters-${name}`);
  expect(await misses(tablet, "filters", ".library-sections")).toEqual([]);
  await page.getByRole("button", { name: "Clear filters" }).tap();
  await listed(tablet, "all again", all);
  await page.getByLabel("Saved by").selectOption("Ann");
  await page.getByLabel("Size").selectOption("Under 1,000 metamers");
  await page.getByLabel("Order").selectOption("By name");
  await listed(tablet, "in another order", ["Apple", "Érable", "Pear"]);
  await page.getByLabel("Saved until").fill("2020-01-01");
  await page.getByText(/^Nothing fits all of this: By Ann, .*, Until 2020-01-01/).waitFor();
  await page.getByRole("button", { name: /^No longer: Until/ }).waitFor({ state: "detached" });
  await page.reload();
  await tablet.untilReady();
  await open(tablet);
  await page.getByText(/^Nothing fits all of this: By Ann/).waitFor();
});

test.each([
  ["upright", 390, 844, 0.3],
  ["that lies", 844, 390, 0.5],
])("on a phone %s the glass is for the trees", async (_, width, height, most) => {
  const tablet = await library({ width, height, detail: DETAIL }, ["Pear", "Apple"]);
  const { page } = tablet;
  const card = await tablet.boxOf(page.locator(".card").first());
  expect(card.y / height, "the bars above the first tree").toBeLessThan(most);
  expect(await misses(tablet, "the library", "dialog")).toEqual([]);
  await tablet.show(`library-phone-${width}`);
  if (height > width) {
    // Nothing is behind a scroll to the side, and files are where a thumb is.
    for (const name of ["Favourites", "Open a file…", "Select", "Filters"]) {
      const { x, width: wide } = await tablet.boxOf(page.getByRole("button", { name, exact: true }));
      expect(x >= 0 && x + wide <= width, name).toBe(true);
    }
    const file = await tablet.boxOf(page.getByRole("button", { name: "Open a file…" }));
    expect(file.y / height, "files").toBeGreaterThan(0.85);
  }
  await page.getByRole("button", { name: "Filters", exact: true }).tap();
  await page.getByLabel("Order").selectOption("By name");
  await listed(tablet, "in another order", ["Apple", "Pear"]);
  expect(await misses(tablet, "the filters", ".finder")).toEqual([]);
  await page.getByRole("button", { name: "Filters", exact: true }).tap();
  await page.getByLabel("Order").waitFor({ state: "hidden" });
  await page.getByRole("button", { name: "Select", exact: true }).tap();
  await page.getByRole("button", { name: "Select Pear" }).tap();
  expect(await misses(tablet, "chosen trees", ".selection-bar")).toEqual([]);
  const bar = await tablet.boxOf(page.locator(".selection-bar"));
  expect(bar.height / height, "what is done with them").toBeLessThan(0.3);
});

test.each(Object.entries(SCREENS))("trees are dragged into collections: %s", async (name, screen) => {
  const tablet = await library(
    screen,
    ["Elm", "Ash", "Oak"].map((tree) => `${tree} ${name}`),
  );
  const { page } = tablet;
  const [elm, ash, oak] = ["Elm", "Ash", "Oak"].map((tree) => `${tree} ${name}`) as [string, string, string];
  const [wood, copse] = [`Wood ${name}`, `Copse ${name}`];
  await page.getByRole("searchbox").fill(name);
  await listed(tablet, "the trees of this test", [oak, ash, elm]);
  expect(await page.locator(".card-people").count(), "all were saved from the session at work on the last").toBe(1);
  await makeCollection(tablet, wood);
  await drag(tablet, oak, wood);
  await page.getByText(`“${oak}” lies in “${wood}” now`).waitFor();
  await page.getByRole("button", { name: `Open ${elm}` }).waitFor();
  // Several at a time.
  await page.getByRole("button", { name: "Select", exact: true }).tap();
  await page.getByRole("button", { name: `Select ${ash}` }).tap();
  await drag(tablet, elm, wood, "2 selected");
  await page.getByText(`2 trees lie in “${wood}” now`).waitFor();
  await lookInto(tablet, wood);
  await listed(tablet, "in the collection", [oak, ash, elm]);
  await tablet.show(`library-collection-${name}`);
  expect(await misses(tablet, "collections", ".collections")).toEqual([]);
  await page.locator(".collections").evaluate((row) => row.scrollTo(0, 0));
  const anew = (await page.getByRole("button", { name: "New collection", exact: true }).boundingBox())!;
  expect(anew.x + anew.width, "a new one is at hand").toBeLessThanOrEqual(screen.width);

  await choose(tablet, `the collection ${wood}`, "New collection inside");
  await page.getByLabel("Name of the new collection").fill(copse);
  await page.keyboard.press("Enter");
  await page.getByText(`“${copse}” is there.`).waitFor();
  await choose(tablet, ash, "Move to…");
  await page.getByLabel(`Collection for ${ash}`).selectOption(`${wood} › ${copse}`);
  await page.getByRole("button", { name: "Move", exact: true }).tap();
  await listed(tablet, "no longer there", [oak, elm]);
  await page
    .locator(".toast-row", { hasText: `“${ash}” lies` })
    .getByRole("button", { name: "Undo" })
    .tap();
  await listed(tablet, "there again", [ash, oak, elm]);
  // Beside every collection it stays where it is.
  const from = await middleOf(tablet, page.getByRole("button", { name: `Open ${oak}` }));
  await tablet.touch("touchStart", [from]);
  await page.getByText(HELD).waitFor();
  for (const point of way(from, { x: from.x + 40, y: from.y + 30 }, 4)) await tablet.touch("touchMove", [point]);
  await page.locator(".drag-ghost[data-over=false]").waitFor();
  await tablet.touch("touchEnd", []);
  await page.getByText("Drop trees on a collection to move them.").waitFor();
  const end = page.getByRole("button", { name: "Done", exact: true });
  for (const to of [1e6, 0]) {
    await page.locator(".sheet").evaluate((sheet, to) => sheet.scrollTo(0, to), to);
    const { y, height } = (await end.boundingBox())!;
    expect(y > 0 && y + height < screen.height, "what ends choosing is in sight").toBe(true);
  }
  await end.tap();

  await choose(tablet, `the collection ${wood}`, "Rename");
  await page.getByLabel(`New name of the collection ${wood}`).fill(`Forest ${name}`);
  await page.keyboard.press("Enter");
  await choose(tablet, `the collection Forest ${name}`, "Delete");
  await page.getByText(`Delete “Forest ${name}” for good? The trees in it (3) stay, but in no collection.`).waitFor();
  await page.locator(".collections").getByRole("button", { name: "Delete", exact: true }).tap();
  await page.getByText(`“Forest ${name}” is deleted; its trees are still here`).waitFor();
  await listed(tablet, "they lie in none", [oak, ash, elm]);
});

test("a mouse drags a tree without holding it, and Escape leaves it where it is", async () => {
  const tablet = await library({ ...SCREENS.landscape, mouse: true }, ["Mouse oak"]);
  const { page } = tablet;
  await page.getByRole("button", { name: "New collection", exact: true }).click();
  await page.getByLabel("Name of the new collection").fill("Mouse wood");
  await page.keyboard.press("Enter");
  await place(tablet, "Mouse wood").waitFor();
  const from = await middleOf(tablet, page.getByRole("button", { name: "Open Mouse oak" }));
  const to = await middleOf(tablet, place(tablet, "Mouse wood"));
  const take = async () => {
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(to.x, to.y, { steps: 6 });
    await page.locator(".drag-ghost[data-over=true]").waitFor();
  };
  await take();
  await page.keyboard.press("Escape");
  await page.locator(".drag-ghost").waitFor({ state: "detached" });
  await page.mouse.up();
  expect(await page.getByRole("dialog").count(), "the sheet stays").toBe(1);
  await take();
  await page.mouse.up();
  await page.getByText("“Mouse oak” lies in “Mouse wood” now").waitFor();
});

/** Where the strip of pictures lies that is seen instead of a card's own picture. */
const turned = (tablet: Tablet) =>
  tablet.page
    .locator(".card-turn")
    .evaluate((picture) => Number.parseFloat(getComputedStyle(picture).backgroundPositionX));

test("LB9: a tree turns below a mouse that stays on it", async () => {
  const tablet = await library({ ...SCREENS.landscape, mouse: true }, ["Round oak"]);
  const { page } = tablet;
  const { x, y, width, height } = (await page.getByRole("button", { name: "Open Round oak" }).boundingBox())!;
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.locator(".card-turn").waitFor();
  expect(await turned(tablet), "from the front").toBe(0);
  await page.mouse.move(x + 0.75 * width, y + height / 2);
  await until("it has turned to the right", async () => Math.round(await turned(tablet)) === Math.round(900 / 11));
  await page.mouse.move(2, 2);
  await page.locator(".card-turn").waitFor({ state: "detached" });
});

test("LB9: a finger that moves across a tree turns it, and opens nothing", async () => {
  const tablet = await library(SCREENS.phone, ["Turned oak"]);
  const { page } = tablet;
  const card = page.getByRole("button", { name: "Open Turned oak" });
  const from = await middleOf(tablet, card);
  const { width } = (await card.boundingBox())!;
  await tablet.touch("touchStart", [from]);
  for (const point of way(from, { x: from.x + width / 4, y: from.y }, 6)) await tablet.touch("touchMove", [point]);
  await page.locator(".card-turn").waitFor();
  expect(Math.round(await turned(tablet))).toBe(Math.round(900 / 11));
  await tablet.touch("touchEnd", []);
  await page.locator(".card-turn").waitFor({ state: "detached" });
  expect(await page.getByRole("dialog").count(), "the library stays").toBe(1);
});

const SEEDS = join(import.meta.dirname, "../../fuzz/seeds");
const fileOf = (name: string, as = name) => ({
  name: as,
  mimeType: "application/octet-stream",
  buffer: readFileSync(join(SEEDS, name)),
});

test.each(Object.entries(SCREENS))("files become trees of the library: %s", async (name, screen) => {
  const tablet = await library(screen, []);
  const { page } = tablet;
  const field = page.locator(".library-deeds input[type=file]");
  await field.setInputFiles([fileOf("rtwig.csv", `Scan ${name}.csv`), { ...fileOf("rtwig.csv"), name: "bad.mtg" }]);
  await page.getByText(`“Scan ${name}” is in the library now`).waitFor();
  await page.getByText(/^bad\.mtg: It cannot become a tree: /).waitFor();
  await page.getByRole("button", { name: `Open Scan ${name}` }).waitFor();
  await tablet.show(`library-files-${name}`);
  await page.keyboard.press("Escape");
  await page.getByRole("dialog").waitFor({ state: "detached" });
  // What is dropped on the page opens the library.
  const document = await page.evaluate(async () => {
    const session = location.pathname.slice(location.pathname.lastIndexOf("/") + 1);
    return (await fetch(`/api/v1/sessions/${session}/tree.mtg`)).text();
  });
  await page.evaluate(
    ({ document, as }) => {
      const dataTransfer = new DataTransfer();
      dataTransfer.items.add(new File([document], as));
      for (const kind of ["dragover", "drop"]) {
        window.dispatchEvent(new DragEvent(kind, { dataTransfer, bubbles: true, cancelable: true }));
      }
    },
    { document, as: `Graph ${name}.mtg` },
  );
  await page
    .locator(".toast-row", { hasText: `“Graph ${name}” is` })
    .getByRole("button", { name: "Open" })
    .tap();
  await tablet.until("it is open", ({ metamers, rows }) => metamers > 0 && rows > 0);
  await page.getByRole("dialog").waitFor({ state: "detached" });
});

test.each(Object.entries(SCREENS))(
  "a scan is taken again in other units and as another species: %s",
  async (name, screen) => {
    const tablet = await library(screen, []);
    const { page } = tablet;
    const file = `Young ${name}.mtg`;
    await page.locator(".library-deeds input[type=file]").setInputFiles(fileOf("units.mtg", file));
    // Its diameters are in millimetres.
    await page.getByText(/Its trunk is as thick as 5714 % of its height/).waitFor();
    await page.getByRole("button", { name: `Open Young ${name}` }).waitFor();
    await page.getByRole("combobox", { name: "Unit of diameters" }).selectOption("Diameters in mm");
    await page.getByRole("combobox", { name: "Species", exact: true }).selectOption("Oak");
    await page.locator(".toast-row").first().waitFor({ state: "detached" });
    const again = page.getByRole("button", { name: `Take ${file} again` });
    await again.scrollIntoViewIfNeeded();
    await tablet.show(`library-units-${name}`);
    expect(await misses(tablet, "units of a scan", ".library-deeds")).toEqual([]);
    const taken = page.waitForResponse((answer) => answer.url().includes("/trees/import?"));
    await again.tap();
    const answer = await taken;
    const asked = new URL(answer.url()).searchParams;
    expect([asked.get("species"), asked.get("diameter_unit"), answer.status()]).toEqual(["oak", "0.001", 201]);
    await page
      .getByRole("button", { name: `Open Young ${name}` })
      .nth(1)
      .waitFor();
    await page.getByText(`“Young ${name}” is in the library now`).waitFor();
    expect(await page.getByText("Its trunk is as thick").count()).toBe(0);
  },
);
