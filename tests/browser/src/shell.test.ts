import { describe, expect, it } from "vitest";
import { gridModel } from "./grid-model";
import { type Box, changed } from "./picture";
import { until } from "./server";
import { COARSE, type Point, type Screen, type Tablet, way } from "./tablet";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

const UPRIGHT: Screen = { width: 834, height: 1194, detail: 0.4 };
const PHONE: Screen = { width: 390, height: 844, detail: 0.6 };
/** For tests in which nothing is looked at. */
const SMALL: Screen = { width: 900, height: 640, detail: 0.2 };

const labelled = (tablet: Tablet, label: string) => tablet.page.getByLabel(label, { exact: true });

const middle = ({ x, y, width, height }: Box): Point => ({ x: x + width / 2, y: y + height / 2 });

const apart = (a: Box, b: Box) =>
  a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y;

/** The canvas, once it has taken its place beside a panel or alone. */
async function canvas(tablet: Tablet, wanted: (box: Box) => boolean): Promise<Box> {
  let box = await tablet.boxOf(tablet.page.locator("#workspace"));
  await until("the workspace takes its place", async () => {
    box = await tablet.boxOf(tablet.page.locator("#workspace"));
    return wanted(box);
  });
  return box;
}

/** Where the seedling stands on the glass. */
async function seedling(tablet: Tablet): Promise<Point> {
  const { x, y, width, height } = await tablet.boxOf(tablet.page.locator(".seedling").first());
  return { x: x + width / 2, y: y + 0.9 * height };
}

/** Commands the page sends from its next loading on. */
function overheard(tablet: Tablet): Record<string, unknown>[] {
  const sent: Record<string, unknown>[] = [];
  tablet.page.on("websocket", (socket) =>
    socket.on("framesent", ({ payload }) => {
      const message = JSON.parse(String(payload));
      sent.push(message.command ?? message);
    }),
  );
  return sent;
}

/** Taps one of a sheet's choices. */
async function choose(tablet: Tablet, text: string): Promise<void> {
  const choice = tablet.page.locator("dialog label").filter({ hasText: text });
  await choice.tap();
  await until(`${text} is chosen`, () => choice.locator("input").isChecked());
}

describe("panels", () => {
  it("shrink the workspace, which stays in use", async () => {
    const { tablet } = await workshop.fresh();
    for (const name of ["Architecture", "Brush", "Leaves", "Branches", "Background", "Scene"]) {
      await tablet.tap(name);
      const panel = tablet.page.getByRole("region", { name, exact: true });
      await panel.waitFor();
      const shrunk = await canvas(tablet, ({ width }) => width < 900);
      expect(apart(shrunk, await tablet.boxOf(panel)), name).toBe(true);
      expect(shrunk.height).toBe(COARSE.height);
    }
    const { x, y, width } = await canvas(tablet, ({ width }) => width < 900);
    const before = await tablet.facts();
    await tablet.swipe([way({ x: x + width / 2, y: y + 600 }, { x: x + width / 2, y: y + 330 })]);
    expect((await tablet.untilQuiet()).metamers).toBeGreaterThan(before.metamers);
    await tablet.tap("Scene");
    await canvas(tablet, ({ width }) => width === COARSE.width);
  });

  it("lie at the foot where the tablet stands upright", async () => {
    const { tablet } = await workshop.fresh(UPRIGHT);
    await tablet.tap("Leaves");
    const panel = tablet.page.getByRole("region", { name: "Leaves", exact: true });
    await panel.waitFor();
    const shrunk = await canvas(tablet, ({ height }) => height < 900);
    expect(shrunk.width).toBe(UPRIGHT.width);
    expect((await tablet.boxOf(panel)).y).toBeGreaterThanOrEqual(shrunk.y + shrunk.height - 1);
  });

  it("hide with everything else, and come back", async () => {
    const { tablet } = await workshop.fresh();
    await tablet.tap("Brush");
    await canvas(tablet, ({ width }) => width < 900);
    await tablet.tap("Hide everything");
    await canvas(tablet, ({ width }) => width === COARSE.width);
    expect(await tablet.page.locator(".tool-bar, .side-bar, .foot, .drawer").count()).toBe(0);
    await tablet.tap("Show everything");
    await labelled(tablet, "Undo").waitFor();
    await tablet.page.keyboard.press("h");
    await labelled(tablet, "Show everything").waitFor();
    await tablet.page.keyboard.press("Escape");
    await labelled(tablet, "Undo").waitFor();
  });
});

