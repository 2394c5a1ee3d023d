import { cpus } from "node:os";
import { gzipSync } from "node:zlib";
import type { Browser, Page } from "playwright-core";
import { perform } from "../gallery/performance";
import { launchBrowser } from "../src/browser";
import { withClient } from "../src/client-build";
import { inTime, Server, until } from "../src/server";
import { A_TREE, type FrameRecord, instrument } from "./instruments";
import { measureLever } from "./lever";
import { done, grow, openMeasured, quantile, SCREEN, traced } from "./pages";
import { measureWind } from "./wind";

/** Metamers of the tree that budgets are for; it has about twice as many leaves. */
const METAMERS = 100_000;
/** Frames whose script is timed, after some in which everything is used for the first time. */
const FRAMES = 240;
const WARMING = 40;
/** How often the page is opened to see how long that takes, one time after the other. */
const OPENINGS = 5;
/** So long the tree is turned to see how long a frame takes to be drawn, in milliseconds. */
const TURNED = 10_000;

/** So long a picture may take to come to rest, in milliseconds. */
const REST = 150_000;

const BUDGET = { calls: 25, triangles: 1_500_000, script: 4, gzip: 200_000, first: 1000 };

/**
 * Measures the client with a large tree and prints what it costs; `--metamers N` for another size, `lever` for how exactly
 * growth by hand ends, `wind` for what trees that sway cost. Gives the exit code: 0 if every goal was kept.
 */
export async function main(words: readonly string[]): Promise<number> {
  if (words[0] === "lever") {
    await measureLever();
    return 0;
  }
  if (words[0] === "wind") {
    await measureWind();
    return 0;
  }
  const at = words.indexOf("--metamers");
  const metamers = at < 0 ? METAMERS : Number(words[at + 1]);
  const server = new Server();
  const browser = await launchBrowser({ asOnTablets: true });
  try {
    await server.start();
    const address = await server.newSession(5);
    const blank = await browser.newPage();
    await blank.goto(`${server.address}/health`);
    const session = address.slice(address.lastIndexOf("/") + 1);
    // Two leaves at each node that bears any.
    await perform(blank, session, ['{"kind":"set_parameters","parameters":{"leaves_per_node":4}}']);
    const tree = await grow(blank, browser, address, session, metamers);
    const openings = [await openMeasured(browser, address)];
    while (openings.length < OPENINGS) {
      await openings.at(-1)!.page.context().close();
      openings.push(await openMeasured(browser, address));
    }
    const sights = await sightsOf(browser, address);
    const rested = await restedAfter(openings.at(-1)!.page);
    await openings.at(-1)!.page.context().close();
    // What a graphics card draws is the whole picture at rest.
    const { page, first } = await openMeasured(browser, address, { settings: { "espalier.whole-picture": "true" } });
    const middle = (what: "rows" | "first" | "drawn") =>
      quantile(
        openings.map((opening) => opening[what]),
        0.5,
      );
    const still = await atRest(page);
    const whole = await done(page);
    const shown = await turningShown(page);
    const files = await loaded(page);
    const all = await sizeOf(page, files);
    const needed = await sizeOf(
      page,
      // A page with a graphics card does without what only those without one load.
      files.filter(({ name, asked }) => asked < first && !/\/(sketch|slowness-chip)-/.test(name)),
    );
    const { clock, processor } = await turning(browser, page);
    const figures: Figure[] = [
      { what: "draw calls of the camera", value: still.camera.calls, most: BUDGET.calls, print: String },
      { what: "draw calls of the shadow map", value: still.shadow.calls, print: String },
      { what: "triangles of the camera", value: still.camera.triangles, most: BUDGET.triangles, print: thousands },
      { what: "triangles of the shadow map", value: still.shadow.triangles, print: thousands },
      { what: "script a frame, median, ms", value: quantile(processor, 0.5), most: BUDGET.script, print: hundredths },
      { what: "script a frame, 99 %, ms", value: quantile(processor, 0.99), most: BUDGET.script, print: hundredths },
      { what: "by the clock, median, ms", value: quantile(clock, 0.5), most: BUDGET.script, print: hundredths },
      { what: "by the clock, 99 %, ms", value: quantile(clock, 0.99), print: hundredths },
      {
        what: "scripts and styles before the first tree, gzip, bytes",
        value: needed,
        most: BUDGET.gzip,
        print: thousands,
      },
      { what: "all that is loaded once the page is idle, gzip, bytes", value: all, print: thousands },
      { what: "its rows received, ms", value: middle("rows"), print: units },
      { what: "first sight of it drawn, ms", value: quantile(sights, 0.5), print: units },
      { what: "first tree drawn, ms", value: middle("drawn"), print: units },
      { what: "picture at rest and drawn, ms", value: rested, print: units },
      { what: "whole picture at rest and drawn, where that is wished for, ms", value: whole, print: units },
      { what: "a frame while the tree is turned, as it is drawn, ms", value: shown.frame, print: units },
      { what: "the picture behind the finger then, ms", value: shown.behind, print: units },
      { what: "first tree handed to the graphics card, ms", value: middle("first"), most: BUDGET.first, print: units },
    ];
    console.log(`${cpus()[0]?.model ?? "an unknown processor"}, ${cpus().length} cores`);
    console.log(`${browser.browserType().name()} ${browser.version()}, ${SCREEN.width} × ${SCREEN.height}\n`);
    console.log(`| metamers, leaves | ${tree.metamers}, ${tree.leaves} | | |`);
    for (const figure of figures) console.log(lineOf(figure));
    return figures.every(isKept) ? 0 : 1;
  } finally {
    await browser.close();
    await server.stop();
  }
}

