import { readFile, stat } from "node:fs/promises";
import { join } from "node:path";
import { expect, test } from "vitest";
import { screenshots } from "./browser";
import { LANDSCAPE, PHONE, type Screen } from "./screens";
import type { Tablet } from "./tablet";
import { press } from "./visits";
import { Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer();

/** Opens what orders trees like a species, from its card among the templates. */
async function likeSpecies(tablet: Tablet, species: string): Promise<void> {
  const { page } = tablet;
  await press(tablet, "Library");
  await page.getByRole("radio", { name: "Templates", exact: true }).check();
  await page.getByRole("button", { name: `More for ${species}`, exact: true }).tap();
  await page.locator(".card-menu").getByRole("button", { name: "Grow variations…" }).tap();
  await page.getByRole("dialog", { name: "Grow variations" }).waitFor();
  await page.getByRole("radio", { name: "Skeleton (JSON)" }).waitFor();
}

async function type(tablet: Tablet, label: string, value: number): Promise<void> {
  await tablet.page.getByLabel(`${label}: value`, { exact: true }).fill(String(value));
}

const job = (tablet: Tablet) => tablet.page.locator(".job");

test.each<[string, Screen]>([
  ["tablet", LANDSCAPE],
  ["phone", PHONE],
])("JB1: trees like a species are ordered on a %s, and their files come", async (name, screen) => {
  const { tablet } = await workshop.fresh(screen);
  const { page } = tablet;
  await likeSpecies(tablet, "Oak");
  await page.getByText("Nothing is being grown for you.").waitFor();
  await tablet.show(`variations-form-${name}`);
  await page.getByRole("radio", { name: "Skeleton (JSON)" }).check();
  await page.getByRole("radio", { name: "Older" }).check();
  await type(tablet, "Steps more than its age", 3);
  await type(tablet, "First seed", 7);
  await type(tablet, "How many", 3);
  // The very key that sends it ends what is typed.
  await page.keyboard.press("Enter");
  await job(tablet).getByText("Done", { exact: true }).waitFor();
  await tablet.show(`variations-done-${name}`);
  expect(await page.locator(".job-files strong").allTextContents()).toEqual(["Seed 7", "Seed 8", "Seed 9"]);
  const file = await tablet.download(page.getByRole("link", { name: "Download seed 8" }));
  const path = join(screenshots, "variation.json");
  await file.saveAs(path);
  expect(file.suggestedFilename()).toMatch(/8.*\.json$/);
  expect((await stat(path)).size).toBeGreaterThan(500);
  // All of them come as one.
  const archive = await tablet.download(page.getByRole("link", { name: "Download all 3 as ZIP" }));
  await archive.saveAs(path);
  expect(archive.suggestedFilename()).toBe("trees.zip");
  expect((await readFile(path)).subarray(0, 4)).toEqual(Buffer.from("PK\x03\x04"));
  // Files are asked about before they go.
  await page.getByRole("button", { name: "Remove the trees like Oak" }).tap();
  await page.getByText("Its files go from the server.").waitFor();
  await page.getByRole("button", { name: "Remove", exact: true }).tap();
  await page.getByText("Nothing is being grown for you.").waitFor();
});

test("JB2: what was ordered is found after a reload, in its chip and its sheet, and is cancelled", async () => {
  const { tablet, address } = await workshop.fresh(PHONE);
  const { page } = tablet;
  await workshop.act(address, [{ kind: "grow", steps: 4 }]);
  await tablet.untilQuiet();
  await page.evaluate(async () => {
    const session = location.pathname.slice(location.pathname.lastIndexOf("/") + 1);
    const headers = { "content-type": "application/json" };
    await fetch("/api/v1/trees", { method: "POST", headers, body: JSON.stringify({ session, name: "My elm" }) });
  });
  await press(tablet, "Library");
  await page.getByRole("button", { name: "More for My elm", exact: true }).tap();
  await page.locator(".card-menu").getByRole("button", { name: "Grow variations…" }).tap();
  await page.getByRole("radio", { name: "Larger" }).check();
  await type(tablet, "Metamers at least", 60_000);
  await type(tablet, "How many", 900);
  await page.getByRole("button", { name: "Grow them" }).tap();
  await job(tablet).getByText("900 like My elm").waitFor();
  await job(tablet).getByText("of 900 done", { exact: false }).waitFor();
  await tablet.showNow("variations-growing");
  await page.reload();
  await tablet.untilReady();
  const chip = page.locator(".chip", { hasText: "Growing trees like My elm" });
  await chip.waitFor();
  await tablet.showNow("variations-chip");
  await chip.getByRole("button", { name: "Show" }).tap();
  await job(tablet).getByText("900 like My elm").waitFor();
  await page.getByRole("button", { name: "Cancel the trees like My elm" }).tap();
  // What has files by now is asked about.
  const sure = page.getByRole("button", { name: "Cancel", exact: true });
  await page.getByText("Nothing is being grown for you.").or(sure).first().waitFor();
  if (await sure.isVisible()) await sure.tap();
  await page.getByText("Nothing is being grown for you.").waitFor();
  await page.keyboard.press("Escape");
  await chip.waitFor({ state: "detached" });
  await page.reload();
  await tablet.untilReady();
  expect(await page.evaluate(() => localStorage.getItem("espalier.variations"))).toBe("[]");
});

test("IK1: an order whose answer is lost is one job when it is sent again", async () => {
  const { tablet } = await workshop.fresh(LANDSCAPE);
  const { page } = tablet;
  await likeSpecies(tablet, "Silver birch");
  await page.getByRole("radio", { name: "Older" }).check();
  await type(tablet, "Steps more than its age", 2);
  await type(tablet, "How many", 2);
  // It comes to the server, and its answer does not come back.
  await page.route("**/api/v1/grow", async (route) => {
    await route.fetch();
    await route.abort();
  });
  const order = page.getByRole("button", { name: "Grow them" });
  await order.tap();
  await page.getByRole("alert").getByText("The server does not answer", { exact: false }).waitFor();
  const sent = page.waitForResponse("**/api/v1/grow");
  await page.unroute("**/api/v1/grow");
  await order.tap();
  const { id } = (await (await sent).json()) as { id: string };
  await job(tablet).getByText("Done", { exact: true }).waitFor();
  expect(await job(tablet).evaluateAll((jobs) => jobs.map((job) => job.id))).toEqual([`job-${id}`]);
  await type(tablet, "How many", 3);
  await page.getByRole("radio", { name: "Larger" }).check();
  await type(tablet, "Metamers at least", 9_999_999);
  await page.getByRole("button", { name: "Grow them" }).tap();
  await page.locator(".order-form").getByRole("alert").waitFor();
  await tablet.show("variations-refused");
  expect(await job(tablet).count(), "what is refused is no job").toBe(1);
  // The browser writes down a request that is cut off, and one that is refused.
  tablet.errors.length = 0;
});