describe("the strip that turns", () => {
  const turned = async (tablet: Tablet) =>
    Number(await labelled(tablet, "Turn the tree").getAttribute("aria-valuenow"));

  it("turns by a finger, and by keys", async () => {
    const { tablet } = await workshop.fresh();
    const strip = await tablet.boxOf(labelled(tablet, "Turn the tree"));
    const { x, y } = middle(strip);
    await tablet.swipe([way({ x, y }, { x: x + strip.width / 4, y })]);
    await until("a quarter of the strip is a quarter turn", async () => Math.abs((await turned(tablet)) - 90) <= 3);
    await labelled(tablet, "Turn the tree").focus();
    await tablet.page.keyboard.press("Home");
    await until("home is the front", async () => (await turned(tablet)) === 0);
    await tablet.page.keyboard.press("ArrowLeft");
    await until("an arrow is five degrees", async () => (await turned(tablet)) === -5);
  });

  it("lets a stroke wind around the tree", async () => {
    const { tablet } = await workshop.fresh();
    const sent = overheard(tablet);
    await tablet.page.reload();
    await tablet.untilReady();
    const strip = await tablet.boxOf(labelled(tablet, "Turn the tree"));
    const [left, y] = [strip.x + 12, strip.y + strip.height / 2];
    const seed = await seedling(tablet);
    const drawing = { x: seed.x + 60, y: seed.y - 40 };
    const steps = 48;
    for (let i = 0; i < steps; i++) {
      // The drawing finger only rises; the other hand turns the tree by nearly a whole turn.
      const fingers = [
        { x: drawing.x, y: drawing.y - 5 * i },
        { x: left + ((strip.width - 24) * Math.max(0, i - 4)) / (steps - 5), y },
      ];
      await tablet.touch(i === 0 ? "touchStart" : "touchMove", i === 0 ? fingers.slice(0, 1) : fingers);
      if (i === 3) await tablet.touch("touchStart", fingers);
      await tablet.page.waitForTimeout(40);
    }
    await tablet.touch("touchEnd", []);
    await tablet.untilQuiet();
    const samples = sent.flatMap(({ kind, samples }) =>
      kind === "stroke_move" ? (samples as { position: [number, number, number] }[]) : [],
    );
    const places = samples.map(({ position }) => position);
    expect(places.length).toBeGreaterThan(20);
    // Around the seed at the origin: in all four quarters, at one distance, and rising.
    const quarters = new Set(places.map(([x, , z]) => Math.floor(Math.atan2(z, x) / (Math.PI / 2))));
    expect(quarters.size).toBe(4);
    const radii = places.map(([x, , z]) => Math.hypot(x, z));
    expect(Math.max(...radii) / Math.min(...radii)).toBeLessThan(1.5);
    expect(places.at(-1)![1] - places[0]![1]).toBeGreaterThan(5);
    expect((await tablet.facts()).operations).toBe("stroke");
    await tablet.photograph("helix");
  });
});

describe("settings", () => {
  it("a language is spoken at once, and remembered", async () => {
    const { tablet } = await workshop.fresh();
    await tablet.tap("Settings");
    await choose(tablet, "Deutsch");
    await labelled(tablet, "Einstellungen").first().waitFor();
    await tablet.page.keyboard.press("Escape");
    await tablet.page.reload();
    await tablet.untilReady();
    await labelled(tablet, "Rückgängig").waitFor();
    expect(await tablet.page.evaluate(() => document.documentElement.lang)).toBe("de");
    await tablet.page.keyboard.press("Shift+?");
    await tablet.page.getByRole("dialog", { name: "So zeichnet man einen Baum" }).waitFor();
  });

  it("a theme is worn at once, and remembered", async () => {
    const { tablet } = await workshop.fresh();
    const ink = () => tablet.page.evaluate(() => getComputedStyle(document.documentElement).color);
    const light = await ink();
    await tablet.tap("Settings");
    await choose(tablet, "Dark");
    await until("the ink is another", async () => (await ink()) !== light);
    const dark = await ink();
    await tablet.page.reload();
    await tablet.untilReady();
    expect(await ink()).toBe(dark);
  });

  it("tools stand at the side that was chosen", async () => {
    const { tablet } = await workshop.fresh();
    await tablet.tap("Settings");
    await choose(tablet, "right");
    await tablet.page.keyboard.press("Escape");
    expect((await tablet.boxOf(tablet.page.getByRole("navigation"))).x).toBeGreaterThan(COARSE.width / 2);
    await tablet.tap("Leaves");
    expect((await canvas(tablet, ({ width }) => width < 900)).x).toBeGreaterThan(200);
  });
});

