import { text } from "node:stream/consumers";
import { expect, test } from "vitest";
import { PHONE, SMALL } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import { press } from "./visits";
import { middle, way } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer();

/** A tablet with a tree that nobody has saved. */
async function grown(screen = SMALL): Promise<{ tablet: Tablet; address: string; metamers: number }> {
  const { tablet, address } = await workshop.fresh(screen);
  await workshop.act(address, [{ kind: "grow", steps: 4 }]);
  await tablet.until("it has grown", ({ metamers }) => metamers > 0);
  return { tablet, address, metamers: (await tablet.untilQuiet()).metamers };
}

/** Opens a sheet, and waits for what it has to say. */
async function open(tablet: Tablet, name: string): Promise<void> {
  await press(tablet, name);
  await tablet.page.getByRole("dialog").waitFor();
  await tablet.untilSettled();
}

/** Saves the tree as a new one. */
async function saveAs(tablet: Tablet, name: string): Promise<void> {
  await open(tablet, "Save");
  await tablet.page.getByLabel("Name", { exact: true }).fill(name);
  await tablet.page.getByRole("button", { name: "Save tree" }).tap();
  await tablet.page.getByText(`Saved “${name}”`).waitFor();
  await tablet.page.getByRole("dialog").waitFor({ state: "detached" });
}

/** Saves the tree as the next version of its own. */
async function saveNext(tablet: Tablet, number: number, note: string): Promise<void> {
  await open(tablet, "Save");
  await tablet.page.getByLabel("Note (optional)").fill(note);
  await tablet.page.getByRole("button", { name: `Save version ${number}` }).tap();
  await tablet.page.getByText(`Saved version ${number} of`).waitFor();
  await tablet.page.getByRole("dialog").waitFor({ state: "detached" });
}

async function grow(tablet: Tablet, address: string): Promise<number> {
  const before = (await tablet.facts()).metamers;
  await workshop.act(address, [{ kind: "grow", steps: 2 }]);
  await tablet.until("it has grown on", ({ metamers }) => metamers !== before);
  return (await tablet.untilQuiet()).metamers;
}

/** Chooses from the menu of a tree or a version. */
async function choose(tablet: Tablet, of: string, deed: string): Promise<void> {
  await tablet.page.getByRole("button", { name: `More for ${of}`, exact: true }).tap();
  await tablet.page.locator(".card-menu").getByRole("button", { name: deed }).tap();
}

const cards = (tablet: Tablet) => tablet.page.locator(".library-main > .library .card-name");
const section = (tablet: Tablet, name: string) => tablet.page.getByRole("radio", { name, exact: true }).check();

test("a tree is saved as the next version of its own, with a note, and versions are compared and restored", async () => {
  const { tablet, address, metamers } = await grown();
  const { page } = tablet;
  await saveAs(tablet, "Oak");
  await open(tablet, "Save");
  await page.getByText(/^Nothing has changed since version 1/).waitFor();
  await page.keyboard.press("Escape");
  const more = await grow(tablet, address);
  await open(tablet, "Save");
  await page.getByText(/^Saved last as version 1,.* is not saved/).waitFor();
  await page.keyboard.press("Escape");
  await page.getByRole("dialog").waitFor({ state: "detached" });
  await saveNext(tablet, 2, "A limb to the left");
  await open(tablet, "Library");
  expect(await cards(tablet).allTextContents(), "it is one tree").toEqual(["Oak"]);
  await choose(tablet, "Oak", "Versions (2)");
  await page.getByText("A limb to the left").waitFor();
  await page.getByLabel("Compare version 1").check();
  await page.getByLabel("Compare version 2").check();
  await tablet.show("versions");
  await page.getByRole("button", { name: "Compare", exact: true }).tap();
  const compared = page.getByRole("region", { name: "Compare" });
  await compared.getByText(`+${more - metamers} metamers between them`).waitFor();
  expect(await compared.locator("img").count()).toBe(2);
  await compared.getByRole("row", { name: /^Note none A limb to the left$/ }).waitFor();
  await compared.getByRole("row", { name: new RegExp(`^Metamers ${metamers} ${more}$`) }).waitFor();
  // Both are seen from one place, and turned together by a finger on either.
  const views = () =>
    compared.locator("img").evaluateAll((pictures) => {
      const asked = pictures.map((picture) => new URL((picture as HTMLImageElement).src));
      return asked.map(({ pathname, search }) => (pathname.endsWith("/tree.png") ? search : ""));
    });
  await expect.poll(async () => new Set(await views()).size === 1 && (await views())[0] !== "").toBe(true);
  const [front] = await views();
  const first = await tablet.boxOf(compared.locator(".comparison-picture").first());
  const on = (across: number) => ({ x: first.x + across * first.width, y: first.y + first.height / 2 });
  await tablet.swipe([way(on(0.3), on(0.75), 8)]);
  await expect.poll(async () => new Set(await views()).size === 1 && (await views())[0] !== front).toBe(true);
  await tablet.show("versions-compared");
  await page.getByRole("button", { name: "All versions" }).tap();
  await choose(tablet, "version 1", "Edit note");
  await page.getByLabel("Note on version 1").fill("As it began");
  await page.getByRole("button", { name: "Save", exact: true }).last().tap();
  await page.locator("[data-version='1']").getByText("As it began").waitFor();
  await choose(tablet, "version 1", "New tree from it");
  await page.getByText("“Oak, from version 1” is in the library").waitFor();
  await choose(tablet, "version 1", "Restore as the newest");
  await page.locator("[data-version='3']").getByText("as version 1").waitFor();
  await page.locator(".toast-row", { hasText: "as version 3" }).getByRole("button", { name: "Open" }).tap();
  await tablet.until("it is as it was", (facts) => facts.metamers === metamers);
});

