import { describe, expect, it } from "vitest";
import { LANDSCAPE, PHONE, type Point, SMALL, way } from "./tablet";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** So many fingers side by side, beside the tree. */
const fingers = (count: number): Point[] => Array.from({ length: count }, (_, i) => ({ x: 800 + 70 * i, y: 300 }));

describe("a tap of several fingers", () => {
  it("undoes with two and redoes with three, and says what", async () => {
    const { tablet, metamers } = await workshop.stem();
    const { page } = tablet;
    const tap = (count: number) =>
      tablet.inNoTime(async () => {
        await tablet.touch("touchStart", fingers(count));
        await tablet.touch("touchEnd", []);
      });
    await tap(2);
    await page.getByText("Undone: Stroke").waitFor();
    await tablet.until("it is undone", (facts) => facts.metamers === 0);
    await tap(3);
    await page.getByText("Redone: Stroke").waitFor();
    const again = await tablet.until("it is there again", (facts) => facts.metamers === metamers);
    await tap(3);
    await page.getByText("There is nothing to redo.").waitFor();
    // A pinch is no tap.
    await tablet.swipe([way(fingers(1)[0]!, { x: 700, y: 300 }), way(fingers(2)[1]!, { x: 970, y: 300 })]);
    expect((await tablet.untilQuiet()).sent).toBe(again.sent);
  });
});

describe("help and sheets", () => {
  it("one Escape closes a sheet, also while something is searched", async () => {
    const { tablet } = await workshop.fresh(SMALL);
    const { page } = tablet;
    const dialog = page.getByRole("dialog");
    await tablet.tap("Help");
    const search = dialog.getByRole("searchbox");
    await search.tap();
    await search.fill("eraser");
    await dialog.locator('[data-topic="prune"]').waitFor();
    await page.keyboard.press("Escape");
    await dialog.waitFor({ state: "detached" });
    for (const sheet of ["Save", "Library", "Share", "Settings"]) {
      await tablet.tap(sheet);
      await dialog.waitFor();
      await page.keyboard.press("Escape");
      await dialog.waitFor({ state: "detached" });
    }
  });
});

describe("the size of the tree", () => {
  it("stands in metres and years beside the metamers, in the page's language", async () => {
    const { tablet, metamers } = await workshop.stem(LANDSCAPE);
    const { page } = tablet;
    const size = page.locator(".figures .size");
    await expect.poll(() => size.textContent()).toMatch(/^\d\.\d+\sm high, 0(\.\d+)?\sm wide, \d+ years?$/);
    const metres = Number.parseFloat((await size.textContent())!);
    expect(metres, "no higher than all its internodes of a decimetre").toBeLessThanOrEqual(0.1 * metamers);
    await tablet.show("units");
    await page.evaluate(() => localStorage.setItem("espalier.language", '"de"'));
    await page.reload();
    await tablet.untilReady();
    await expect.poll(() => size.textContent()).toMatch(/^\d,\d+\sm hoch, 0(,\d+)?\sm breit, \d+ Jahre?$/);
    await tablet.tap("Rückgängig");
    await tablet.until("a seed alone has no size", (facts) => facts.metamers === 0);
    await size.waitFor({ state: "detached" });
  });

  it("leaves room for the controls on a phone", async () => {
    const { tablet, address } = await workshop.fresh(PHONE);
    await workshop.act(address, [{ kind: "grow", steps: 12 }]);
    await tablet.untilQuiet();
    const { x, width } = await tablet.boxOf(tablet.page.locator(".figures"));
    expect(x).toBeGreaterThanOrEqual(0);
    expect(x + width).toBeLessThanOrEqual(PHONE.width);
    await tablet.show("units-phone");
  });
});
