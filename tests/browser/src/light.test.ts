import type { Page } from "playwright-core";
import { beforeAll, describe, expect, test } from "vitest";
import { DRAW_MODES, type DrawMode, TRAITS } from "../../../client/src/scene/mode/draw-mode";
import { type Background, DEFAULT_APPEARANCE } from "../../../client/src/wire/generated";
import { perform } from "../gallery/performance";
import { type Box, changed, colours, type Picture, whole } from "./picture";
import type { Screen } from "./screens";
import type { Tablet } from "./tablet";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** Small, because the processor draws it; everything but the picture is hidden. */
const SCREEN: Screen = { width: 720, height: 540, detail: 0.75 };
const { width: WIDTH, height: HEIGHT } = SCREEN;
/** The eye stands high enough for the shadow on the ground to be seen. */
const VIEW = "?yaw=0&pitch=22&zoom=0.95";
/** A little tree with a bare trunk, the same on every machine. */
const TREE = [
  { kind: "set_parameters", parameters: { leaves_per_node: 3, leaf_size: 0.8, trunk_upward: true } },
  { kind: "grow", steps: 13 },
].map((command) => JSON.stringify(command));

let session = "";
let address = "";
let blank: Page | null = null;

beforeAll(async () => {
  address = await workshop.server.newSession(5);
  session = address.slice(address.lastIndexOf("/") + 1);
});

/** Has a page without the client do commands in the session that all tests of this file look at. */
async function act(tablet: Tablet, commands: readonly string[]): Promise<void> {
  blank = await tablet.page.context().newPage();
  await blank.goto(`${workshop.server.address}/health`);
  await perform(blank, session, commands);
  await blank.close();
  await tablet.untilQuiet();
}

const under = (fields: Partial<Background>) =>
  JSON.stringify({
    kind: "set_appearance",
    appearance: { background: { ...DEFAULT_APPEARANCE.background, ...fields } },
  });

/** A tablet that looks at the tree, which is grown first where it is not yet. */
async function looking(): Promise<Tablet> {
  const tablet = await workshop.open(address + VIEW, SCREEN);
  const { metamers } = await tablet.facts();
  await act(tablet, metamers < 20 ? TREE : [under({})]);
  if (metamers >= 20) return tablet;
  // The view that an address asks for is of the tree that was there.
  await tablet.page.reload({ waitUntil: "commit" });
  await tablet.until("all of it is back", ({ metamers, rows }) => metamers >= 20 && rows >= metamers);
  await tablet.untilQuiet();
  return tablet;
}

/** The picture alone, without what lies over it. */
async function picture(tablet: Tablet, name: string): Promise<Picture> {
  const style = await tablet.page.addStyleTag({
    content: ".workspace > :not(canvas) { visibility: hidden !important }",
  });
  const taken = await tablet.photograph(name);
  await style.evaluate((element) => element.parentNode?.removeChild(element));
  return taken;
}

const box = (left: number, top: number, right: number, bottom: number): Box => ({
  x: Math.round(left * WIDTH),
  y: Math.round(top * HEIGHT),
  width: Math.round((right - left) * WIDTH),
  height: Math.round((bottom - top) * HEIGHT),
});

/** The pixels of a box, as red, green and blue. */
function* pixels({ pixels, width }: Picture, { x, y, width: w, height: h }: Box): Iterable<readonly number[]> {
  for (let line = y; line < y + h; line++) {
    for (let at = 4 * (line * width + x); at < 4 * (line * width + x + w); at += 4) {
      yield [pixels[at]!, pixels[at + 1]!, pixels[at + 2]!];
    }
  }
}

function shareOf(picture: Picture, box: Box, holds: (pixel: readonly number[]) => boolean): number {
  let [count, all] = [0, 0];
  for (const pixel of pixels(picture, box)) {
    all += 1;
    if (holds(pixel)) count += 1;
  }
  return count / all;
}