/** What was measured, and the most it may be. */
interface Figure {
  readonly what: string;
  readonly value: number;
  readonly most?: number;
  readonly print: (value: number) => string;
}

function isKept({ value, most }: Figure): boolean {
  return most === undefined || value <= most;
}

function lineOf(figure: Figure): string {
  const { what, value, most, print } = figure;
  const goal = most === undefined ? ["", ""] : [print(most), isKept(figure) ? "kept" : "not kept"];
  return `| ${[what, print(value), ...goal].join(" | ")} |`;
}

/** When a page that opens shows the tree for the first time, be it by lines, in milliseconds since the navigation; several times. */
async function sightsOf(browser: Browser, address: string): Promise<number[]> {
  const sights: number[] = [];
  while (sights.length < OPENINGS) {
    const context = await browser.newContext({ viewport: SCREEN, hasTouch: true, deviceScaleFactor: 1 });
    await withClient(context);
    const page = await context.newPage();
    await page.addInitScript(instrument, { aTree: A_TREE, waits: true });
    await page.goto(address, { waitUntil: "commit" });
    sights.push(
      await inTime(
        "a tree is seen",
        page.evaluate(() => window.firstSight),
      ),
    );
    await context.close();
  }
  return sights;
}

/** A script or style, and when the page asked for it, in milliseconds since the navigation. */
interface Loaded {
  readonly name: string;
  readonly asked: number;
}

/** The scripts and styles that the page has loaded, once it has been idle long enough to load them all. */
async function loaded(page: Page): Promise<Loaded[]> {
  const now = () =>
    page.evaluate(() =>
      performance
        .getEntriesByType("resource")
        .map(({ name, startTime }) => ({ name, asked: startTime }))
        .filter(({ name }) => /\.(js|css)$/.test(new URL(name).pathname)),
    );
  let before: Loaded[] = [];
  await until("the page has loaded its parts", async () => {
    const files = await now();
    const done = files.length === before.length && files.length > 0;
    before = files;
    await page.waitForTimeout(done ? 0 : 5000);
    return done;
  });
  return before;
}

/** Bytes of files, each compressed as a server would. */
async function sizeOf(page: Page, files: readonly Loaded[]): Promise<number> {
  let size = 0;
  for (const file of new Set(files.map(({ name }) => name))) {
    const answer = await page.request.get(file);
    size += gzipSync(await answer.body(), { level: 9 }).length;
  }
  return size;
}

/** The last frame at rest, with the shadow pass that went before it. */
async function atRest(page: Page): Promise<FrameRecord> {
  let count = -1;
  await page.waitForSelector("canvas[data-still]", { state: "attached", timeout: REST });
  await until("the picture comes to rest", async () => {
    const before = count;
    await page.waitForTimeout(1500);
    count = await page.evaluate(() => window.measured.length);
    return count === before;
  });
  // A frame is only entered when the next one begins; the rest is the last but for what fades in over it.
  const frames = await page.evaluate(() => window.measured);
  const whole = frames.filter(({ camera }) => camera.triangles > A_TREE);
  const shadow = frames.filter(({ shadow }) => shadow.calls > 0).at(-1)?.shadow;
  const last = whole.at(-1);
  if (!last || !shadow) throw new Error("no frame at rest was seen");
  return { ...last, shadow };
}

/** When the picture of a page came to rest and was drawn, in milliseconds since the navigation. */
async function restedAfter(page: Page): Promise<number> {
  await page.waitForSelector("canvas[data-still]", { state: "attached", timeout: REST });
  return done(page);
}

/** Turns the tree for a while, all of it drawn: milliseconds a frame takes, and for how long it is drawn on afterwards. */
async function turningShown(page: Page): Promise<{ frame: number; behind: number }> {
  const { began, ended, frames } = await page.getByRole("slider", { name: "Turn the tree" }).evaluate(
    (strip, lasts) =>
      new Promise<{ began: number; ended: number; frames: number }>((resolve) => {
        window.measured.length = 0;
        const began = performance.now();
        const step = () => {
          const ended = performance.now();
          if (ended - began > lasts) return resolve({ began, ended, frames: Math.max(1, window.measured.length) });
          strip.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true, cancelable: true }));
          requestAnimationFrame(step);
        };
        step();
      }),
    TURNED,
  );
  const behind = (await done(page)) - ended;
  return { frame: (ended + behind - began) / frames, behind };
}

/**
 * Milliseconds of script in each frame while the tree is turned by its strip: what the processor needed for it, and by the
 * clock, which also counts the time that the browser's other processes and the server had the processor.
 */
async function turning(browser: Browser, page: Page): Promise<{ clock: number[]; processor: number[] }> {
  await page.evaluate(() => {
    window.blind = true;
  });
  await turn(page, WARMING);
  const clock = await turn(page, FRAMES);
  return { clock, processor: await traced(browser, FRAMES, () => turn(page, FRAMES)) };
}

/** Turns a little in each frame until so many were drawn; gives the script of each. */
async function turn(page: Page, enough: number): Promise<number[]> {
  return page.getByRole("slider", { name: "Turn the tree" }).evaluate(
    (strip, enough) =>
      new Promise<number[]>((resolve) => {
        window.measured.length = 0;
        const step = () => {
          if (window.measured.length >= enough) {
            resolve(window.measured.map(({ script }) => script));
            return;
          }
          strip.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true, cancelable: true }));
          requestAnimationFrame(step);
        };
        step();
      }),
    enough,
  );
}

function units(value: number): string {
  return value.toFixed(0);
}

function hundredths(value: number): string {
  return value.toFixed(2);
}

function thousands(value: number): string {
  return `${Math.round(value / 1000)} k`;
}
