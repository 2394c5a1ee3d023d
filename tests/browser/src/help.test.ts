import { describe, expect, it } from "vitest";
import { SMALL } from "./screens";
import type { Tablet } from "./tablet";
import { middle, way } from "./ways";
import { seedling, Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

const labelled = (tablet: Tablet, label: string) => tablet.page.getByLabel(label, { exact: true });

describe("a first run", () => {
  it("shows three gestures, and is remembered", async () => {
    const { tablet } = await workshop.fresh();
    await tablet.page.evaluate(() => localStorage.setItem("espalier.tour", "false"));
    await tablet.page.reload();
    await tablet.untilReady();
    const card = tablet.page.getByRole("region", { name: "A tour in three gestures" });
    await card.getByText("1 of 3").waitFor();
    const seed = await seedling(tablet);
    await tablet.swipe([way(seed, { x: seed.x, y: seed.y - 200 })]);
    await card.getByText("2 of 3").waitFor();
    const strip = await tablet.boxOf(labelled(tablet, "Turn the tree"));
    await tablet.swipe([way(middle(strip), { x: strip.x + strip.width, y: strip.y + 20 })]);
    await card.getByText("3 of 3").waitFor();
    const lever = await tablet.boxOf(labelled(tablet, "Grow"));
    await tablet.swipe([way(middle(lever), { x: middle(lever).x, y: middle(lever).y - 12 }, 4)]);
    await card.waitFor({ state: "detached" });
    await tablet.untilQuiet();
    await tablet.page.reload();
    await tablet.untilReady();
    await tablet.untilStill();
    expect(await card.count()).toBe(0);
    await tablet.page.keyboard.press("Shift+?");
    await tablet.page.getByRole("button", { name: "Take the tour" }).tap();
    await card.getByText("1 of 3").waitFor();
    await card.getByRole("button", { name: "Skip" }).tap();
    await card.waitFor({ state: "detached" });
  });

  it("help is found by typing", async () => {
    const { tablet } = await workshop.fresh();
    await tablet.tap("Help");
    const help = tablet.page.getByRole("dialog");
    await help.getByRole("searchbox").fill("pinch limb");
    await help.getByText("Pinch around a limb", { exact: false }).waitFor();
    const topics = () => help.locator("dt").allTextContents();
    await expect.poll(topics).toEqual(["Width"]);
    await help.getByRole("searchbox").fill("apical dominance");
    await expect.poll(topics).toContain("Apical dominance");
    await help.getByRole("searchbox").fill("no such thing anywhere");
    await help.getByText("Nothing found").waitFor();
  });

  it("help shows what it speaks of", async () => {
    const { tablet } = await workshop.fresh(SMALL);
    const { page } = tablet;
    const shown = async (query: string, topic: string) => {
      // A sheet that has just gone keeps the keys to itself until the next frame.
      await tablet.frames();
      await page.keyboard.press("Shift+?");
      const help = page.getByRole("dialog", { name: "How to draw a tree", exact: true });
      await help.getByRole("searchbox").fill(query);
      await help
        .getByRole("button", { name: `Show: ${topic}`, exact: true })
        .first()
        .tap();
      await help.waitFor({ state: "detached" });
    };
    // Who reads English may know the German word.
    await shown("Bibliothek", "Library");
    const library = page.getByRole("dialog", { name: "Library" });
    await library.waitFor();
    await page.keyboard.press("Escape");
    await library.waitFor({ state: "detached" });
    await shown("shears", "Prune");
    await tablet.until("the shears are at hand", ({ tool }) => tool === "prune");
    await shown("mature", "Dominance when mature");
    await page.getByRole("tab", { name: "Growth", selected: true }).waitFor();
    await shown("ripe fruits", "Colour of fruits");
    await page.getByRole("region", { name: "Leaves", exact: true }).waitFor();
    // What is pointed at is so for a moment only.
    const field = await tablet.watchFor('.drawer[aria-label="Branches"] .field-name.pointed');
    await shown("relief", "Relief");
    expect(await field()).toContain("Relief");
    const strip = await tablet.watchFor(".rotation.pointed");
    await shown("rotation strip", "Rotation strip");
    await strip();
    await shown("tour", "Help and tour");
    await page.getByText("1 of 3").waitFor();
  });
});