describe("a first run", () => {
  it("shows three gestures, and is remembered", async () => {
    const { tablet } = await workshop.fresh();
    await tablet.page.evaluate(() => localStorage.setItem("espalier.tour", "false"));
    await tablet.page.reload();
    await tablet.untilReady();
    const card = tablet.page.getByRole("region", { name: "A tour in three gestures" });
    await card.getByText("1 of 3").waitFor();
    const seed = await seedling(tablet);
    await tablet.swipe([way(seed, { x: seed.x, y: seed.y - 200 })]);
    await card.getByText("2 of 3").waitFor();
    const strip = await tablet.boxOf(labelled(tablet, "Turn the tree"));
    await tablet.swipe([way(middle(strip), { x: strip.x + strip.width, y: strip.y + 20 })]);
    await card.getByText("3 of 3").waitFor();
    const lever = await tablet.boxOf(labelled(tablet, "Grow"));
    await tablet.swipe([way(middle(lever), { x: middle(lever).x, y: middle(lever).y - 12 }, 4)]);
    await card.waitFor({ state: "detached" });
    await tablet.untilQuiet();
    await tablet.page.reload();
    await tablet.untilReady();
    expect(await card.count()).toBe(0);
    await tablet.page.keyboard.press("Shift+?");
    await tablet.page.getByRole("button", { name: "Take the tour" }).tap();
    await card.getByText("1 of 3").waitFor();
    await card.getByRole("button", { name: "Skip" }).tap();
    expect(await card.count()).toBe(0);
  });

  it("help is found by typing", async () => {
    const { tablet } = await workshop.fresh();
    await tablet.tap("Help");
    const help = tablet.page.getByRole("dialog");
    await help.getByRole("searchbox").fill("pinch limb");
    await help.getByText("Pinch around a limb", { exact: false }).waitFor();
    expect(await help.locator("dt").allTextContents()).toEqual(["Width"]);
    await help.getByRole("searchbox").fill("apical dominance");
    expect(await help.locator("dt").allTextContents()).toContain("Apical dominance");
    await help.getByRole("searchbox").fill("no such thing anywhere");
    await help.getByText("Nothing found").waitFor();
  });

  it("help shows what it speaks of", async () => {
    const { tablet } = await workshop.fresh(SMALL);
    const { page } = tablet;
    const shown = async (query: string, topic: string) => {
      // A sheet that has just gone keeps the keys to itself until the next frame.
      await tablet.frames();
      await page.keyboard.press("Shift+?");
      const help = page.getByRole("dialog");
      await help.getByRole("searchbox").fill(query);
      await help
        .getByRole("button", { name: `Show: ${topic}`, exact: true })
        .first()
        .tap();
      await help.getByRole("searchbox").waitFor({ state: "detached" });
    };
    // Who reads English may know the German word.
    await shown("Bibliothek", "Library");
    const library = page.getByRole("dialog", { name: "Library" });
    await library.waitFor();
    await page.keyboard.press("Escape");
    await library.waitFor({ state: "detached" });
    await shown("shears", "Prune");
    expect((await tablet.facts()).tool).toBe("prune");
    await shown("mature", "Dominance when mature");
    await page.getByRole("tab", { name: "Growth", selected: true }).waitFor();
    await shown("ripe fruits", "Colour of fruits");
    await page.getByRole("region", { name: "Leaves", exact: true }).waitFor();
    await shown("relief", "Relief");
    const relief = page.locator(".field-name.pointed");
    await relief.waitFor();
    expect(await relief.textContent()).toContain("Relief");
    await shown("rotation strip", "Rotation strip");
    await page.locator(".rotation.pointed").waitFor();
    await shown("tour", "Help and tour");
    await page.getByText("1 of 3").waitFor();
  });
});

