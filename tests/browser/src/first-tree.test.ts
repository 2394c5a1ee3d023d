import { buffer } from "node:stream/consumers";
import type { Download } from "playwright-core";
import { expect, test } from "vitest";
import { LANDSCAPE, type Screen } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import { press } from "./visits";
import { Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer();

/** A turntable takes long where the processor does much else, in milliseconds. */

/** What a file of each format begins with. */
const HEADS: Readonly<Record<string, string>> = {
  glb: "glTF",
  "obj.zip": "PK",
  "pivots.zip": "PK",
  usda: "#usda 1.0",
  "usda.zip": "PK",
  usdz: "PK",
  ply: "ply\n",
  mtg: "CODE:",
  csv: "radius",
  json: '{"format":"espalier-skeleton"',
  "joints.csv": "joint,",
  png: "\x89PNG",
  "sway.png": "\x89PNG",
  espalier: "",
};

/** As the walk of docs/library.md is told for: a tablet upright, and one on its side. */
const SCREENS: Readonly<Record<string, Screen>> = {
  landscape: { ...LANDSCAPE, detail: 0.4 },
  upright: { width: 834, height: 1194, detail: 0.4 },
};

async function open(tablet: Tablet, name: string): Promise<void> {
  await press(tablet, name);
  await tablet.page.getByRole("dialog").waitFor();
  await tablet.untilSettled();
}

async function closed(tablet: Tablet): Promise<void> {
  await tablet.page.getByRole("dialog").waitFor({ state: "detached" });
}

async function shut(tablet: Tablet): Promise<void> {
  await tablet.page.getByRole("dialog").getByRole("button", { name: "Close", exact: true }).tap();
  await closed(tablet);
}

async function grow(tablet: Tablet, address: string, steps: number): Promise<number> {
  const before = (await tablet.facts()).metamers;
  await workshop.act(address, [{ kind: "grow", steps }]);
  await tablet.until("it has grown on", ({ metamers }) => metamers !== before);
  return (await tablet.untilQuiet()).metamers;
}

async function choose(tablet: Tablet, of: string, deed: RegExp | string): Promise<void> {
  await tablet.page.getByRole("button", { name: `More for ${of}`, exact: true }).tap();
  await tablet.page.locator(".card-menu").getByRole("button", { name: deed }).tap();
}

/** Has the page make a file of a format. */
async function file(tablet: Tablet, label: string): Promise<Download> {
  const { page } = tablet;
  await open(tablet, "Download");
  await page.getByRole("radio", { name: label, exact: true }).check();
  // Where it moves: the fewest pictures, as small as on this glass.
  for (const fewest of ["24", "As I see it"]) {
    const choice = page.getByRole("radio", { name: fewest, exact: true });
    if ((await choice.count()) > 0) await choice.check();
  }
  const download = await tablet.download(page.getByRole("button", { name: "Download file" }));
  await closed(tablet);
  return download;
}

test.each(Object.entries(SCREENS))(
  "a tree is saved, found, exported in every format, taken back as a scan and grown on, on a tablet: %s",
  async (orientation, screen) => {
    const { tablet, address } = await workshop.fresh(screen);
    const { page } = tablet;
    const name = `Old maple ${orientation}`;
    const first = await grow(tablet, address, 4);

    await open(tablet, "Save");
    await page.getByLabel("Name", { exact: true }).fill(name);
    await tablet.show(`library-save-${orientation}`);
    await page.getByRole("button", { name: "Save tree" }).tap();
    await page.getByText(`Saved “${name}”`).waitFor();
    await closed(tablet);

    const second = await grow(tablet, address, 1);
    expect(second).toBeGreaterThan(first);
    await open(tablet, "Save");
    await page.getByLabel("Note (optional)").fill("One more year");
    await page.getByRole("button", { name: "Save version 2" }).tap();
    await page.getByText("Saved version 2 of").waitFor();
    await closed(tablet);

    await open(tablet, "Library");
    // Parts of words are found.
    await page.getByRole("searchbox").fill(`maple ${orientation.slice(0, 5)}`);
    const cards = page.locator(".library-main > .library .card-name");
    await until("it alone is found", async () => (await cards.allTextContents()).join() === name);
    await tablet.show(`library-found-${orientation}`);
    await choose(tablet, name, /^Versions/);
    await page.getByText("One more year").waitFor();
    await tablet.show(`library-versions-${orientation}`);
    await choose(tablet, "version 1", "Restore as the newest");
    await page.locator("[data-version='3']").getByText("as version 1").waitFor();
    await page.locator(".toast-row", { hasText: "as version 3" }).getByRole("button", { name: "Open" }).tap();
    await tablet.until("it is as it was", ({ metamers }) => metamers === first);
    await tablet.untilQuiet();

    const formats: { ending: string; label: string }[] = await page.evaluate(async () =>
      (await fetch("/api/v1/formats")).json(),
    );
    await open(tablet, "Download");
    const offered = page.locator("label", { has: page.locator('input[name="format"]') });
    // The picture of the view, and each format of the server.
    await until("all formats are offered", async () => (await offered.count()) === 1 + formats.length);
    const labels = await offered.allTextContents();
    await tablet.show(`library-download-${orientation}`);
    await shut(tablet);
    const scans: Buffer[] = [];
    for (const [i, { ending }] of formats.entries()) {
      // What moves is made picture by picture; once is enough.
      if (orientation === "upright" && ending.endsWith("png")) continue;
      const made = await file(tablet, labels[i + 1]!);
      expect(made.suggestedFilename(), ending).toBe(`${name}.${ending}`);
      const bytes = await buffer(await made.createReadStream());
      const head = HEADS[ending];
      expect(head, `the head of ${ending} is known`).toBeDefined();
      expect(bytes.subarray(0, head!.length).toString("latin1"), ending).toBe(head);
      if (ending === "csv") scans.push(bytes);
    }

    await open(tablet, "Library");
    const [scan] = scans;
    expect(scan).toBeDefined();
    const scanned = `scan ${orientation}`;
    await page
      .locator('.library-main input[type="file"], dialog input[type="file"]')
      .first()
      .setInputFiles({ name: `${scanned}.csv`, mimeType: "text/csv", buffer: scan! });
    const told = page.locator(".toast-row", { hasText: `“${scanned}” is in the library now` });
    await told.waitFor();
    await page.getByRole("group", { name: `How ${scanned}.csv is taken` }).waitFor();
    await tablet.show(`library-scan-${orientation}`);
    await told.getByRole("button", { name: "Open" }).tap();
    // As many internodes; the seed is no cylinder.
    await tablet.until("the scan is a tree", ({ metamers }) => metamers === first);
    await tablet.untilQuiet();
    const here = page.url();
    expect(await grow(tablet, here, 1), "which grows on").toBeGreaterThan(first);
    await tablet.show(`library-scan-grown-${orientation}`);
  },
  600_000,
);