function brightness(picture: Picture, box: Box): number {
  let [sum, all] = [0, 0];
  for (const [r, g, b] of pixels(picture, box)) {
    sum += 0.21 * r! + 0.72 * g! + 0.07 * b!;
    all += 1;
  }
  return sum / all;
}

/** Where the crown is, and the ground to the left and to the right of the trunk's foot. */
const CROWN = box(0.36, 0.12, 0.64, 0.6);
const LEFT = box(0.1, 0.62, 0.42, 0.95);
const RIGHT = box(0.58, 0.62, 0.9, 0.95);
const SKY = box(0.02, 0.02, 0.98, 0.1);

/** What can be said of any picture that is not broken. */
function isPicture(picture: Picture): void {
  expect(picture.width * picture.height).toBe(WIDTH * HEIGHT);
  expect(colours(picture), "many colours").toBeGreaterThan(25);
  const light = brightness(picture, whole(picture));
  expect(light, "not black").toBeGreaterThan(20);
  expect(light, "not white").toBeLessThan(250);
}

describe("a lit tree", () => {
  test("has green leaves and grey-brown bark before a pale sky", async () => {
    const tablet = await looking();
    const lit = await picture(tablet, "90-lit");
    isPicture(lit);
    const green = ([r, g, b]: readonly number[]) => g! > r! + 8 && g! > b! + 20;
    const wood = ([r, g, b]: readonly number[]) => r! >= g! - 4 && g! > b! && r! < 175;
    expect(shareOf(lit, CROWN, green), "leaves").toBeGreaterThan(0.1);
    expect(shareOf(lit, CROWN, wood), "bark").toBeGreaterThan(0.01);
    expect(brightness(lit, SKY), "the sky is lighter than the crown").toBeGreaterThan(brightness(lit, CROWN) + 15);
  });

  test("casts its shadow away from the sun, wherever that is", async () => {
    const tablet = await looking();
    const shadows: number[] = [];
    for (const sun_azimuth of [270, 90]) {
      await act(tablet, [under({ sun_azimuth, sun_elevation: 40 })]);
      const lit = await picture(tablet, `91-sun-${sun_azimuth}`);
      isPicture(lit);
      shadows.push(brightness(lit, LEFT) - brightness(lit, RIGHT));
    }
    expect(shadows[0], "the sun on the left darkens the right").toBeGreaterThan(3);
    expect(shadows[1], "and the other way round").toBeLessThan(-3);
  });

  test("casts none under clouds worth the name", async () => {
    const tablet = await looking();
    await act(tablet, [under({ sky: "overcast", sun_azimuth: 270, sun_elevation: 40 })]);
    const dull = await picture(tablet, "92-overcast");
    isPicture(dull);
    expect(Math.abs(brightness(dull, LEFT) - brightness(dull, RIGHT))).toBeLessThan(4);
  });
});

test("every sky, ground and hour is another picture", async () => {
  const tablet = await looking();
  const backgrounds: [string, Partial<Background>][] = [
    ["noon", {}],
    ["golden", { sun_elevation: 6 }],
    ["dusk", { sun_elevation: -4 }],
    ["night", { sun_elevation: -10 }],
    ["clear-sand", { sky: "clear", ground: "sand" }],
    ["overcast-snow", { sky: "overcast", ground: "snow" }],
    ["earth", { sky: "clear", ground: "earth" }],
    ["studio", { sky: "studio", ground: "plain", backdrop: [226, 222, 214] }],
    ["dark-studio", { sky: "studio", ground: "plain", backdrop: [60, 64, 70] }],
  ];
  const seen: [string, Picture][] = [];
  for (const [name, fields] of backgrounds) {
    await act(tablet, [under(fields)]);
    const now = await picture(tablet, `93-${name}`);
    isPicture(now);
    for (const [other, before] of seen) expect(changed(before, now), `${name} and ${other}`).toBeGreaterThan(0.25);
    seen.push([name, now]);
  }
  const brightnessOf = (name: string) => brightness(seen.find(([other]) => other === name)![1], SKY);
  expect(brightnessOf("noon")).toBeGreaterThan(brightnessOf("dusk"));
  expect(brightnessOf("dusk")).toBeGreaterThan(brightnessOf("night"));
  expect(Math.abs(brightnessOf("studio") - 222), "a studio is of the colour it is given").toBeLessThan(12);
  expect(Math.abs(brightnessOf("dark-studio") - 64)).toBeLessThan(12);
});