describe("a phone", () => {
  it("has all bars on its glass, none over another", async () => {
    const { tablet } = await workshop.fresh(PHONE);
    const bars = await Promise.all(
      [".tool-bar", ".side-bar", ".rotation"].map((bar) => tablet.boxOf(tablet.page.locator(bar))),
    );
    for (const [i, bar] of bars.entries()) {
      expect(bar.x).toBeGreaterThanOrEqual(0);
      expect(bar.y).toBeGreaterThanOrEqual(0);
      expect(bar.x + bar.width).toBeLessThanOrEqual(PHONE.width);
      expect(bar.y + bar.height).toBeLessThanOrEqual(PHONE.height);
      for (const other of bars.slice(i + 1)) expect(apart(bar, other)).toBe(true);
    }
    // What stands at the edges takes less than a third of the glass.
    const covered = bars.reduce((sum, { width, height }) => sum + width * height, 0);
    expect(covered).toBeLessThan((PHONE.width * PHONE.height) / 3);
    await tablet.tap("All tools: Brush");
    await tablet.tap("Lasso");
    expect((await tablet.facts()).tool).toBe("lasso");
    await tablet.tap("More");
    await tablet.page.getByRole("button", { name: "Save" }).tap();
    await tablet.page.getByRole("dialog", { name: "Save this tree" }).waitFor();
  });

  it("draws beside a panel", async () => {
    const { tablet } = await workshop.fresh(PHONE);
    await tablet.tap("Scene");
    const { width, height } = await canvas(tablet, ({ height }) => height < 600);
    expect(height).toBeGreaterThan(380);
    await tablet.swipe([way({ x: width / 2 + 60, y: height * 0.7 }, { x: width / 2 + 60, y: height * 0.35 })]);
    expect((await tablet.untilQuiet()).metamers).toBeGreaterThan(0);
  });
});

describe("long work", () => {
  it("an export ends with a file", async () => {
    const { tablet } = await workshop.drawn();
    const file = tablet.page.waitForEvent("download");
    await tablet.tap("Download as glTF");
    expect((await file).suggestedFilename()).toMatch(/\.glb$/);
  });

  it("an export can be given up", async () => {
    const { tablet } = await workshop.drawn();
    const { page } = tablet;
    let answer = () => {};
    await page.route("**/tree.glb", async (route) => {
      await new Promise<void>((resolve) => {
        answer = resolve;
      });
      await route.abort().catch(() => undefined);
    });
    await tablet.tap("Download as glTF");
    await page.getByText("Making the glTF file…").waitFor();
    const making = page.getByRole("progressbar", { name: "Making the glTF file…" });
    expect(await making.getAttribute("value"), "how long it takes, nobody knows").toBeNull();
    await page.getByRole("button", { name: "Cancel" }).tap();
    await page.getByText("Making the glTF file…").waitFor({ state: "detached" });
    answer();
    await page.waitForTimeout(300);
    expect(await page.locator(".toast").count()).toBe(0);
  });

  it("an export shows how far it has come, and can be given up on the way", async () => {
    const { tablet, address } = await workshop.fresh(PHONE);
    const { page } = tablet;
    await workshop.act(address, [{ kind: "grow", steps: 10 }]);
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
    const download = async () => {
      await tablet.tap("More");
      await page.getByRole("button", { name: "Download as glTF" }).tap();
    };
    await download();
    const moving = page.getByRole("progressbar", { name: /^Loading the glTF file, \d+\.\d of \d+\.\d MB$/ });
    await moving.waitFor();
    const first = Number(await moving.getAttribute("value"));
    await until("more of it has come", async () => Number(await moving.getAttribute("value")) > first);
    const chip = await tablet.boxOf(page.locator(".chip"));
    expect(chip.x >= 0 && chip.x + chip.width <= PHONE.width, "all of it is on the glass").toBe(true);
    await tablet.glimpse("export");
    await page.getByRole("button", { name: "Cancel" }).tap();
    await moving.waitFor({ state: "detached" });
    await throttle(-1);
    await page.waitForTimeout(500);
    expect([files, await page.locator(".toast").count()], "no file, and no failure").toEqual([0, 0]);
    await download();
    await until("the next one comes", () => files === 1);
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
    await page.getByRole("button", { name: "Cancel" }).tap();
    await moving.waitFor({ state: "detached" });
    await throttle(-1);
    await page.waitForTimeout(300);
    expect((await tablet.facts()).obstacles, "what was given up does not come").toBe(0);
    expect(await page.locator(".toast").count(), "and is no failure").toBe(0);
    await page.locator('input[type="file"]').setInputFiles(file);
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
    await page.getByText("Das ist keine glTF-Datei.", { exact: false }).waitFor();
  });
});

