import { expect, test } from "vitest";
import { withClient } from "./client-build";
import { theBrowser } from "./shared";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** A tablet on its side, and a phone. */
const SCREENS = [
  { width: 1194, height: 834 },
  { width: 390, height: 844 },
];

test.each(SCREENS)("every address can be read and tried by touch: $width × $height", async (viewport) => {
  const browser = await theBrowser();
  const context = await browser.newContext({ viewport, hasTouch: true, isMobile: true });
  await withClient(context);
  const page = await context.newPage();
  const faults: string[] = [];
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("console", (message) => void (message.type() === "error" && faults.push(message.text())));
  const elsewhere: string[] = [];
  page.on("request", (request) => {
    const { origin, protocol } = new URL(request.url());
    if (protocol !== "data:" && origin !== workshop.server.address) elsewhere.push(request.url());
  });
  await page.goto(`${workshop.server.address}/api`);
  const species = page.locator(".opblock", { has: page.locator('[data-path="/api/v1/species"]') });
  await page.locator('.opblock-tag[data-tag="species"]').tap();
  await species.locator(".opblock-summary-control").tap();
  await species.getByRole("button", { name: "Execute" }).tap();
  await expect.poll(() => species.locator(".live-responses-table").textContent()).toContain("scots-pine");
  expect(await species.locator(".live-responses-table tbody .response-col_status").first().textContent()).toContain(
    "200",
  );
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  expect(wide, "nothing is cut off at the side").toBeLessThanOrEqual(viewport.width);
  expect([faults, elsewhere]).toEqual([[], []]);
  await context.close();
  await browser.close();
});

test("help leads there", async () => {
  const { tablet } = await workshop.fresh();
  await tablet.tap("Help");
  await tablet.page.getByRole("searchbox").fill("openapi");
  const opened = tablet.page.context().waitForEvent("page");
  await tablet.page.getByRole("button", { name: "Show: For programs" }).tap();
  expect(new URL((await opened).url()).pathname).toBe("/api");
});
