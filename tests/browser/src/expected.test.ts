import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { describe, expect, it, test } from "vitest";
import { screenshots } from "./browser";
import { changed, type Picture } from "./picture";
import { shrunk } from "./reference";
import { LANDSCAPE, PHONE, SMALL } from "./screens";
import type { Tablet } from "./tablet";
import { loop, type Point, way } from "./ways";
import { SEED, Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** So many fingers side by side, beside the tree. */
const fingers = (count: number): Point[] => Array.from({ length: count }, (_, i) => ({ x: 800 + 70 * i, y: 300 }));

describe("a tap of several fingers", () => {
  it("undoes with two and redoes with three, and says what", async () => {
    // A library that holds a tree has a card of those to go on with, on a page on which nothing was done.
    await workshop.stem();
    const { tablet, metamers } = await workshop.stem();
    const { page } = tablet;
    const tap = (count: number) =>
      tablet.inNoTime(async () => {
        await tablet.touch("touchStart", fingers(count));
        await tablet.touch("touchEnd", []);
      });
    /** Taps, and is there when it is said: what is said goes by itself. */
    const told = async (count: number, text: string) => {
      const said = page.getByText(text).waitFor();
      await tap(count);
      await said;
    };
    await told(2, "Undone: Stroke");
    await tablet.until("it is undone", (facts) => facts.metamers === 0);
    expect(await page.getByRole("region", { name: "Go on with a tree" }).count(), "something was done here").toBe(0);
    await told(3, "Redone: Stroke");
    const again = await tablet.until("it is there again", (facts) => facts.metamers === metamers);
    await told(3, "There is nothing to redo.");
    // A pinch is no tap.
    await tablet.swipe([way(fingers(1)[0]!, { x: 700, y: 300 }), way(fingers(2)[1]!, { x: 970, y: 300 })]);
    expect((await tablet.untilQuiet()).sent).toBe(again.sent);
  });
});

/** How many rows of the tree lie on each side of the trunk on the glass, from the left of the middle to its right. */
const sides = async (tablet: Tablet) => {
  const picture = await tablet.photograph("symmetry");
  const half = { y: 150, width: 300, height: 500 };
  return { picture, left: { ...half, x: SEED.x - 320 }, right: { ...half, x: SEED.x + 20 } };
};

describe("symmetry", () => {
  it("draws a stroke and its mirror image as one operation, and is kept", async () => {
    const { tablet, metamers } = await workshop.stem(LANDSCAPE);
    const { page } = tablet;
    const before = await sides(tablet);
    await tablet.tap("Brush");
    await page.getByRole("region", { name: "Brush", exact: true }).waitFor();
    await page.getByRole("radio", { name: "Mirror", exact: true }).tap();
    await tablet.tap("Close Brush");
    await page.getByText("Mirrored across the trunk").waitFor();
    await page.locator(".overlay.symmetry path[d]").waitFor({ state: "attached" });
    await tablet.lead([way({ x: SEED.x, y: 600 }, { x: 800, y: 480 })]);
    await tablet.showNow("symmetry-drawing");
    await tablet.touch("touchEnd", []);
    const grown = await tablet.untilQuiet();
    expect(grown.operations).toBe("stroke stroke");
    const after = await sides(tablet);
    const [left, right] = [before.left, before.right].map((box) => changed(before.picture, after.picture, box));
    expect(right).toBeGreaterThan(0.004);
    expect(left! / right!, "both sides have grown").toBeGreaterThan(0.5);
    expect(left! / right!).toBeLessThan(2);
    await tablet.tap("Undo");
    await tablet.until("both are undone at once", (facts) => facts.metamers === metamers);
    await page.reload();
    await tablet.untilReady();
    await page.getByText("Mirrored across the trunk").waitFor();
    await page.keyboard.press("y");
    await page.getByText("4 times around the trunk").first().waitFor();
    await tablet.tap("End the symmetry");
    await page.locator(".overlay.symmetry").waitFor({ state: "detached" });
  });

  it("LA1: repeats an outline around the trunk, as one operation", async () => {
    const { tablet, metamers } = await workshop.stem();
    const { page } = tablet;
    await tablet.take("Lasso");
    await page.keyboard.press("y");
    await page.keyboard.press("y");
    await tablet.lead([loop({ x: 700, y: 400 }, { x: 60, y: 60 })]);
    await expect.poll(() => page.locator('.outline[data-stage="drawing"] .outline-body').count()).toBe(4);
    await tablet.touch("touchEnd", []);
    const grown = await tablet.untilQuiet();
    expect(grown.sent, "the stem's stroke, and an outline four times").toBeGreaterThanOrEqual(4);
    await page.locator(".outline").waitFor({ state: "detached" });
    expect(grown.operations).toBe("stroke lasso");
    expect(grown.metamers).toBeGreaterThan(metamers);
    await tablet.tap("Undo");
    await tablet.until("all are undone at once", (facts) => facts.metamers === metamers);
  });
});

test.each([
  ["a tablet", { width: 834, height: 1194, detail: 0.2 }],
  ["a phone", { ...PHONE, detail: 0.2 }],
])("what is said of a stroke in vain stands clear of the bars: %s, upright", async (_, screen) => {
  // A library that holds a tree shows a card of those to go on with beside the bar.
  await workshop.stem();
  const { tablet } = await workshop.fresh(screen);
  const { page } = tablet;
  await tablet.tap("Hide these trees");
  // The sentence goes by itself; a slow machine would not see it.
  await page.evaluate(() => {
    const later = window.setTimeout.bind(window);
    const patient = (done: () => void, after?: number) => ((after ?? 0) > 4000 ? 0 : later(done, after));
    Object.assign(window, { setTimeout: patient });
  });
  const right = screen.width - 30;
  // The bar has its room before a finger is drawn beside it.
  await page.locator(".tool-bar").waitFor();
  await tablet.untilSettled();
  await tablet.swipe([way({ x: right, y: 20 + 64 }, { x: right - 50, y: 20 + 74 })]);
  const said = page.locator(".vain > span");
  await said.waitFor();
  const gap = async () => {
    const [sentence, bar] = [await said.boundingBox(), await page.locator(".tool-bar").boundingBox()];
    return sentence!.y - (bar!.y + bar!.height);
  };
  await expect.poll(gap).toBeGreaterThan(0);
  expect(await page.getByRole("region", { name: "Go on with a tree" }).count(), "it stays hidden").toBe(0);
});

describe("the brush and the picture", () => {
  it("the brush is no wider than the picture, dragged or typed, and says why", async () => {
    const { tablet } = await workshop.fresh(LANDSCAPE);
    const { page } = tablet;
    const slider = page.getByLabel("Brush radius", { exact: true });
    const radius = async () => Number(await slider.getAttribute("aria-valuenow"));
    const tooWide = page.getByText("A wider brush would not fit into the picture");
    // From the first view, which is 40 internodes high, the widest brush would be twice as wide as the picture.
    const track = await tablet.boxOf(slider);
    const x = track.x + track.width / 2;
    await tablet.swipe([way({ x, y: track.y + track.height / 2 }, { x, y: track.y - 40 })]);
    await tooWide.waitFor();
    const widest = await radius();
    expect(widest).toBeGreaterThan(10);
    expect(widest).toBeLessThan(20);
    // What is dragged after it is said would say it again.
    await tablet.untilQuiet();
    await tooWide.tap();
    // All of its way does something.
    const radii = [widest];
    for (const share of [0.1, 0.2, 0.3]) {
      await tablet.tapAt({ x, y: track.y + share * track.height });
      await expect.poll(radius).toBeLessThan(radii.at(-1)!);
      radii.push(await radius());
    }
    expect(radii.at(-1)).toBeGreaterThan(widest / 5);
    expect(await tooWide.count()).toBe(0);
    await tablet.tap("Brush");
    const typed = page.getByLabel("Radius: value", { exact: true });
    await typed.fill("35");
    await page.keyboard.press("Enter");
    await tooWide.waitFor();
    expect(await radius()).toBe(widest);
    await tablet.tap("Close Brush");
    // Nearer, the same brush would be too wide again.
    await tablet.swipe([way({ x: 560, y: 400 }, { x: 360, y: 400 }), way({ x: 640, y: 400 }, { x: 840, y: 400 })]);
    await expect.poll(radius).toBeLessThan(widest / 2);
  });

  it("the view moves back for growth that leaves it, and back again when asked", async () => {
    const { tablet, address } = await workshop.fresh(LANDSCAPE);
    const { page } = tablet;
    const back = page.getByRole("button", { name: "Back to my view" });
    await workshop.act(address, [{ kind: "grow", steps: 30 }]);
    await back.waitFor();
    await tablet.untilQuiet();
    await tablet.show("moved-back");
    await back.tap();
    await back.waitFor({ state: "detached" });
    await tablet.show("my-view");
    // Who looks at a part of the tree goes on doing so.
    await workshop.act(address, [{ kind: "grow", steps: 5 }]);
    await tablet.untilQuiet();
    expect(await back.count()).toBe(0);
    await tablet.tap("Show the whole tree");
    await workshop.act(address, [{ kind: "grow", steps: 12 }]);
    await back.waitFor();
    await tablet.untilQuiet();
    await tablet.tap("Show the whole tree");
    await back.waitFor({ state: "detached" });
    await tablet.tap("Settings");
    await page.getByLabel("Move back when growth leaves the picture").uncheck();
    await page.keyboard.press("Escape");
    await workshop.act(address, [{ kind: "grow", steps: 12 }]);
    await tablet.untilQuiet();
    expect(await back.count(), "it is turned off").toBe(0);
  });
});

describe("files", () => {
  const dialog = (tablet: Tablet) => tablet.page.getByRole("dialog", { name: "Download this tree" });
  const fileOf = async (tablet: Tablet, format: string, size?: string) => {
    await tablet.tap("Download");
    await dialog(tablet).getByRole("radio", { name: format }).check();
    if (size) await dialog(tablet).getByRole("radio", { name: size }).check();
    const download = await tablet.download(dialog(tablet).getByRole("button", { name: "Download file" }));
    const path = join(screenshots, `downloaded.${format.includes("PNG") ? "png" : "json"}`);
    await download.saveAs(path);
    return { name: download.suggestedFilename(), bytes: await readFile(path) };
  };

  it("what was chosen last is chosen again, and nothing else while it is not known what the server writes", async () => {
    const { tablet } = await workshop.stem(LANDSCAPE);
    const { page } = tablet;
    await fileOf(tablet, "Skeleton (JSON)");
    let answer = () => {};
    const held = new Promise<void>((done) => {
      answer = done;
    });
    await page.route("**/api/v1/formats", (route) => held.then(() => route.continue()));
    await page.reload();
    await tablet.tap("Download");
    const file = dialog(tablet).getByRole("button", { name: "Download file" });
    await file.waitFor();
    expect(await dialog(tablet).getByRole("radio", { checked: true }).count()).toBe(0);
    expect(await file.isEnabled()).toBe(false);
    await dialog(tablet).getByText("Asking the server what it makes…").waitFor();
    answer();
    await dialog(tablet).getByRole("radio", { name: "Skeleton (JSON)", checked: true }).waitFor();
    expect(await file.isEnabled()).toBe(true);
  });

  it("a picture of the view and the skeleton come under the tree's name", async () => {
    const { tablet, metamers } = await workshop.stem(LANDSCAPE);
    const { page } = tablet;
    await tablet.tap("Save");
    await page.getByRole("textbox", { name: "Name", exact: true }).fill("Old: oak");
    await page.getByRole("button", { name: "Save tree" }).tap();
    await page.getByText("Saved “", { exact: false }).waitFor();

    const json = await fileOf(tablet, "Skeleton (JSON)");
    expect(json.name).toBe("Old oak.json");
    const skeleton = JSON.parse(json.bytes.toString()) as { format: string; metamers: unknown[] };
    expect([skeleton.format, skeleton.metamers.length]).toEqual(["espalier-skeleton", metamers + 1]);

    const { width, height, detail } = LANDSCAPE;
    const [across, down] = [Math.round(width * detail), Math.round(height * detail)];
    const large = await fileOf(tablet, "Picture (PNG)", `${2 * across} × ${2 * down}`);
    expect(large.name).toBe("Old oak.png");
    // The size stands in the first chunk of a PNG.
    expect([large.bytes.readUInt32BE(16), large.bytes.readUInt32BE(20)]).toEqual([2 * across, 2 * down]);
    const shown = await tablet.photograph("view");
    const drawn = await workshop.darkroom.develop(large.bytes, 2 * detail);
    // The picture has finer grass and leaves than the view: they are compared in squares of so many pixels.
    const side = 6;
    const stem = { x: SEED.x / side - 10, y: 70, width: 20, height: 50 };
    const aside = { ...drawn, pixels: drawn.pixels.subarray(4 * 2 * side * (drawn.width + 1)) };
    const share = (other: Picture) => changed(shrunk(shown, side), shrunk(other, side), stem);
    expect(share(drawn), "it is the view").toBeLessThan(0.1);
    expect(share(aside), "a view from a little aside is told from it").toBeGreaterThan(0.2);
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
