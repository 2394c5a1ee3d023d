import type { Browser, Page } from "playwright-core";
import { perform } from "../gallery/performance";
import { withClient } from "../src/client-build";
import { inTime, until } from "../src/server";
import { A_TREE, instrument } from "./instruments";

export const SCREEN = { width: 1194, height: 834 };

/** What the browser calls all callbacks of one animation frame in its traces. */
const ALL_CALLBACKS = "PageAnimator::serviceScriptedAnimations";

export interface Tree {
  readonly metamers: number;
  readonly leaves: number;
}

/** Grows step by step until the tree is large enough, as the server tells a page without the client. */
export async function grow(
  blank: Page,
  browser: Browser,
  address: string,
  session: string,
  metamers: number,
): Promise<Tree> {
  let tree: Tree = { metamers: 0, leaves: 0 };
  const watcher = await browser.newPage();
  watcher.on("websocket", (socket) =>
    socket.on("framereceived", ({ payload }) => {
      const state = typeof payload === "string" ? /"metamers":(\d+).*?"leaves":(\d+)/s.exec(payload) : null;
      if (state) tree = { metamers: Number(state[1]), leaves: Number(state[2]) };
    }),
  );
  // The picture is of no use here.
  await watcher.addInitScript(() => {
    window.requestAnimationFrame = () => 0;
  });
  await watcher.goto(address);
  for (let step = 0; tree.metamers < metamers; step += 1) {
    if (step > 400) throw new Error(`the tree stopped at ${tree.metamers} metamers`);
    const before = tree.metamers;
    await perform(blank, session, ['{"kind":"grow","steps":1}']);
    await until("the step is told", () => tree.metamers > before);
  }
  await watcher.close();
  return tree;
}

/** A page that has just drawn its first tree, and times in milliseconds since the navigation. */
export interface Opening {
  readonly page: Page;
  readonly rows: number;
  /** When that tree was handed to the graphics card, and when it was drawn. */
  readonly first: number;
  readonly drawn: number;
}

export interface OpeningOptions {
  /** What the page finds in its store. */
  readonly settings?: Readonly<Record<string, string>>;
  /** What is counted as a tree, in triangles. */
  readonly aTree?: number;
  /** Called before anything is loaded. */
  readonly prepare?: (page: Page) => void;
}

export async function openMeasured(
  browser: Browser,
  address: string,
  { settings = {}, aTree = A_TREE, prepare = () => {} }: OpeningOptions = {},
): Promise<Opening> {
  const context = await browser.newContext({ viewport: SCREEN, hasTouch: true, deviceScaleFactor: 1 });
  await withClient(context);
  const page = await context.newPage();
  prepare(page);
  await page.addInitScript((settings) => Object.assign(localStorage, settings), settings);
  await page.addInitScript(instrument, { aTree, waits: false });
  await page.goto(address, { waitUntil: "commit" });
  // Asked once: a page that is asked again and again takes longer.
  const first = await inTime(
    "a tree is drawn",
    page.evaluate(() => window.firstTree),
  );
  const drawn = await done(page);
  return { page, first, drawn, rows: await page.evaluate(() => window.rowsAt) };
}

/** Waits until all that was asked of WebGL is drawn, which it says only by giving pixels back; gives the time, since the navigation. */
export async function done(page: Page): Promise<number> {
  return page.evaluate(() => {
    const gl = document.querySelector<HTMLCanvasElement>("#workspace")!.getContext("webgl2")!;
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    return performance.now();
  });
}

/** Milliseconds of the processor's time that all callbacks of each frame take while something is done, for so many frames at least. */
export async function traced(browser: Browser, least: number, act: () => Promise<unknown>): Promise<number[]> {
  const session = await browser.newBrowserCDPSession();
  const processor: number[] = [];
  session.on("Tracing.dataCollected", ({ value }) => {
    for (const event of value as readonly { name?: string; tdur?: number }[]) {
      if (event.name === ALL_CALLBACKS && event.tdur !== undefined) processor.push(event.tdur / 1000);
    }
  });
  await session.send("Tracing.start", {
    transferMode: "ReportEvents",
    traceConfig: { includedCategories: ["blink"] },
  });
  await act();
  const complete = new Promise((resolve) => session.once("Tracing.tracingComplete", resolve));
  await session.send("Tracing.end");
  await complete;
  if (processor.length < least) throw new Error("this browser does not say what frames cost");
  return processor;
}

export function quantile(values: readonly number[], share: number): number {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] ?? Number.NaN;
}