test("who saves after somebody else is told, and chooses", async () => {
  const { tablet, address } = await grown();
  const { page } = tablet;
  await saveAs(tablet, "Elm");
  await page.reload();
  await tablet.untilReady();
  await grow(tablet, address);
  await open(tablet, "Save");
  await page.getByRole("button", { name: "Save version 2" }).waitFor();
  // Meanwhile somebody else saves the very session.
  const saved = await page.evaluate(async () => {
    const { trees } = await (await fetch("/api/v1/trees")).json();
    const { id } = trees.find(({ name }: { name: string }) => name === "Elm");
    const session = (await (await fetch("/api/v1/sessions", post({}))).json()).session;
    return (await fetch(`/api/v1/trees/${id}/versions`, post({ session, author: "Ann", note: "Mine" }))).status;
    function post(body: object) {
      return { method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify(body) };
    }
  });
  expect(saved).toBe(201);
  await page.getByRole("button", { name: "Save version 2" }).tap();
  await page.getByText(/^Ann saved version 2/).waitFor();
  await tablet.show("overtaken");
  await page.getByRole("button", { name: "See the versions" }).tap();
  await page.getByText("Mine", { exact: true }).waitFor();
  await page.keyboard.press("Escape");
  await open(tablet, "Save");
  await page.getByRole("button", { name: "Save version 3 all the same" }).tap();
  await page.getByText("Saved version 3 of “Elm”").waitFor();
});

test("on a phone a tree is renamed in a row of its own, noted, deleted and taken back", async () => {
  const { tablet } = await grown(PHONE);
  const { page } = tablet;
  await saveAs(tablet, "Ash");
  await open(tablet, "Library");
  await choose(tablet, "Ash", "Rename");
  const field = page.getByLabel("New name of Ash");
  expect((await field.boundingBox())!.width, "there is room to type").toBeGreaterThan(200);
  await tablet.show("rename-phone");
  await field.fill("Old ash");
  await page.keyboard.press("Enter");
  await choose(tablet, "Old ash", "Edit note");
  await page.getByLabel("Note on Old ash").fill("By the pond");
  await page.getByRole("button", { name: "Save", exact: true }).tap();
  await page.getByText("By the pond").waitFor();
  await choose(tablet, "Old ash", "Delete");
  await page.getByText("Old ash", { exact: true }).waitFor({ state: "detached" });
  await page.locator(".toast-row", { hasText: "is deleted" }).getByRole("button", { name: "Undo" }).tap();
  await cards(tablet).getByText("Old ash").waitFor();
  await choose(tablet, "Old ash", "Delete");
  await section(tablet, "Deleted");
  const days = page.locator(".card", { hasText: "Old ash" }).getByText("30 days left");
  await days.waitFor();
  const lines = (element: Element) => {
    const text = document.createRange();
    text.selectNodeContents(element);
    return text.getClientRects().length;
  };
  expect(await days.evaluate(lines), "the days stand in one line").toBe(1);
  await tablet.show("deleted-phone");
  await page.getByRole("button", { name: "Take Old ash back" }).tap();
  await section(tablet, "Trees");
  await cards(tablet).getByText("Old ash").waitFor();
});

