import { expect, test } from "vitest";
import { changed } from "./picture";
import { COARSE } from "./screens";
import type { Tablet } from "./tablet";
import { type Point, way } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

const sun = (tablet: Tablet) => tablet.page.getByRole("slider", { name: "Sun", exact: true });

/** Where the sun is on the glass. */
async function placeOf(tablet: Tablet): Promise<Point> {
  const box = await tablet.boxOf(sun(tablet));
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

const said = async (tablet: Tablet) => (await sun(tablet).getAttribute("aria-valuetext")) ?? "";

async function withSun() {
  const drawn = await workshop.drawn(COARSE);
  await drawn.tablet.tap("Background");
  await sun(drawn.tablet).waitFor();
  return drawn;
}

test("a finger drags the sun around the tree, one operation", async () => {
  const { tablet } = await withSun();
  const before = await tablet.photograph("95-sun");
  const [saidBefore, from] = [await said(tablet), await placeOf(tablet)];
  const to = { x: from.x + 190, y: from.y + 60 };
  await tablet.swipe([way(from, to, 20)]);
  const { operations } = await tablet.untilQuiet();
  const reached = await placeOf(tablet);
  expect(Math.hypot(reached.x - to.x, reached.y - to.y), "it is under the finger").toBeLessThan(20);
  expect(operations).toBe("stroke appearance");
  await expect.poll(() => said(tablet)).not.toBe(saidBefore);
  expect(changed(before, await tablet.photograph("95-sun-dragged"))).toBeGreaterThan(0.05);

  await tablet.tap("Undo");
  await tablet.untilQuiet();
  await expect.poll(() => said(tablet)).toBe(saidBefore);
});

test("the sun turns with the tree, or stays where it is pinned", async () => {
  const { tablet } = await withSun();
  const turn = async (degrees: string) => {
    const strip = tablet.page.getByRole("slider", { name: "Turn the tree" });
    await strip.focus();
    for (let i = 0; i < 4; i++) await tablet.page.keyboard.press("ArrowRight");
    await expect.poll(() => strip.getAttribute("aria-valuenow")).toBe(degrees);
    await tablet.untilStill();
  };
  const [saidFirst, first] = [await said(tablet), await placeOf(tablet)];
  await turn("20");
  const turned = await placeOf(tablet);
  expect(await said(tablet), "it stands where it stood").toBe(saidFirst);
  expect(Math.abs(turned.x - first.x), "but elsewhere on the glass").toBeGreaterThan(10);

  await tablet.tap("Keep the sun in place while the tree turns");
  await tablet.page
    .getByRole("button", { name: "Keep the sun in place while the tree turns", pressed: true })
    .waitFor();
  await turn("40");
  await tablet.until("its new place is sent", ({ operations }) => operations.endsWith("appearance"));
  await tablet.untilQuiet();
  const pinned = await placeOf(tablet);
  expect(Math.hypot(pinned.x - turned.x, pinned.y - turned.y), "it keeps its place on the glass").toBeLessThan(6);
  await expect.poll(() => said(tablet)).not.toBe(saidFirst);
});

test("arrow keys move the sun, with its name and place told", async () => {
  const { tablet } = await withSun();
  await expect.poll(() => said(tablet)).toBe("310° around, 48° high");
  await sun(tablet).focus();
  await tablet.page.keyboard.press("ArrowUp");
  await tablet.page.keyboard.press("Shift+ArrowLeft");
  await tablet.untilQuiet();
  await expect.poll(() => said(tablet)).toBe("295° around, 51° high");
});
