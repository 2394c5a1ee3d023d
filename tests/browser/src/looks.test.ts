import { expect, test } from "vitest";
import { type Box, changed, colours, type Picture } from "./picture";
import { COARSE, type Screen } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import { pullDown } from "./visits";
import { type Point, way } from "./ways";
import { type Grown, Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

const SCREEN = COARSE;
/** A second tablet, a small one: whatever it shows costs the same processor. */
const SMALL: Screen = { width: 900, height: 640, detail: 0.3 };

/** The picture between the bars, with a panel beside it. */
const TREE: Box = { x: 160, y: 130, width: 660, height: 600 };

/** A tablet with a tree on it, and a panel pulled down. */
async function withPanel(panel: string): Promise<Grown> {
  const grown = await workshop.drawn(SCREEN);
  await pullDown(grown.tablet, panel);
  return grown;
}

/** How visibly the tree's surroundings and the tree itself differ between two pictures. */
const differs = (before: Picture, after: Picture) => changed(before, after, TREE);

/** Two pictures of the same thing: what the processor draws differs in hardly a pixel. */
const SAME = 0.01;

/** The value a slider shows. */
async function valueAt(tablet: Tablet, label: string): Promise<number> {
  return Number(await slider(tablet, label).inputValue());
}

function slider(tablet: Tablet, label: string) {
  return tablet.page.locator(`input[type="range"][aria-label="${label}"]`);
}

/** Pulls the thumb of a slider with a finger to a part of its way, from 0 to 1. */
async function pull(tablet: Tablet, label: string, part: number): Promise<void> {
  const input = slider(tablet, label);
  await input.scrollIntoViewIfNeeded();
  const frame = await tablet.boxOf(input);
  const [least, most, now] = await input.evaluate((element: HTMLInputElement) => [
    Number(element.min),
    Number(element.max),
    element.valueAsNumber,
  ]);
  // The thumb is 44 pixels wide and stays within the track, which is 10 pixels short of either end.
  const at = (place: number): Point => ({
    x: frame.x + 32 + place * (frame.width - 64),
    y: frame.y + frame.height / 2,
  });
  await tablet.swipe([way(at((now! - least!) / (most! - least!)), at(part), 16)]);
}

async function pick(tablet: Tablet, name: string): Promise<void> {
  await tablet.page.getByRole("radio", { name, exact: true }).tap();
  await tablet.page.getByRole("radio", { name, exact: true, checked: true }).waitFor();
}

async function unfold(tablet: Tablet, title: string): Promise<void> {
  await tablet.page.locator("summary", { hasText: title }).tap();
  await tablet.page.locator("details[open] > summary", { hasText: title }).waitFor();
}

test("a leaf’s shape is picked, seen by all and taken back", async () => {
  const { tablet, address } = await withPanel("Leaves");
  const other = await workshop.open(address, SMALL);
  await pullDown(other, "Leaves");
  const before = await tablet.photograph("looks-leaves");
  const seenBefore = await other.photograph("looks-leaves-other");
  await pick(tablet, "Palmate");
  await tablet.untilQuiet();
  const palmate = await tablet.photograph("looks-palmate");
  expect(differs(before, palmate), "the leaves change").toBeGreaterThan(0.02);
  await until("the other tablet’s panel follows", () => other.page.getByRole("radio", { name: "Palmate" }).isChecked());
  expect(changed(seenBefore, await other.photograph("looks-palmate-other")), "so do theirs").toBeGreaterThan(0.02);
  await tablet.tap("Undo");
  await until("it is taken back", () => other.page.getByRole("radio", { name: "Ovate" }).isChecked());
  await expect.poll(() => tablet.page.getByRole("radio", { name: "Ovate" }).isChecked()).toBe(true);
  await tablet.untilQuiet();
  expect(differs(before, await tablet.photograph("looks-ovate-again")), "as it was").toBeLessThan(SAME);
});

test("AP2: a slider that is dragged is one undo", async () => {
  const { tablet, address } = await withPanel("Leaves");
  const other = await workshop.open(address, SMALL);
  await pullDown(other, "Leaves");
  const before = await tablet.photograph("looks-summer");
  const { sent } = await tablet.facts();
  await pull(tablet, "Season", 0.7);
  const season = await valueAt(tablet, "Season");
  expect(season, "the thumb follows the finger").toBeGreaterThan(1.9);
  await tablet.until("a drag is sent as it goes", (facts) => facts.sent > sent + 1);
  await tablet.untilQuiet();
  expect(await valueAt(tablet, "Season"), "it stays where it was let go").toBe(season);
  expect(differs(before, await tablet.photograph("looks-autumn")), "autumn comes").toBeGreaterThan(0.02);
  await until("the other tablet sees it", async () => Math.abs((await valueAt(other, "Season")) - season) < 0.02);
  await tablet.tap("Undo");
  await until("one undo takes all of it back", async () => (await valueAt(tablet, "Season")) === 1);
  await until("for everybody", async () => (await valueAt(other, "Season")) === 1);
  await tablet.untilQuiet();
  expect(differs(before, await tablet.photograph("looks-summer-again")), "as it was").toBeLessThan(SAME);

  await slider(tablet, "Season").focus();
  for (let i = 0; i < 5; i++) await tablet.page.keyboard.down("ArrowRight");
  await tablet.page.keyboard.up("ArrowRight");
  await tablet.untilQuiet();
  const keyed = { message: "by the keyboard as well" };
  await expect.poll(() => valueAt(tablet, "Season"), keyed).toBeCloseTo(1.1);
  await tablet.tap("Undo");
  await until("a key that is held is one undo", async () => (await valueAt(tablet, "Season")) === 1);
});

test("leaves: colour, number, flowers, all reset", async () => {
  const { tablet } = await withPanel("Leaves");
  const { page } = tablet;
  const before = await tablet.photograph("looks-plain");
  await tablet.tap("Copper");
  await tablet.untilQuiet();
  const copper = await tablet.photograph("looks-copper");
  expect(differs(before, copper), "leaves change their colour").toBeGreaterThan(0.02);

  const any = page.getByLabel("Summer colour: any colour");
  await any.fill("#3355aa");
  await until("any other colour is possible", () => page.locator('.any-colour[data-chosen="true"]').isVisible());
  await tablet.untilQuiet();
  await expect.poll(() => any.inputValue(), { message: "the server’s colour is the very one" }).toBe("#3355aa");
  await tablet.tap("Copper");

  await unfold(tablet, "Flowers");
  await pick(tablet, "Rosette");
  await tablet.untilQuiet();
  const flowering = await tablet.photograph("looks-flowers");
  expect(differs(copper, flowering), "flowers come").toBeGreaterThan(0.003);

  await page.getByLabel("Leaves at a node: value").fill("0");
  await page.keyboard.press("Enter");
  await tablet.untilQuiet();
  await expect.poll(() => valueAt(tablet, "Leaves at a node")).toBe(0);
  expect(differs(flowering, await tablet.photograph("looks-bare")), "leaves go").toBeGreaterThan(0.02);

  await page.getByRole("button", { name: "Reset all" }).tap();
  await tablet.untilQuiet();
  await expect.poll(() => valueAt(tablet, "Leaves at a node")).toBe(4);
  expect(differs(before, await tablet.photograph("looks-reset")), "all as at first").toBeLessThan(SAME);
  await tablet.tap("Undo");
  await until("resetting all is one undo", async () => (await valueAt(tablet, "Leaves at a node")) === 0);
  await expect.poll(() => page.getByRole("radio", { name: "Rosette" }).isChecked()).toBe(true);
});

test("branches: bark, its colour, the trunk’s foot", async () => {
  const { tablet } = await withPanel("Branches");
  const thin = await tablet.photograph("looks-thin");
  await pull(tablet, "Twigs", 1);
  await tablet.untilQuiet();
  await expect.poll(() => valueAt(tablet, "Twigs"), { message: "a parameter of growth" }).toBeCloseTo(0.3);
  const thick = await tablet.photograph("looks-furrowed");
  expect(differs(thin, thick), "all wood is thicker").toBeGreaterThan(0.005);
  await pick(tablet, "Papery");
  await tablet.tap("Chalk");
  await tablet.untilQuiet();
  const papery = await tablet.photograph("looks-papery");
  expect(differs(thick, papery), "the bark changes").toBeGreaterThan(0.005);
  await tablet.tap("Reset Twigs");
  await tablet.untilQuiet();
  await expect.poll(() => valueAt(tablet, "Twigs")).toBeCloseTo(0.07);
  for (const name of ["Kind of bark", "Colour of bark"]) await tablet.tap(`Reset ${name}`);
  await tablet.untilQuiet();
  expect(differs(thin, await tablet.photograph("looks-thin-again")), "as at first").toBeLessThan(SAME);
});

test("background: ground, sky, sun by dial and by time", async () => {
  const { tablet, address } = await withPanel("Background");
  const other = await workshop.open(address, SMALL);
  await pullDown(other, "Background");
  const before = await tablet.photograph("looks-meadow");

  const dial = tablet.page.getByRole("slider", { name: "Direction", exact: true });
  const frame = await tablet.boxOf(dial);
  const middle = { x: frame.x + frame.width / 2, y: frame.y + frame.height / 2 };
  const around = Array.from({ length: 16 }, (_, i) => ({
    x: middle.x + Math.sin(-0.9 + i * 0.15) * frame.width * 0.36,
    y: middle.y + Math.cos(-0.9 + i * 0.15) * frame.height * 0.36,
  }));
  await tablet.swipe([around]);
  await tablet.untilQuiet();
  const azimuth = Number(await dial.getAttribute("aria-valuenow"));
  expect(azimuth, "the sun stands where the finger let go").toBeGreaterThan(60);
  expect(azimuth).toBeLessThan(100);
  const right = await tablet.photograph("looks-sun-right");
  expect(differs(before, right), "shadows fall the other way").toBeGreaterThan(0.01);
  const theirs = other.page.getByRole("slider", { name: "Direction", exact: true });
  await until(
    "the other tablet’s dial follows",
    async () => Number(await theirs.getAttribute("aria-valuenow")) === azimuth,
  );

  await tablet.tap("Undo");
  await until("one undo takes the turn back", async () => (await dial.getAttribute("aria-valuenow")) === "310");
  await pull(tablet, "Time of day", 0.95);
  await tablet.untilQuiet();
  const height = tablet.page.getByRole("slider", { name: "Height", exact: true });
  expect(Number(await height.getAttribute("aria-valuenow")), "in the evening the sun is low").toBeLessThan(8);
  expect(differs(before, await tablet.photograph("looks-evening")), "it gets dark").toBeGreaterThan(0.1);
  await tablet.tap("Undo");

  await pick(tablet, "Snow");
  await pick(tablet, "Studio");
  await tablet.tap("Night");
  await tablet.untilQuiet();
  expect(differs(before, await tablet.photograph("looks-studio")), "all around is another").toBeGreaterThan(0.5);
  await tablet.page.getByRole("button", { name: "Reset all" }).tap();
  await tablet.untilQuiet();
  expect(differs(before, await tablet.photograph("looks-meadow-again"))).toBeLessThan(SAME);
});

test("AP1: two who pull at one section both get what they set", async () => {
  const { tablet, address } = await workshop.fresh(SMALL);
  const other = await workshop.open(address, SMALL);
  for (const one of [tablet, other]) await pullDown(one, "Leaves");
  await Promise.all([pull(tablet, "Season", 0.8), pull(other, "Hue by vigor", 0.9)]);
  await Promise.all([tablet.untilQuiet(), other.untilQuiet()]);
  const [season, hue] = [await valueAt(tablet, "Season"), await valueAt(other, "Hue by vigor")];
  expect(season).toBeGreaterThan(2);
  expect(hue).toBeGreaterThan(0.8);
  await until("one has the other’s", async () => (await valueAt(tablet, "Hue by vigor")) === hue);
  await until("and the other theirs", async () => (await valueAt(other, "Season")) === season);
  expect(await valueAt(tablet, "Season")).toBe(season);
});

test("in false colours panels of looks say so and lead back", async () => {
  const { tablet } = await workshop.fresh(SMALL);
  const { page } = tablet;
  await page.keyboard.press("d");
  for (const panel of ["Leaves", "Branches", "Background"]) {
    await tablet.tap(panel);
    await page.locator(".drawer").getByText("The tree is drawn as “Skeleton”", { exact: false }).waitFor();
  }
  await page.locator(".drawer").getByRole("button", { name: "Back to the lit tree" }).tap();
  await page.locator(".unlit-note").waitFor({ state: "detached" });
  await page.getByRole("region", { name: "Skeleton", exact: true }).waitFor({ state: "detached" });
});

test("draw modes with their legends, on one tablet alone", async () => {
  const { tablet, address } = await workshop.drawn(SCREEN);
  const other = await workshop.open(address, SMALL);
  const seen = await other.photograph("looks-other");
  const lit = await tablet.photograph("looks-lit");
  const { sent } = await tablet.facts();
  const pictures = [lit];
  for (const [mode, ends] of [
    ["Skeleton", null],
    ["Wireframe", null],
    ["Light", ["deep shade", "full light"]],
    ["Vigor", ["weak", "vigorous"]],
    ["Age", ["new", /^\d+ steps?$/]],
    ["Order", ["0: trunk", /^\d+$/]],
  ] as const) {
    await tablet.tap("Way of drawing");
    await tablet.page.getByRole("button", { name: mode, exact: true }).tap();
    const legend = tablet.page.getByRole("region", { name: mode, exact: true });
    await legend.waitFor();
    for (const end of ends ?? []) await legend.getByText(end, { exact: true }).waitFor();
    expect(await legend.locator("i").count(), "a ramp of colours").toBe(ends === null ? 0 : 1);
    const picture = await tablet.photograph(`looks-${mode.toLowerCase()}`);
    expect(colours(picture), `${mode}: not an empty picture`).toBeGreaterThan(12);
    for (const before of pictures) expect(changed(before, picture), mode).toBeGreaterThan(0.005);
    pictures.push(picture);
  }
  expect((await tablet.facts()).sent, "nothing of it is sent").toBe(sent);
  expect(changed(seen, await other.photograph("looks-other")), "nothing of it is seen elsewhere").toBeLessThan(SAME);
  await tablet.tap("Back to the lit tree");
  expect(changed(lit, await tablet.photograph("looks-lit"))).toBeLessThan(SAME);
  await tablet.page.keyboard.press("d");
  await tablet.page.getByRole("region", { name: "Skeleton", exact: true }).waitFor();
  await tablet.page.keyboard.press("Shift+D");
  await tablet.page.getByRole("region", { name: "Skeleton", exact: true }).waitFor({ state: "detached" });
});

test("long German names fit, upright and on a phone", async () => {
  for (const screen of [SCREEN, { width: 834, height: 1194, detail: 0.3 }, { width: 390, height: 844, detail: 0.4 }]) {
    const { tablet } = await workshop.fresh(screen);
    await tablet.page.evaluate(() => localStorage.setItem("espalier.language", '"de"'));
    await tablet.page.reload();
    await tablet.untilReady();
    for (const [panel, folded] of [
      ["Laub", ["Blüten", "Früchte"]],
      ["Äste", []],
      ["Hintergrund", []],
    ] as const) {
      await pullDown(tablet, panel);
      for (const section of folded) await unfold(tablet, section);
      if (panel === "Laub") {
        await pick(tablet, "Rispe");
        await pick(tablet, "Geflügelt");
      }
      for (const help of await tablet.page.locator(".drawer .field-name[aria-expanded]").all()) await help.tap();
      await tablet.untilSettled();
      expect(await overflowing(tablet), `${panel} at ${screen.width}`).toEqual([]);
      expect(await tooSmall(tablet), `${panel} at ${screen.width}`).toEqual([]);
      await tablet.show(`looks-${panel}-${screen.width}`);
      await tablet.tap(panel);
      await tablet.page.locator(".drawer").waitFor({ state: "detached" });
    }
  }
});

/** The texts in the panel that stand out of what should hold them. */
function overflowing(tablet: Tablet): Promise<string[]> {
  return tablet.page.evaluate(() => {
    const panel = document.querySelector<HTMLElement>(".drawer")!.getBoundingClientRect();
    const found: string[] = [];
    for (const element of document.querySelectorAll<HTMLElement>(".drawer-body *")) {
      const { left, right, width } = element.getBoundingClientRect();
      const cut =
        element.children.length === 0 && element.scrollWidth > element.clientWidth + 1 && element.clientWidth > 0;
      if (width > 0 && (cut || left < panel.left - 1 || right > panel.right + 1)) {
        found.push(`${element.localName}.${element.className}: ${element.textContent}`);
      }
    }
    return found;
  });
}

/** What can be touched in the panel and is smaller than a finger. */
function tooSmall(tablet: Tablet): Promise<string[]> {
  return tablet.page.evaluate(() => {
    const targets = document.querySelectorAll<HTMLElement>(
      '.drawer-body button, .drawer-body input[type="range"], .drawer-body input[type="radio"], .drawer-body label, .drawer-body [role="slider"]',
    );
    return [...targets]
      .filter((element) => {
        // A typed number takes touches from a little around it.
        const reach = element.classList.contains("typed") ? 10 : 0;
        const { width, height } = element.getBoundingClientRect();
        return width > 0 && (width < 43.5 || height + reach < 43.5);
      })
      .map((element) => `${element.localName}.${element.className}: ${element.textContent}`);
  });
}