test("several trees are chosen by a finger that is held, and by keys", async () => {
  const { tablet } = await grown();
  const { page } = tablet;
  for (const name of ["One", "Two", "Three"]) {
    await open(tablet, "Save");
    const anew = page.getByRole("button", { name: "Save as new tree…" });
    if ((await anew.count()) > 0) await anew.tap();
    await page.getByLabel("Name", { exact: true }).fill(name);
    await page.getByRole("button", { name: "Save tree" }).tap();
    await page.getByRole("dialog").waitFor({ state: "detached" });
  }
  await open(tablet, "Library");
  const one = page.getByRole("button", { name: "Open One" });
  // Away from the notes at the edge of the page.
  await one.evaluate((element) => element.scrollIntoView({ block: "center" }));
  await tablet.touch("touchStart", [middle((await one.boundingBox())!)]);
  await page.getByText("1 selected").waitFor();
  await tablet.touch("touchEnd", []);
  await page.getByRole("button", { name: "Select Two" }).tap();
  await page.getByText("2 selected").waitFor();
  await tablet.show("selected");
  await page.getByRole("toolbar").getByRole("button", { name: "Duplicate" }).tap();
  await cards(tablet).getByText("One (copy)").waitFor();
  await cards(tablet).getByText("Two (copy)").waitFor();
  await page.getByRole("button", { name: "Open Two (copy)" }).focus();
  const begun = await page.evaluate(() => document.activeElement?.getAttribute("aria-label"));
  await page.keyboard.press("ArrowRight");
  expect(await page.evaluate(() => document.activeElement?.getAttribute("aria-label"))).not.toBe(begun);
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("Delete");
  await until("it is gone", async () => (await cards(tablet).getByText("Two (copy)").count()) === 0);
  await cards(tablet).getByText("One (copy)").waitFor();
});

test("a new tree begins with a template, or as a species", async () => {
  const { tablet, metamers } = await grown();
  const { page } = tablet;
  await saveAs(tablet, "Pattern");
  await open(tablet, "Library");
  await choose(tablet, "Pattern", "Make it a template");
  await page.getByText("“Pattern” is a template now").waitFor();
  await page.keyboard.press("Escape");
  await press(tablet, "New tree");
  await tablet.until("an empty one begins", (facts) => facts.metamers === 0 && facts.rows > 0);
  await page.getByRole("button", { name: "Begin with a template…" }).tap();
  await page.getByRole("button", { name: "Begin a new tree as Pattern" }).tap();
  await tablet.until("it begins as the template", (facts) => facts.metamers === metamers);
  await open(tablet, "Save");
  expect(await page.getByLabel("Name", { exact: true }).inputValue(), "a tree of its own").not.toBe("Pattern");
  await page.keyboard.press("Escape");
  await page.getByRole("dialog").waitFor({ state: "detached" });
  await open(tablet, "Library");
  await section(tablet, "Templates");
  const species = page.getByRole("region", { name: "Species" }).locator(".card-open").first();
  await species.waitFor();
  await tablet.untilSettled();
  await tablet.show("templates");
  await species.tap();
  await tablet.until("a seedling", (facts) => facts.metamers === 0 && facts.rows > 0 && facts.operations !== "");
});

test("all that can be done with chosen trees is in sight at the foot of a phone", async () => {
  const { tablet } = await grown(PHONE);
  const { page } = tablet;
  await saveAs(tablet, "Whitebeam");
  await open(tablet, "Library");
  await page.getByRole("button", { name: "Select", exact: true }).tap();
  const bar = page.getByRole("toolbar", { name: "Selected trees" });
  await page.getByRole("button", { name: "Select Whitebeam" }).first().tap();
  await bar.getByText("1 selected").waitFor();
  await tablet.show("library-chosen-phone");
  const { y, height } = await tablet.boxOf(bar);
  expect(Math.round(y + height), "it stands at the foot").toBe(PHONE.height);
  for (const name of ["Done", "Duplicate", "Make it a template", "Delete"]) {
    const { x, width } = await tablet.boxOf(bar.getByRole("button", { name, exact: true }));
    expect([x >= 0, x + width <= PHONE.width], name).toEqual([true, true]);
  }
  const copies = () => cards(tablet).filter({ hasText: "Whitebeam" }).count();
  const before = await copies();
  await bar.getByRole("button", { name: "Duplicate" }).tap();
  await expect.poll(copies).toBe(before + 1);
});

test("a tree of the library is downloaded from its menu, and the one on the page stays", async () => {
  const { tablet, address, metamers } = await grown(PHONE);
  await saveAs(tablet, "Larch");
  await grow(tablet, address);
  await open(tablet, "Library");
  await choose(tablet, "Larch", "Download…");
  const card = tablet.page.getByRole("dialog", { name: "Download this tree" });
  await card.getByRole("radio", { name: "Skeleton (JSON)" }).check();
  await tablet.show("library-download");
  const file = await tablet.download(card.getByRole("button", { name: "Download file" }));
  expect(file.suggestedFilename()).toMatch(/^Larch\..*json$/);
  const { metamers: rows } = JSON.parse(await text(await file.createReadStream()));
  expect(rows.filter((row: { parent: number | null }) => row.parent !== null).length, "as it was saved").toBe(metamers);
  expect(tablet.page.url()).toBe(address);
});