test("what the graphics card drops is spoken of, and comes back as it was", async () => {
  const tablet = await looking();
  const before = await picture(tablet, "95-before-loss");
  isPicture(before);
  const context = await tablet.page.evaluateHandle(
    () =>
      document
        .querySelector<HTMLCanvasElement>("#workspace")!
        .getContext("webgl2")!
        .getExtension("WEBGL_lose_context")!,
  );
  await context.evaluate((extension) => extension.loseContext());
  const notice = tablet.page.getByText("The picture is gone");
  await notice.waitFor();
  expect(await tablet.page.locator("#workspace[data-still]").count(), "nothing is said to be at rest").toBe(0);
  await context.evaluate((extension) => extension.restoreContext());
  await notice.waitFor({ state: "hidden" });
  const after = await picture(tablet, "96-after-loss");
  expect(changed(before, after)).toBeLessThan(0.002);
});

/** What each item of the menu is called. */
const CALLED: Record<DrawMode, string> = {
  lit: "In the light",
  skeleton: "Skeleton",
  wireframe: "Wireframe",
  exposure: "Light",
  vigor: "Vigor",
  age: "Age",
  order: "Order",
};

/** What is behind a tree that is shown in false colours. */
const PAPER = [232, 232, 230];
const apart = (a: readonly number[], b: readonly number[]) => Math.hypot(...a.map((value, i) => value - b[i]!));

test("every draw mode is another picture, in its legend's colours", async () => {
  const tablet = await looking();
  const seen: [DrawMode, Picture][] = [];
  for (const mode of DRAW_MODES) {
    await tablet.tap("Way of drawing");
    await tablet.page.getByRole("button", { name: CALLED[mode], exact: true }).tap();
    const now = await picture(tablet, `94-${mode}`);
    isPictureOfTree(now);
    for (const [other, before] of seen) {
      expect(changed(before, now, CROWN), `${mode} and ${other}`).toBeGreaterThan(0.03);
    }
    seen.push([mode, now]);
    const ramp = TRAITS[mode]?.ramp;
    if (!ramp) continue;
    // Pale ones are those that the tree shares with the paper behind it; darker ones at its edges may be, too.
    const coloured = [...pixels(now, CROWN)].filter((pixel) => apart(pixel, PAPER) > 150);
    expect(coloured.length, `${mode} colours the tree`).toBeGreaterThan(200);
    const known = coloured.filter((pixel) => distanceTo(ramp, pixel) < 40);
    expect(known.length / coloured.length, `${mode} shows the legend's colours`).toBeGreaterThan(0.55);
  }
});

function isPictureOfTree(picture: Picture): void {
  const light = brightness(picture, whole(picture));
  expect(light, "not black").toBeGreaterThan(20);
  expect(light, "not white").toBeLessThan(250);
  expect(colours(picture)).toBeGreaterThan(8);
}

/** How far a colour is from the nearest on a ramp that may be shaded. */
function distanceTo(ramp: readonly (readonly number[])[], pixel: readonly number[]): number {
  let least = Number.POSITIVE_INFINITY;
  for (let at = 0; at < ramp.length - 1; at += 0.125) {
    const [a, b] = [ramp[Math.floor(at)]!, ramp[Math.floor(at) + 1]!];
    for (let shade = 0.72; shade <= 1.001; shade += 0.07) {
      const apart = pixel.map((value, i) => value - 255 * shade * (a[i]! + (b[i]! - a[i]!) * (at % 1)));
      least = Math.min(least, Math.hypot(...apart));
    }
  }
  return least;
}
