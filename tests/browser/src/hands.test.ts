import { expect, test } from "vitest";
import type { Screen } from "./screens";
import type { Tablet } from "./tablet";
import type { Point } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** Nothing is looked at here but what a hand has hold of. */
const SMALL: Screen = { width: 900, height: 800, detail: 0.2 };

/** The middle of the lever that grows. */
async function leverOf(tablet: Tablet): Promise<Point> {
  const { x, y, width, height } = await tablet.boxOf(tablet.page.getByRole("slider", { name: "Grow", exact: true }));
  return { x: x + width / 2, y: y + height / 2 };
}

test("nothing grows under a mouse's other buttons", async () => {
  const { tablet } = await workshop.fresh(SMALL);
  const { mouse } = tablet.page;
  const { x, y } = await leverOf(tablet);
  await mouse.move(x, y - 40);
  await mouse.down({ button: "right" });
  // By then the first button's growth has long been asked for.
  await tablet.page.waitForTimeout(1500);
  expect((await tablet.facts()).sent).toBe(0);
  await mouse.up({ button: "right" });
  await mouse.down();
  await tablet.until("it grows", ({ metamers }) => metamers > 0);
  await mouse.up();
});

test("a card that closes when its work is done leaves another one open", async () => {
  const { tablet } = await workshop.fresh(SMALL);
  const { page } = tablet;
  let answer = () => {};
  await page.route("**/api/v1/trees", async (route) => {
    if (route.request().method() === "POST") await new Promise<void>((resolve) => (answer = resolve));
    await route.continue();
  });
  await tablet.tap("Save");
  const saving = page.waitForRequest((request) => request.method() === "POST");
  await page.getByRole("button", { name: "Save tree" }).tap();
  await saving;
  await page.keyboard.press("Escape");
  await page.getByRole("dialog").waitFor({ state: "detached" });
  await tablet.tap("Settings");
  await page.getByRole("dialog", { name: "Settings" }).waitFor();
  answer();
  await page.getByText("Saved “", { exact: false }).waitFor();
  expect(await page.getByRole("dialog", { name: "Settings" }).isVisible()).toBe(true);
});
