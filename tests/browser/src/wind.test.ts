import { expect, test } from "vitest";
import { changed, type Picture } from "./picture";
import { PHONE, type Screen, SMALL } from "./screens";
import type { Tablet } from "./tablet";
import { way } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

const disc = (tablet: Tablet) => tablet.page.getByRole("slider", { name: "Wind by strength and direction" });
const preset = (tablet: Tablet, name: string) =>
  tablet.page.getByRole("group", { name: "How strong the wind is" }).getByRole("button", { name, exact: true });
const said = async (tablet: Tablet) => (await disc(tablet).getAttribute("aria-valuetext")) ?? "";
/** The disc says so strong a wind, and no other number. */
const ofStrength = (speed: number) => new RegExp(`^${speed}(\\.0)?\\s*m/s towards `);

/** A small tree on such a screen, whose picture is drawn all the time, with the panel of the wind open beside it. */
async function withPanel(screen: Screen) {
  const { tablet } = await workshop.stem({ ...screen, watched: true });
  await tablet.tap("Wind");
  await disc(tablet).waitFor();
  return tablet;
}

/** The picture at rest, without the panel. */
async function calmPicture(tablet: Tablet, name: string) {
  await tablet.tap("Close Wind");
  const picture = await tablet.photograph(name);
  await tablet.tap("Wind");
  await disc(tablet).waitFor();
  return picture;
}

/** What is seen above the line of time, which has marks of what was set. */
const aboveTime = ({ pixels }: Picture) => Buffer.from(pixels.slice(0, 0.85 * pixels.length));

/** The same once it stays: how older wood looks is told whole some seconds after somebody drew (FL5). */
async function calmPictureThatStays(tablet: Tablet, name: string) {
  let picture = await calmPicture(tablet, name);
  for (;;) {
    await tablet.page.waitForTimeout(5000);
    const next = await calmPicture(tablet, name);
    if (aboveTime(next).equals(aboveTime(picture))) return next;
    picture = next;
  }
}

test.each<[string, Screen]>([
  ["tablet", SMALL],
  ["phone", PHONE],
])(
  "a finger sets the wind on a %s, the tree sways, and in a calm it is the very picture of before",
  async (name, screen) => {
    const tablet = await withPanel(screen);
    const before = await calmPictureThatStays(tablet, `97-wind-${name}-before`);

    await tablet.press(preset(tablet, "Storm"));
    await expect.poll(() => said(tablet)).toMatch(ofStrength(18));
    const box = await tablet.boxOf(disc(tablet));
    const at = (x: number, y: number) => ({ x: box.x + x * box.width, y: box.y + y * box.height });
    await tablet.swipe([way(at(0.8, 0.5), at(0.2, 0.5), 8)]);
    await expect
      .poll(() => said(tablet), { message: "where the wind blows to follows the finger" })
      .toMatch(/ towards 180°$/);

    await tablet.press(tablet.page.getByRole("button", { name: "Hold", exact: true }));
    const held = await calmPicture(tablet, `97-wind-${name}-held`);
    expect(changed(before, held), "the storm bends the tree").toBeGreaterThan(0.001);
    await tablet.press(tablet.page.getByRole("button", { name: "Let go", exact: true }));

    await tablet.press(preset(tablet, "Calm"));
    const after = await calmPicture(tablet, `97-wind-${name}-after`);
    expect(aboveTime(after).equals(aboveTime(before)), "not a pixel is another one").toBe(true);
  },
);

test("it goes on while somebody looks, and waits while the page is hidden", async () => {
  const tablet = await withPanel(SMALL);
  await tablet.press(preset(tablet, "Breeze"));
  const isStill = () => tablet.page.locator("canvas[data-still]").count();
  await expect.poll(isStill, { message: "something moves" }).toBe(0);
  const hide = (hidden: boolean) =>
    tablet.page.evaluate((hidden) => {
      Object.defineProperty(document, "hidden", { configurable: true, get: () => hidden });
      document.dispatchEvent(new Event("visibilitychange"));
    }, hidden);
  await hide(true);
  await expect.poll(isStill, { message: "nothing is drawn that nobody sees" }).toBe(1);
  await hide(false);
  await expect.poll(isStill, { message: "it goes on" }).toBe(0);
  await tablet.page.keyboard.press("a");
  await expect.poll(isStill, { message: "a key holds it" }).toBe(1);
  await tablet.page.keyboard.press("a");
  await expect.poll(isStill, { message: "and lets it go" }).toBe(0);
});

test("nothing moves by itself where a device is set to show less motion", async () => {
  const { tablet } = await workshop.stem({ ...SMALL, watched: true });
  await tablet.page.emulateMedia({ reducedMotion: "reduce" });
  await tablet.tap("Wind");
  await tablet.press(preset(tablet, "Wind"));
  await tablet.page.getByText("this device is set to show less motion").waitFor();
  await tablet.untilStill();
  await tablet.press(tablet.page.getByRole("button", { name: "Let it move", exact: true }));
  await expect.poll(() => tablet.page.locator("canvas[data-still]").count()).toBe(0);
});

test("all in a session see the wind that one of them sets, whoever comes later too", async () => {
  const screen = { ...SMALL, watched: true };
  const { tablet, address } = await workshop.stem(screen);
  const other = await workshop.open(address, screen);
  const stands = (one: Tablet) => one.page.locator("canvas[data-still]").count();
  await tablet.tap("Wind");
  await tablet.press(preset(tablet, "Wind"));
  await expect.poll(() => stands(other), { message: "what another has set blows here" }).toBe(0);
  const late = await workshop.open(address, screen);
  await expect.poll(() => late.page.locator("canvas").count()).toBe(1);
  await late.tap("Wind");
  await expect.poll(() => said(late), { message: "a late comer is told" }).toMatch(ofStrength(8));
  await expect.poll(() => stands(late)).toBe(0);
  await late.press(preset(late, "Calm"));
  await expect.poll(() => said(tablet)).toMatch(ofStrength(0));
  for (const one of [tablet, other, late]) await one.untilStill();
});

test.each<[string, Screen]>([
  ["tablet", SMALL],
  ["phone", PHONE],
])(
  "what would break under snow is marked and counted on a %s, cut off by a tap, and comes back",
  async (name, screen) => {
    const { tablet, address } = await workshop.fresh({ ...screen, watched: true });
    const commands = [
      { kind: "grow", steps: 8 },
      { kind: "set_appearance", appearance: { wind: { speed: 0, snow: 0 } } },
    ];
    await workshop.act(address, commands);
    const { metamers } = await tablet.until("a tree has grown", ({ metamers }) => metamers > 60);
    await tablet.untilQuiet();
    await tablet.tap("Wind");
    const strength = tablet.page.locator(`.switch-box:has(input[aria-label="Show what would break"])`);
    await tablet.press(strength);
    const status = tablet.page.getByRole("status").filter({ hasText: /break|stands|Looking|nothing lies/ });
    await expect.poll(() => status.innerText()).toContain("nothing lies on the tree");
    await workshop.act(address, [{ kind: "set_appearance", appearance: { wind: { snow: 0.5 } } }]);
    await expect.poll(() => status.innerText()).toMatch(/^(One branch|\d+ branches) would break/);
    await tablet.show(`97-breaks-${name}`);
    await tablet.press(tablet.page.getByRole("button", { name: /^Cut \d+ branch/ }));
    await tablet.until("it is cut off", (facts) => facts.metamers < metamers);
    await tablet.tap("Undo");
    await tablet.until("and stands again", (facts) => facts.metamers === metamers);
    await tablet.press(strength);
  },
);
