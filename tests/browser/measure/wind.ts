import { readFile } from "node:fs/promises";
import { cpus, loadavg } from "node:os";
import type { Browser, Page } from "playwright-core";
import { perform } from "../gallery/performance";
import { launchBrowser } from "../src/browser";
import { Server, until } from "../src/server";
import { grow, openMeasured, quantile, traced } from "./pages";

/** Metamers of the trees that goals are for. */
const SIZES = [10_000, 100_000];
/** Steps after which Barron's binary tree has 255 branches, and more than the 10,000 that Quigley and others move. */
const DEPTHS = [8, 14];
const BINARY = new URL("../../../server/grammar/grammars/barron-binary.lsys", import.meta.url);
/** Frames whose script is timed, after some in which everything is used for the first time. */
const FRAMES = 600;
const WARMING = 60;
/** So long what travels is counted, in milliseconds. */
const COUNTED = 10_000;
/** How often the wind is switched on. */
const ROUNDS = 5;
/** Softer and harder wood, for each of which joints are made anew. */
const SUPPLENESSES = [1.1, 1.2, 1.3, 1.4, 1];
/** What is drawn by the processor is counted for so long, after it has had so long to choose how finely, in milliseconds. */
const DRAWN = 20_000;
const SETTLING = 10_000;
/** A tree of few branches has few triangles. */
const A_SMALL_TREE = 500;
/** What a page may do for it, so that it is seen to be idle, in milliseconds. */
const IDLE = 5000;

const COLUMNS = [
  "tree",
  "script a frame, median, ms",
  "99 %",
  "first sway, ms",
  "joints made anew, ms",
  "bytes received and sent in 10 s, but for pings",
  "what would break, ms",
  "longest task of the page meanwhile",
  "frames a second, drawn by the processor",
];

interface Wood {
  readonly name: string;
  readonly session: string;
  readonly address: string;
}

/** Has trees sway in a wind of 8 m/s, and prints what that costs the page and the wire. */
export async function measureWind(): Promise<void> {
  const server = new Server();
  const browser = await launchBrowser();
  try {
    await server.start();
    const blank = await browser.newPage();
    await blank.goto(`${server.address}/health`);
    console.log(
      `${cpus()[0]?.model ?? "an unknown processor"}, ${cpus().length} cores, load ${loadavg()[0]!.toFixed(1)}\n`,
    );
    if (process.env.ESPALIER_CLIENT) console.log("Files that pass through this process come seconds late.\n");
    console.log(`| ${COLUMNS.join(" | ")} |`);
    console.log(`${"|---".repeat(COLUMNS.length)}|`);
    for (const depth of DEPTHS) await print(browser, blank, await binary(server, blank, depth));
    for (const metamers of SIZES) await print(browser, blank, await grown(server, browser, blank, metamers));
  } finally {
    await browser.close();
    await server.stop();
  }
}

async function binary(server: Server, blank: Page, depth: number): Promise<Wood> {
  const wood = await fresh(server);
  const text = await readFile(BINARY, "utf8");
  await perform(blank, wood.session, [
    JSON.stringify({ kind: "set_grammar", text, position: [0, 0, 0], depth: Math.min(depth, 8) }),
    ...Array.from({ length: Math.max(0, depth - 8) }, () => JSON.stringify({ kind: "derive", steps: 1 })),
  ]);
  return { ...wood, name: `Barron's binary tree, ${2 ** depth - 1} branches` };
}

async function grown(server: Server, browser: Browser, blank: Page, least: number): Promise<Wood> {
  const wood = await fresh(server);
  const { metamers, leaves } = await grow(blank, browser, wood.address, wood.session, least);
  return { ...wood, name: `${metamers} metamers, ${leaves} leaves` };
}

async function fresh(server: Server): Promise<Omit<Wood, "name">> {
  const address = await server.newSession(5);
  return { address, session: address.slice(address.lastIndexOf("/") + 1) };
}