describe("the library", () => {
  it("brings more trees when its end is scrolled to", async () => {
    const { tablet, address } = await workshop.fresh(SMALL);
    const { page } = tablet;
    const session = address.split("/").at(-1);
    await page.evaluate(async (session) => {
      for (let i = 1; i <= 60; i++) {
        const saved = await fetch("/api/trees", {
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
    await cards.last().scrollIntoViewIfNeeded();
    await page.getByText("Seedling 1", { exact: true }).waitFor();
    const names = await page.locator(".library .card-name").allTextContents();
    expect(new Set(names).size, "each of them once").toBe(names.length);
    await page.getByRole("button", { name: "Show more" }).waitFor({ state: "detached" });
  });
});

describe("without a server", () => {
  it("the page opens all the same, says so, and finds it again", async () => {
    const { tablet, address } = await workshop.fresh();
    await tablet.page.evaluate(async () => {
      await navigator.serviceWorker.ready;
    });
    const kept = await tablet.page.evaluate(async () => {
      const names = await caches.keys();
      const paths = await Promise.all(
        names.map(async (name) => (await (await caches.open(name)).keys()).map(({ url }) => new URL(url).pathname)),
      );
      return paths.flat();
    });
    expect(kept).toContain("/");
    expect(kept.some((path) => path.startsWith("/api") || path.startsWith("/health"))).toBe(false);
    await workshop.server.kill();
    await tablet.page.goto(address);
    await tablet.page.getByRole("heading", { name: "The server does not answer" }).waitFor();
    await workshop.server.start();
    await tablet.untilReady();
    expect(await tablet.page.getByRole("alert").count()).toBe(0);
  });
});

describe("a picture that the device drops", () => {
  it("is spoken of until it is back, also when another tree is opened", async () => {
    const { tablet } = await workshop.fresh(SMALL);
    const { page } = tablet;
    const card = page.getByRole("heading", { name: "The picture is gone" });
    const context = (act: "loseContext" | "restoreContext") =>
      page.evaluate((act) => {
        const canvas = document.querySelector<HTMLCanvasElement>("#workspace")!;
        const loss = globalThis as { loss?: WEBGL_lose_context | null };
        // A context that is lost gives out no more extensions.
        loss.loss ??= canvas.getContext("webgl2")!.getExtension("WEBGL_lose_context");
        loss.loss![act]();
      }, act);
    await context("loseContext");
    await page.waitForTimeout(400);
    expect(await card.count(), "most devices give it back at once").toBe(0);
    await card.waitFor();
    await page.getByRole("alert").getByRole("button", { name: "Reload" }).waitFor();
    const gone = await tablet.glimpse("picture-gone");
    const before = page.url();
    await tablet.tap("New tree");
    await until("another tree is open", () => page.url() !== before);
    await tablet.untilReady();
    expect(await card.count(), "there is no picture of it either").toBe(1);
    await context("restoreContext");
    await card.waitFor({ state: "detached" });
    const beside = { x: 690, y: 120, width: 150, height: 300 };
    expect(changed(gone, await tablet.photograph("picture-back"), beside), "it is drawn again").toBeGreaterThan(0.5);
  });
});
