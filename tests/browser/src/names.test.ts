import { expect, test } from "vitest";
import { misses } from "./hits";
import { LANDSCAPE, PHONE, type Screen, SMALL } from "./screens";
import type { Tablet } from "./tablet";
import { middle } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** What shows a picture alone at the edges of the page. */
const ICONS = ":is(.tool-bar, .side-bar) :is(.tool, [role=slider])";

/** What the page says of what is open on it. */
async function opened(tablet: Tablet): Promise<unknown> {
  const { sent, tool } = await tablet.facts();
  const open = await tablet.page.locator("dialog, .drawer, [aria-expanded=true]").count();
  return { sent, tool, open, pressed: await tablet.page.locator(`${ICONS}[aria-pressed=true]`).count() };
}

/** A tablet on which names can be asked for: they come after the first picture. */
async function naming(screen: Screen): Promise<Tablet> {
  const { tablet } = await workshop.fresh(screen);
  await tablet.page.locator(".button-label").waitFor({ state: "attached" });
  return tablet;
}

test.each<[string, Screen, number]>([
  ["a tablet", { ...LANDSCAPE, detail: 0.2 }, 22],
  ["a phone", { ...PHONE, detail: 0.2 }, 12],
])("every icon says its name while a finger is held on it, and does nothing else: %s", async (_, screen, least) => {
  const tablet = await naming(screen);
  const label = tablet.page.locator(".button-label:popover-open strong");
  const before = await opened(tablet);
  const icons = await tablet.page.locator(ICONS).all();
  expect(icons.length).toBeGreaterThanOrEqual(least);
  for (const icon of icons) {
    const name = (await icon.getAttribute("aria-label"))!;
    const place = middle((await icon.boundingBox())!);
    await tablet.touch("touchStart", [place]);
    await label.filter({ hasText: name }).waitFor();
    const { x, y, width, height } = (await tablet.page.locator(".button-label").boundingBox())!;
    const purpose = tablet.page.locator(".button-label span");
    if ((await purpose.count()) > 0) expect(name, "nothing is said twice").not.toContain(await purpose.innerText());
    expect([x >= 0, y >= 0, x + width <= screen.width, y + height <= screen.height], name).not.toContain(false);
    await tablet.touch("touchEnd", []);
    await label.waitFor({ state: "detached" });
  }
  expect(await opened(tablet)).toEqual(before);
});

test("an icon says its name before the first tree is drawn", async () => {
  const { tablet } = await workshop.fresh(SMALL);
  const { page } = tablet;
  const place = middle(await tablet.boxOf(page.getByRole("button", { name: "Leaves", exact: true })));
  // The rows of a tree never come.
  await page.routeWebSocket(/socket/, () => {});
  await page.reload({ waitUntil: "domcontentloaded" });
  await page.getByRole("button", { name: "Leaves", exact: true }).waitFor();
  await tablet.touch("touchStart", [place]);
  await page.locator(".button-label:popover-open strong", { hasText: "Leaves" }).waitFor();
  expect(await tablet.facts()).toMatchObject({ rows: 0 });
  await tablet.touch("touchEnd", []);
  await page.locator(".button-label:popover-open").waitFor({ state: "detached" });
  expect(await page.getByRole("region", { name: "Leaves", exact: true }).count()).toBe(0);
});

test("a pen that was held on a button presses it only the next time", async () => {
  const tablet = await naming(SMALL);
  const { page } = tablet;
  const place = middle(await tablet.boxOf(page.getByRole("button", { name: "Leaves", exact: true })));
  const panel = page.getByRole("region", { name: "Leaves", exact: true });
  await tablet.pen("mousePressed", place);
  await page.locator(".button-label:popover-open", { hasText: "Leaves" }).waitFor();
  await tablet.pen("mouseReleased", place);
  await page.locator(".button-label:popover-open").waitFor({ state: "detached" });
  expect(await panel.count()).toBe(0);
  await tablet.inNoTime(async () => {
    await tablet.pen("mousePressed", place);
    await tablet.pen("mouseReleased", place);
  });
  await panel.waitFor();
});

test("a switch of the first run has every button show its name, and is remembered", async () => {
  const { tablet } = await workshop.fresh(SMALL);
  const { page } = tablet;
  await page.evaluate(() => localStorage.setItem("espalier.tour", "false"));
  await page.reload();
  await tablet.untilReady();
  await page.getByText("1 of 3").waitFor();
  const shown = () =>
    page.evaluate(
      (icons) =>
        [...document.querySelectorAll(`${icons}.tool`)].filter((icon) => {
          const { content, display } = getComputedStyle(icon, "::before");
          return display !== "none" && content === JSON.stringify(icon.getAttribute("aria-label"));
        }).length,
      ICONS,
    );
  expect(await shown()).toBe(0);
  await page.getByLabel("Names on all buttons").tap();
  await expect.poll(shown).toBe(await page.locator(`${ICONS}.tool`).count());
  await page.getByRole("button", { name: "Skip" }).tap();
  await page.reload();
  await tablet.untilReady();
  await expect.poll(shown).toBe(await page.locator(`${ICONS}.tool`).count());
  expect(await misses(tablet, "the bars with names", ".workspace")).toEqual([]);
});

test.each([
  ["a phone", { ...PHONE, detail: 0.2 }],
  ["an upright tablet", { width: 834, height: 1194, detail: 0.2 }],
] as const)("no button with its name lies over another on %s", async (where, screen) => {
  const { tablet } = await workshop.fresh(screen);
  for (const language of ["en", "de"]) {
    await tablet.page.evaluate((language) => {
      localStorage.setItem("espalier.language", JSON.stringify(language));
      localStorage.setItem("espalier.names", "true");
    }, language);
    await tablet.page.reload();
    await tablet.untilReady();
    expect(await misses(tablet, `${where}, ${language}`, ".workspace")).toEqual([]);
  }
});
