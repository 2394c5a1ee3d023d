import type { Locator } from "playwright-core";
import { describe, expect, it } from "vitest";
import { gridModel } from "./grid-model";
import { PHONE, SMALL } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import { Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer();

/** Has the page make a glTF file. */
async function downloadModel(tablet: Tablet, open?: () => Promise<void>): Promise<void> {
  await tablet.press(await modelChosen(tablet, open));
}

/** The button that has the page make a glTF file. */
async function modelChosen(tablet: Tablet, open = () => tablet.tap("Download")): Promise<Locator> {
  await open();
  await tablet.page.getByRole("radio", { name: "Model (glTF)" }).check();
  return tablet.page.getByRole("button", { name: "Download file" });
}

describe("long work", () => {
  it("an export ends with a file", async () => {
    const { tablet } = await workshop.drawn();
    const file = await tablet.download(await modelChosen(tablet));
    expect(file.suggestedFilename()).toMatch(/\.glb$/);
  });

  it("an export can be given up", async () => {
    const { tablet } = await workshop.drawn();
    const { page } = tablet;
    let asked = 0;
    await page.route("**/tree.glb?*", async (route) => {
      asked += 1;
      // The first is never answered.
      if (asked > 1) await route.continue();
    });
    let files = 0;
    page.on("download", () => files++);
    await downloadModel(tablet);
    await page.getByText("Making the file…").waitFor();
    const making = page.getByRole("progressbar", { name: "Making the file…" });
    expect(await making.getAttribute("value"), "how long it takes, nobody knows").toBeNull();
    await page.getByRole("button", { name: "Cancel" }).tap();
    await page.getByText("Making the file…").waitFor({ state: "detached" });
    await tablet.untilSettled();
    expect(await page.locator(".toast").count(), "that is no failure").toBe(0);
    await downloadModel(tablet);
    await until("the next one comes", () => files > 0);
    expect([asked, files]).toEqual([2, 1]);
  });

  it("an export shows how far it has come, and can be given up on the way", async () => {
    const { tablet, address } = await workshop.fresh(PHONE);
    const { page } = tablet;
    await workshop.act(address, [{ kind: "grow", steps: 10 }]);
    await tablet.until("it grows", ({ lastStep }) => lastStep > 0);
    await tablet.untilQuiet();
    const network = await page.context().newCDPSession(page);
    await network.send("Network.enable");
    const throttle = (downloadThroughput: number) =>
      network.send("Network.emulateNetworkConditions", {
        offline: false,
        latency: 0,
        downloadThroughput,
        uploadThroughput: -1,
      });
    let files = 0;
    page.on("download", () => files++);
    await throttle(60_000);
    const download = () =>
      downloadModel(tablet, async () => {
        await tablet.tap("More");
        await page.getByRole("button", { name: "Download" }).tap();
      });
    await download();
    const moving = page.getByRole("progressbar", { name: /^Loading the file, \d+\.\d of \d+\.\d MB$/ });
    await moving.waitFor();
    const first = Number(await moving.getAttribute("value"));
    await until("more of it has come", async () => Number(await moving.getAttribute("value")) > first);
    // What it says goes on changing.
    await tablet.untilCome();
    const chip = (await page.locator(".chip", { has: moving }).boundingBox())!;
    expect(chip.x >= 0 && chip.x + chip.width <= PHONE.width, "all of it is on the glass").toBe(true);
    await tablet.showNow("export");
    const broken = page.waitForEvent("requestfailed", (request) => request.url().includes("/tree.glb?"));
    await page.getByRole("button", { name: "Cancel" }).tap();
    await moving.waitFor({ state: "detached" });
    await broken;
    await tablet.untilSettled();
    expect(await page.locator(".toast").count(), "that is no failure").toBe(0);
    await throttle(-1);
    await download();
    await until("the next one comes", () => files > 0);
    expect(files, "and what was given up does not").toBe(1);
  });
});

describe("a model", () => {
  it("shows how far it has come, can be given up, and comes", async () => {
    const { tablet } = await workshop.fresh(SMALL);
    const { page } = tablet;
    const network = await page.context().newCDPSession(page);
    await network.send("Network.enable");
    const throttle = (uploadThroughput: number) =>
      network.send("Network.emulateNetworkConditions", {
        offline: false,
        latency: 0,
        downloadThroughput: -1,
        uploadThroughput,
      });
    const file = { name: "sheet.glb", mimeType: "model/gltf-binary", buffer: gridModel(220) };
    expect(file.buffer.length).toBeGreaterThan(1_500_000);
    await tablet.tap("Scene");
    await throttle(150_000);
    await page.locator('input[type="file"]').setInputFiles(file);
    const moving = page.getByRole("progressbar", { name: /^Sending the model, / });
    await moving.waitFor();
    const first = Number(await moving.getAttribute("value"));
    await until("more of it has gone", async () => Number(await moving.getAttribute("value")) > first);
    expect(Number(await moving.getAttribute("value"))).toBeLessThan(100);
    const broken = page.waitForEvent("requestfailed");
    await page.getByRole("button", { name: "Cancel" }).tap();
    await moving.waitFor({ state: "detached" });
    await broken;
    await tablet.untilSettled();
    expect(await page.locator(".toast").count(), "that is no failure").toBe(0);
    await throttle(-1);
    await page.locator('input[type="file"]').setInputFiles(file);
    await tablet.until("the model comes", ({ obstacles }) => obstacles > 0);
    expect((await tablet.untilQuiet()).obstacles, "and what was given up does not").toBe(1);
  });

  it("OB6: may be an OBJ file, and the page says how many triangles are kept of many", async () => {
    const { tablet } = await workshop.fresh(SMALL);
    const { page } = tablet;
    await tablet.tap("Scene");
    const side = 300;
    const places = Array.from({ length: side * side }, (_, i) => `v ${i % side} ${Math.floor(i / side)} 9`);
    const faces = Array.from({ length: (side - 1) ** 2 }, (_, i) => {
      const first = Math.floor(i / (side - 1)) * side + (i % (side - 1)) + 1;
      return `f ${first} ${first + 1} ${first + side + 1} ${first + side}`;
    });
    const buffer = Buffer.from([...places, ...faces].join("\n"));
    await page.locator('input[type="file"]').setInputFiles({ name: "sheet.obj", mimeType: "model/obj", buffer });
    await page.getByText("The model has 178,802 triangles. It was simplified, and ", { exact: false }).waitFor();
    await tablet.until("the model comes", ({ obstacles }) => obstacles === 1);
  });

  it("that is none is told of in the language of the page", async () => {
    const { tablet } = await workshop.fresh(SMALL);
    const { page } = tablet;
    await page.evaluate(() => localStorage.setItem("espalier.language", '"de"'));
    await page.reload();
    await tablet.untilReady();
    await tablet.tap("Szene");
    const none = { name: "none.glb", mimeType: "model/gltf-binary", buffer: Buffer.from("this is no model at all") };
    await page.locator('input[type="file"]').setInputFiles(none);
    await page.getByText("Das ist weder eine glTF- noch eine OBJ-Datei.", { exact: false }).waitFor();
  });
});

describe("the library", () => {
  it("brings more trees when its end is scrolled to", async () => {
    const { tablet, address } = await workshop.fresh(SMALL);
    const { page } = tablet;
    const session = address.split("/").at(-1);
    await page.evaluate(async (session) => {
      for (let i = 1; i <= 60; i++) {
        const saved = await fetch("/api/v1/trees", {
          method: "POST",
          headers: { "content-type": "application/json" },
          body: JSON.stringify({ session, name: `Seedling ${i}` }),
        });
        if (!saved.ok) throw new Error(await saved.text());
      }
    }, session);
    await tablet.tap("Library");
    const cards = page.locator(".library .card");
    await cards.first().waitFor();
    expect(await cards.count()).toBeLessThan(60);
    await page.getByText("Seedling 60", { exact: true }).waitFor();
    const first = page.getByText("Seedling 1", { exact: true });
    await until("the first of them comes", async () => {
      await cards.last().scrollIntoViewIfNeeded();
      return (await first.count()) > 0;
    });
    await page.getByRole("button", { name: "Show more" }).waitFor({ state: "detached" });
    const names = await page.locator(".library .card-name").allTextContents();
    expect(new Set(names).size, "each of them once").toBe(names.length);
  });
});
