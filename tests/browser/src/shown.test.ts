import { beforeAll, expect, test } from "vitest";
import { SHOWN_NAMES, SHOWN_ROWS, type ShownName } from "../../../client/src/scene/mode/shown";
import { type Box, changed, type Picture } from "./picture";
import type { Screen } from "./screens";
import type { Tablet } from "./tablet";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** Small, because the processor draws it; wide enough for the menu. */
const SCREEN: Screen = { width: 720, height: 600, detail: 0.75 };
const { width: WIDTH, height: HEIGHT } = SCREEN;
const VIEW = "?yaw=0&pitch=9&zoom=0.9";
const TREE = [
  { kind: "set_parameters", parameters: { leaves_per_node: 3, leaf_size: 0.8, trunk_upward: true } },
  {
    kind: "set_appearance",
    appearance: { background: { sky: "clear", ground: "earth", sun_azimuth: 270, sun_elevation: 35 } },
  },
  { kind: "grow", steps: 13 },
];

const box = (left: number, top: number, right: number, bottom: number): Box => ({
  x: Math.round(left * WIDTH),
  y: Math.round(top * HEIGHT),
  width: Math.round((right - left) * WIDTH),
  height: Math.round((bottom - top) * HEIGHT),
});
const CROWN = box(0.36, 0.12, 0.64, 0.6);
/** The tree's shadow falls there. */
const SHADED = box(0.58, 0.66, 0.78, 0.86);
const SKY = box(0.02, 0.02, 0.98, 0.1);
const GROUND = box(0.05, 0.75, 0.3, 0.95);

/** Where each switch is seen, how much of it at least, and where nothing may be seen of it. */
const SEEN: Record<ShownName, { readonly where: Box; readonly much: number; readonly untouched?: Box }> = {
  light: { where: CROWN, much: 0.3, untouched: SKY },
  smooth: { where: CROWN, much: 0.1, untouched: SKY },
  texture: { where: CROWN, much: 0.05, untouched: SKY },
  shadow: { where: SHADED, much: 0.4, untouched: SKY },
  background: { where: SKY, much: 0.9 },
  wireframe: { where: CROWN, much: 0.3, untouched: SKY },
  skeleton: { where: CROWN, much: 0.02, untouched: SKY },
};

const LABELS: Record<ShownName, string> = {
  light: "Lighting",
  smooth: "Smooth",
  texture: "Texture",
  shadow: "Shadows",
  background: "Sky and ground",
  wireframe: "Edges only",
  skeleton: "Axes over it",
};

let address = "";

beforeAll(async () => {
  address = await workshop.server.newSession(5);
  await workshop.act(address, TREE);
});

/** The picture alone, without what lies over it. */
async function picture(tablet: Tablet, name: string): Promise<Picture> {
  const style = await tablet.page.addStyleTag({
    content: ".workspace > :not(canvas) { visibility: hidden !important }",
  });
  const taken = await tablet.photograph(name);
  await style.evaluate((element) => element.parentNode?.removeChild(element));
  return taken;
}

/** How many colours a box has. */
function variety({ pixels, width }: Picture, { x, y, width: wide, height }: Box): number {
  const seen = new Set<number>();
  for (let line = y; line < y + height; line++) {
    for (let at = 4 * (line * width + x); at < 4 * (line * width + x + wide); at += 4) {
      seen.add((pixels[at]! << 16) | (pixels[at + 1]! << 8) | pixels[at + 2]!);
    }
  }
  return seen.size;
}

/** The share of a box's pixels that are another colour, however little: nothing else changes here. */
function altered(before: Picture, after: Picture, { x, y, width: wide, height }: Box): number {
  let count = 0;
  for (let line = y; line < y + height; line++) {
    for (let at = 4 * (line * after.width + x); at < 4 * (line * after.width + x + wide); at += 4) {
      const apart = [0, 1, 2].map((i) => Math.abs(before.pixels[at + i]! - after.pixels[at + i]!));
      if (Math.max(...apart) > 3) count += 1;
    }
  }
  return count / (wide * height);
}

/** Which switches are on, as the menu says. */
async function on(tablet: Tablet): Promise<Record<string, boolean>> {
  const found: Record<string, boolean> = {};
  for (const name of SHOWN_NAMES) {
    found[name] = await tablet.page.getByRole("checkbox", { name: LABELS[name], exact: true }).isChecked();
  }
  return found;
}

const usual = Object.fromEntries(SHOWN_NAMES.map((name) => [name, SHOWN_ROWS[name].usual]));

test("every part of the picture is switched by itself, by a finger", async () => {
  const tablet = await workshop.open(address + VIEW, SCREEN);
  await tablet.untilQuiet();
  const before = await picture(tablet, "97-usual");
  await tablet.tap("Way of drawing");
  const back = tablet.page.getByRole("button", { name: "As usual", exact: true });
  await back.waitFor();
  expect(await on(tablet)).toEqual(usual);
  expect(await back.isEnabled()).toBe(false);
  for (const name of SHOWN_NAMES) {
    await tablet.press(tablet.page.getByRole("checkbox", { name: LABELS[name], exact: true }));
    await expect.poll(() => on(tablet)).toEqual({ ...usual, [name]: !usual[name] });
    const now = await picture(tablet, `97-${name}`);
    const { where, much, untouched } = SEEN[name];
    expect(altered(before, now, where), name).toBeGreaterThan(much);
    if (untouched) expect(altered(before, now, untouched), `${name} leaves the rest`).toBeLessThan(0.01);
    if (name === "texture") expect(variety(now, GROUND)).toBeLessThan(variety(before, GROUND) / 4);
    await tablet.press(back);
    await expect.poll(() => on(tablet)).toEqual(usual);
  }
  expect(changed(before, await picture(tablet, "97-usual-again")), "as it was").toBeLessThan(0.002);
});

test("by keys as well, which say so; and kept by the browser", async () => {
  const tablet = await workshop.open(address + VIEW, { ...SCREEN, mouse: true });
  const { page } = tablet;
  const kept = () => page.evaluate(() => JSON.parse(localStorage.getItem("espalier.shown") ?? "null"));
  for (const [at, name] of SHOWN_NAMES.entries()) {
    await page.keyboard.press(String(at + 1));
    await page.getByText(`${LABELS[name]}: ${usual[name] ? "off" : "on"}`).waitFor();
  }
  const turned = Object.fromEntries(SHOWN_NAMES.map((name) => [name, !usual[name]]));
  expect(await kept()).toEqual(turned);
  await page.reload({ waitUntil: "commit" });
  await tablet.untilReady();
  await page.getByRole("button", { name: "Way of drawing", pressed: true }).click();
  await page.getByRole("button", { name: "As usual", exact: true }).waitFor();
  expect(await on(tablet)).toEqual(turned);
  await page.keyboard.press("Escape");
  await page.keyboard.press("0");
  await page.getByText("Drawn as usual again").waitFor();
  expect(await kept()).toEqual(usual);
  await page.getByRole("button", { name: "Way of drawing", pressed: false }).waitFor();
});