async function print(browser: Browser, blank: Page, { name, address, session }: Wood): Promise<void> {
  const wire = { bytes: 0 };
  const { page } = await openMeasured(browser, address, {
    aTree: A_SMALL_TREE,
    prepare: (page) => countWire(page, wire),
  });
  await page.waitForSelector("canvas[data-still]", { state: "attached", timeout: 150_000 });
  await page.evaluate(() => {
    window.blind = true;
    // Where nothing is drawn nothing tells the graphics card to begin, and the page would wait for it before each frame.
    const gl = document.querySelector<HTMLCanvasElement>("#workspace")!.getContext("webgl2")!;
    setInterval(() => gl.flush(), 4);
  });
  await page.getByLabel("Wind", { exact: true }).first().tap();
  const presets = page.getByRole("group", { name: "How strong the wind is" });
  await presets.waitFor();
  await page.waitForTimeout(IDLE);
  const firsts: number[] = [];
  for (let round = 0; round < ROUNDS; round += 1) {
    firsts.push(await firstSway(page));
    await presets.getByRole("button", { name: "Calm", exact: true }).tap();
    await stands(page);
  }
  await presets.getByRole("button", { name: "Wind", exact: true }).tap();
  await framesDrawn(page, WARMING);
  const script = await traced(browser, FRAMES, () => framesDrawn(page, FRAMES));
  wire.bytes = 0;
  await page.waitForTimeout(COUNTED);
  const { bytes } = wire;
  const strain = await whatBreaks(page);
  const joints = await jointsAnew(page, blank, session);
  const drawn = await framesASecond(page);
  const figures = [
    name,
    quantile(script, 0.5).toFixed(2),
    quantile(script, 0.99).toFixed(2),
    quantile(firsts, 0.5).toFixed(0),
    quantile(joints, 0.5).toFixed(0),
    bytes,
    strain.took.toFixed(0),
    strain.longest === 0 ? "under 50" : strain.longest.toFixed(0),
    drawn.toFixed(1),
  ];
  console.log(`| ${figures.join(" | ")} |`);
  await page.context().close();
  // The next tree has the server for itself.
  await perform(blank, session, ['{"kind":"set_appearance","appearance":{"wind":{"speed":0}}}']);
}

/** Milliseconds from a finger on the preset until rows are drawn elsewhere than they grew: in its second frame, for the first is all calm. */
async function firstSway(page: Page): Promise<number> {
  const preset = page
    .getByRole("group", { name: "How strong the wind is" })
    .getByRole("button", { name: "Wind", exact: true });
  return preset.evaluate(
    (button: HTMLElement) =>
      new Promise<number>((resolve) => {
        window.swayed.length = 0;
        const began = performance.now();
        button.click();
        const look = () => {
          const second = window.swayed[1];
          if (second === undefined) requestAnimationFrame(look);
          else resolve(second - began);
        };
        look();
      }),
  );
}

/** Waits until nothing sways any more. */
async function stands(page: Page): Promise<void> {
  let before = -1;
  await until("the wind has died away", async () => {
    const now = await page.evaluate(() => window.swayed.length);
    const still = now === before;
    before = now;
    await page.waitForTimeout(still ? 0 : 600);
    return still;
  });
}

/** Waits until so many more frames of rows that sway were drawn. */
async function framesDrawn(page: Page, enough: number): Promise<void> {
  await page.evaluate(
    (enough) =>
      new Promise<void>((resolve) => {
        window.swayed.length = 0;
        const look = () => (window.swayed.length >= enough ? resolve() : setTimeout(look, 100));
        look();
      }),
    enough,
  );
}

/** Has the page show what would break: milliseconds until it says so, and of its longest task meanwhile, 0 where none took 50. */
async function whatBreaks(page: Page): Promise<{ took: number; longest: number }> {
  const control = page.getByLabel("Show what would break", { exact: true });
  return control.evaluate(
    (control: HTMLElement) =>
      new Promise<{ took: number; longest: number }>((resolve) => {
        let longest = 0;
        const watcher = new PerformanceObserver((list) => {
          for (const { duration } of list.getEntries()) longest = Math.max(longest, duration);
        });
        watcher.observe({ type: "longtask" });
        const began = performance.now();
        control.click();
        const look = () => {
          const said = [...document.querySelectorAll("[role=status]")].some(({ textContent }) =>
            /break|stands/.test(textContent ?? ""),
          );
          const took = performance.now() - began;
          if (!said) setTimeout(look, 5);
          else setTimeout(() => resolve({ took, longest }), 200);
        };
        look();
      }),
  );
}

/** Makes the wood softer or harder for all: how long it takes each time until joints are there. */
async function jointsAnew(page: Page, blank: Page, session: string): Promise<number[]> {
  await page.evaluate(() => {
    window.joints.length = 0;
  });
  for (const [times, suppleness] of SUPPLENESSES.entries()) {
    await perform(blank, session, [JSON.stringify({ kind: "set_appearance", appearance: { wind: { suppleness } } })]);
    await until("joints are made anew", () => page.evaluate((times) => window.joints.length > times, times));
  }
  return page.evaluate(() => window.joints);
}

/** How many frames of rows that sway are drawn in a second where nothing is left out. */
async function framesASecond(page: Page): Promise<number> {
  await page.evaluate(() => {
    window.blind = false;
  });
  await page.waitForTimeout(SETTLING);
  return page.evaluate(
    (lasts) =>
      new Promise<number>((resolve) => {
        window.swayed.length = 0;
        const began = performance.now();
        setTimeout(() => resolve((1000 * window.swayed.length) / (performance.now() - began)), lasts);
      }),
    DRAWN,
  );
}

/** Counts the bytes of all messages but pings and their answers. */
function countWire(page: Page, wire: { bytes: number }): void {
  const count = ({ payload }: { payload: string | Buffer }) => {
    if (typeof payload === "string" && /"type":"p[io]ng"/.test(payload)) return;
    wire.bytes += Buffer.byteLength(payload);
  };
  page.on("websocket", (socket) => {
    socket.on("framereceived", count);
    socket.on("framesent", count);
  });
}
