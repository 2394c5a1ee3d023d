import { existsSync } from "node:fs";
import { mkdir } from "node:fs/promises";
import { join } from "node:path";
import type { Browser, BrowserContext, CDPSession, Locator, Page, Route } from "playwright-core";
import { screenshots } from "./browser";
import type { Box, Darkroom, Picture } from "./picture";
import { until } from "./server";

export interface Point {
  readonly x: number;
  readonly y: number;
}

/** What the page tells about itself on `<html>`. */
export interface Facts {
  readonly connection: string;
  readonly metamers: number;
  readonly rows: number;
  readonly sent: number;
  readonly acknowledged: number;
  readonly pending: number;
  readonly step: number;
  /** The tool at hand, by the page's name for it. */
  readonly tool: string;
  /** The row of the branch that alone grows; empty if all do. */
  readonly bud: string;
  readonly obstacles: number;
  /** The present step of the line of time, and its last. */
  readonly present: number;
  readonly lastStep: number;
  /** What was done on it, in order, and how much of it is in force. */
  readonly operations: string;
  readonly done: number;
  readonly futures: number;
  /** The row that the branch begins with that is held; empty if none is. */
  readonly branch: string;
  /** How many steps the prediction beside the tree has grown; empty if there is none. */
  readonly ghost: string;
}

export interface Screen {
  readonly width: number;
  readonly height: number;
  /** Device pixels per pixel of the page. */
  readonly detail: number;
  /** Whether the picture is drawn all the time, and not only while one is taken of it: for tests of the drawing itself. */
  readonly watched?: boolean;
  /** Whether it has a mouse and no touch. */
  readonly mouse?: boolean;
}

/** A tab of the panel of architecture. */
export type Tab = "Species" | "Form" | "Growth";

/** What the page calls the tools that buttons take up. */
const TOOLS = {
  Lasso: "lasso",
  "Plant a seed": "seed",
  Bend: "bend",
  Width: "width",
  Prune: "prune",
  Branch: "branch",
} as const;

export type Tool = keyof typeof TOOLS;

/** A tablet on its side, as people see it, but for its pixels: the processor draws each of them. */
export const LANDSCAPE: Screen = { width: 1194, height: 834, detail: 0.5 };
/** That tablet for tests of the drawing itself, which goes on as it does for people. */
export const WATCHED: Screen = { ...LANDSCAPE, watched: true };
/** One with still coarser ones, for tests that are not about looks. */
export const COARSE: Screen = { ...LANDSCAPE, detail: 0.4 };

/** For tests in which no picture is taken. */
export const SMALL: Screen = { width: 900, height: 640, detail: 0.2 };
export const PHONE: Screen = { width: 390, height: 844, detail: 0.6 };

/** A folder with another build of the client than the one that is part of the program; for work on the client alone. */
const client = process.env.ESPALIER_CLIENT;

/** Has the pages of a context take that build, if there is one. */
export async function withClient(context: BrowserContext): Promise<void> {
  if (client) await context.route("**/*", (route) => substitute(route, client));
}

/** Answers with the file of the folder that stands in for the one asked for, if there is one. */
async function substitute(route: Route, folder: string): Promise<void> {
  const { pathname } = new URL(route.request().url());
  const path = join(folder, pathname.startsWith("/s/") || pathname === "/" ? "index.html" : pathname);
  await (existsSync(path) ? route.fulfill({ path }) : route.continue());
}

/** The longest growth of a test ends sooner, in milliseconds, also on a machine that has much else to do. */
const PATIENCE = 150_000;
/**
 * So long the browser may take to answer a touch, in milliseconds. It now and then leaves one unanswered that another
 * follows at once; what has come of it, the page tells.
 */
const TOUCHED = 10_000;
/** And so long two frames. */
const FRAMES = 5000;
/** `ALBUM=1` takes pictures as well of which no test asks anything, for people to look at. */
const ALBUM = process.env.ALBUM === "1";
/** The page's picture. */
const CANVAS = "#workspace";
/** The attribute by which the page knows that nobody looks at it. */
const UNSEEN = "data-unseen";
/** The canvas once its picture is at rest. */
const STILL = "canvas[data-still]";
/** A finger that has gone so far, in pixels, is no longer where it came down. */
const LEAVES = 12;

/** One tablet with the page open: real touch points in, screenshots out. */
export class Tablet {
  readonly page: Page;
  /** What the page wrote to its console as an error. */
  readonly errors: string[] = [];
  readonly #context: BrowserContext;
  readonly #touch: CDPSession;
  readonly #darkroom: Darkroom;
  readonly #screen: Screen;

  private constructor(context: BrowserContext, page: Page, touch: CDPSession, darkroom: Darkroom, screen: Screen) {
    this.#context = context;
    this.page = page;
    this.#touch = touch;
    this.#darkroom = darkroom;
    this.#screen = screen;
    page.on("pageerror", (error) => this.errors.push(String(error)));
  }

  static async open(browser: Browser, darkroom: Darkroom, address: string, screen = COARSE): Promise<Tablet> {
    const { width, height, detail, watched = false, mouse = false } = screen;
    const viewport = { width, height };
    const context = await browser.newContext({
      viewport,
      hasTouch: !mouse,
      isMobile: !mouse,
      deviceScaleFactor: detail,
    });
    // Who tests knows the gestures; a test of the tour says otherwise and loads the page again.
    await context.addInitScript(() => {
      if (localStorage.getItem("espalier.tour") === null) localStorage.setItem("espalier.tour", "true");
      // And that the processor draws.
      if (localStorage.getItem("espalier.slowness-read") === null)
        localStorage.setItem("espalier.slowness-read", "true");
    });
    if (!watched) await context.addInitScript(lookAway, { canvas: CANVAS, unseen: UNSEEN });
    await withClient(context);
    const page = await context.newPage();
    const tablet = new Tablet(context, page, await context.newCDPSession(page), darkroom, screen);
    await page.goto(address);
    await tablet.untilReady();
    return tablet;
  }

  /** Whether it is used with fingers, and not with a mouse. */
  get touches(): boolean {
    return this.#screen.mouse !== true;
  }

  async close(): Promise<void> {
    await this.#context.close();
  }

  async facts(): Promise<Facts> {
    return this.page.evaluate(() => {
      const facts = document.documentElement.dataset;
      const number = (name: string) => Number(facts[name] ?? -1);
      return {
        connection: facts.connection ?? "",
        metamers: number("metamers"),
        rows: number("rows"),
        sent: number("sent"),
        acknowledged: number("acknowledged"),
        pending: number("pending"),
        step: number("step"),
        tool: facts.tool ?? "",
        bud: facts.bud ?? "",
        obstacles: number("obstacles"),
        present: number("present"),
        lastStep: number("lastStep"),
        operations: facts.operations ?? "",
        done: number("done"),
        futures: number("futures"),
        branch: facts.branch ?? "",
        ghost: facts.ghost ?? "",
      };
    });
  }

  async until(what: string, check: (facts: Facts) => boolean, limit?: number): Promise<Facts> {
    let facts = await this.facts();
    const holds = async () => {
      facts = await this.facts();
      return check(facts);
    };
    await until(what, holds, limit).catch((error) => {
      throw new Error(`${error}; the page says ${JSON.stringify(facts)}`);
    });
    return facts;
  }

  /** Connected, and rows are there: at least the seed. */
  async untilReady(): Promise<Facts> {
    return this.until("the page connects", (facts) => facts.connection === "connected" && facts.rows > 0);
  }

  /** All commands are durable, all growth is done. */
  async untilQuiet(): Promise<Facts> {
    // A command is acknowledged before the figures tell of it, so quiet must last to count.
    for (const end = Date.now() + PATIENCE; ; ) {
      const facts = await this.until(
        "the growth ends",
        (facts) => facts.connection === "connected" && facts.sent === facts.acknowledged && facts.pending === 0,
        PATIENCE,
      );
      await this.page.waitForTimeout(400);
      const later = await this.facts();
      const [before, after] = [JSON.stringify(facts), JSON.stringify(later)];
      if (before === after) return later;
      if (Date.now() > end) throw new Error(`the page does not come to rest: ${before}, then ${after}`);
    }
  }

  /** Moves as many fingers as there are paths, from each path's begin to its end; all touch down and lift together. */
  async swipe(paths: readonly (readonly Point[])[], pause = 16): Promise<void> {
    await this.lead(paths, pause);
    await this.page.waitForTimeout(pause);
    await this.touch("touchEnd", []);
  }

  /** The same, but they stay down. */
  async lead(paths: readonly (readonly Point[])[], pause = 16): Promise<void> {
    const steps = Math.max(...paths.map((path) => path.length));
    const fingers = (step: number) => paths.map((path) => path[Math.min(step, path.length - 1)]!);
    const away = Array.from({ length: steps }, (_, step) => step).find((step) =>
      fingers(step).some(({ x, y }, i) => Math.hypot(x - paths[i]![0]!.x, y - paths[i]![0]!.y) > LEAVES),
    );
    const leaving = away ?? steps - 1;
    // A finger that the machine keeps waiting where it came down would not draw but hold what is there.
    await this.inNoTime(async () => {
      await this.touch("touchStart", fingers(0));
      for (let step = 1; step <= leaving; step++) await this.touch("touchMove", fingers(step));
    });
    for (let step = leaving + 1; step < steps; step++) {
      await this.page.waitForTimeout(pause);
      await this.touch("touchMove", fingers(step));
    }
  }

  /** One finger that taps on a place, however long the page takes to answer. */
  async tapAt(place: Point): Promise<void> {
    await this.inNoTime(() => this.#tapped(place));
  }

  /** One finger that taps on a place twice. */
  async doubleTap({ x, y }: Point): Promise<void> {
    await this.inNoTime(async () => {
      await this.#tapped({ x, y });
      await this.#tapped({ x: x + 3, y: y - 2 });
    });
  }

  /** One finger that is held still on a place until something has come of it. */
  async hold(place: Point, what: string, check: (facts: Facts) => boolean): Promise<Facts> {
    await this.touch("touchStart", [place]);
    const facts = await this.until(what, check);
    await this.touch("touchEnd", []);
    return facts;
  }

  async #tapped(place: Point): Promise<void> {
    await this.touch("touchStart", [place]);
    await this.touch("touchEnd", []);
  }

  /** Does something while the page's clock stands, which tells taps from holds: no machine is too slow for a tap then. */
  async inNoTime(act: () => Promise<void>): Promise<void> {
    await this.page.evaluate(() => {
      const now = performance.now();
      performance.now = () => now;
    });
    try {
      await act();
    } finally {
      await this.page.evaluate(() => Reflect.deleteProperty(performance, "now"));
    }
  }

  /** One real touch event with all fingers that are down. */
  async touch(type: "touchStart" | "touchMove" | "touchEnd", fingers: readonly Point[]): Promise<void> {
    const touchPoints = fingers.map(({ x, y }, id) => ({ x, y, id, radiusX: 8, radiusY: 8, force: 0.5 }));
    const answer = this.#touch.send("Input.dispatchTouchEvent", { type, touchPoints });
    await atMost(TOUCHED, answer);
  }

  /** Two frames of the page's; one that draws nothing is not waited for. */
  async frames(): Promise<void> {
    const drawn = this.page.evaluate(
      () => new Promise<void>((done) => requestAnimationFrame(() => requestAnimationFrame(() => done()))),
    );
    await atMost(FRAMES, drawn);
  }

  /** One event of a pen on the glass. */
  async pen(type: "mousePressed" | "mouseMoved" | "mouseReleased", { x, y }: Point): Promise<void> {
    const down = type === "mouseReleased" ? 0 : 1;
    await this.#touch.send("Input.dispatchMouseEvent", {
      type,
      x,
      y,
      button: "left",
      buttons: down,
      clickCount: 1,
      force: 0.5 * down,
      pointerType: "pen",
    });
  }

  /** A pen drawn along a way. */
  async draw(path: readonly Point[], pause = 16): Promise<void> {
    for (const [i, point] of path.entries()) {
      await this.pen(i === 0 ? "mousePressed" : "mouseMoved", point);
      await this.page.waitForTimeout(pause);
    }
    await this.pen("mouseReleased", path[path.length - 1]!);
  }

  async tap(label: string): Promise<void> {
    await this.page.getByLabel(label, { exact: true }).first().tap();
  }

  /** Takes up a tool by what its button is called. */
  async take(button: Tool): Promise<void> {
    await this.tap(button);
    await this.until(`“${button}” is at hand`, ({ tool }) => tool === TOOLS[button]);
  }

  /** What is on the screen this moment, at rest or not: while the server is silent something always moves. */
  async glimpse(name: string): Promise<Picture> {
    return this.#looking(async () => {
      await this.frames();
      return this.#taken(name);
    });
  }

  /** What is on the screen once it is at rest; kept under a name. */
  async photograph(name: string): Promise<Picture> {
    // Of what moves until then nothing is drawn.
    await this.untilStill();
    return this.#looking(async () => {
      await this.untilStill();
      return this.#taken(name);
    });
  }

  /** A picture at rest for people to look at, of which the test asks nothing; it waits for it even where none is taken. */
  async show(name: string): Promise<void> {
    await this.untilStill();
    if (ALBUM) await this.photograph(name);
  }

  /** The same of a moment within a movement. */
  async showNow(name: string): Promise<void> {
    if (ALBUM) await this.glimpse(name);
  }

  async #taken(name: string): Promise<Picture> {
    await mkdir(screenshots, { recursive: true });
    const path = join(screenshots, `${name}.png`);
    const taken = await this.page.screenshot({ path, animations: "disabled" });
    return this.#darkroom.develop(taken, this.#screen.detail);
  }

  /** Does something while the picture is drawn; else nobody looks at it. */
  async #looking<Result>(act: () => Promise<Result>): Promise<Result> {
    if (this.#screen.watched) return act();
    const canvas = this.page.locator(CANVAS);
    await canvas.evaluate((canvas, unseen) => canvas.removeAttribute(unseen), UNSEEN);
    try {
      return await act();
    } finally {
      await canvas.evaluate((canvas, unseen) => canvas.setAttribute(unseen, ""), UNSEEN);
    }
  }

  /** Shows one of the tabs of the panel of architecture, with all that is on it. */
  async turnTo(tab: Tab): Promise<void> {
    await this.page.getByRole("tab", { name: tab }).click();
    await this.page.getByRole("tab", { name: tab, selected: true }).waitFor();
  }

  /** The picture is at rest: nothing in it moves, nor does the view, nor what stands beside it. */
  async untilStill(): Promise<void> {
    const still = async () => {
      // What was touched last is seen by the picture within two frames, and is part of its movement from then on.
      await this.frames();
      await this.page.waitForSelector(STILL, { state: "attached", timeout: PATIENCE });
      await this.untilSettled();
      // What has settled beside it may have changed its size.
      return (await this.page.locator(STILL).count()) > 0;
    };
    await until("the picture comes to rest", still, PATIENCE);
  }

  /** Where something of the page is, once it stays there. */
  async boxOf(place: Locator): Promise<Box> {
    await this.untilSettled();
    const box = await place.boundingBox();
    if (!box) throw new Error(`${place} is not on the page`);
    return box;
  }

  /** Bars and panels stand where they will: what slides in has come, and nothing of the page changes any more. */
  async untilSettled(): Promise<void> {
    let before = "";
    await until("the page comes to rest", async () => {
      await this.untilCome();
      const now = await this.page.evaluate(() => document.body.outerHTML);
      const settled = now === before;
      before = now;
      return settled;
    });
  }

  /** What slides or fades in has come; what it says may go on changing. */
  async untilCome(): Promise<void> {
    await until("all that slides in has come", async () => {
      await this.frames();
      return this.page.evaluate(
        () =>
          // A part that is being loaded has not come.
          document.querySelector('[aria-busy="true"]') === null &&
          document.getAnimations().every(({ effect, playState }) => {
            return playState !== "running" || effect?.getComputedTiming().endTime === Number.POSITIVE_INFINITY;
          }),
      );
    });
  }

  /** Notes from now on what comes, if only for a moment: what this gives waits until it has, and says its text. */
  async watchFor(selector: string): Promise<() => Promise<string>> {
    const noted = await this.page.evaluateHandle((selector) => {
      const noted: { text: string | null } = { text: null };
      const watcher = new MutationObserver(() => {
        const found = document.querySelector(selector);
        if (found === null) return;
        noted.text = found.textContent ?? "";
        watcher.disconnect();
      });
      watcher.observe(document, { subtree: true, childList: true, attributes: true });
      return noted;
    }, selector);
    return async () => {
      let text: string | null = null;
      await until(`${selector} comes`, async () => {
        text = await noted.evaluate((noted) => noted.text);
        return text !== null;
      });
      return text ?? "";
    };
  }
}

/** Has the page's picture not drawn from when there is one. */
function lookAway({ canvas, unseen }: { canvas: string; unseen: string }): void {
  const watcher = new MutationObserver(() => {
    const found = document.querySelector(canvas);
    if (found === null) return;
    found.setAttribute(unseen, "");
    watcher.disconnect();
  });
  watcher.observe(document, { subtree: true, childList: true });
}

/** Waits for an answer, for so many milliseconds at most. */
async function atMost(limit: number, answer: Promise<unknown>): Promise<void> {
  let timer: NodeJS.Timeout | undefined;
  const enough = new Promise<void>((resolve) => {
    timer = setTimeout(resolve, limit);
  });
  await Promise.race([answer, enough]).finally(() => clearTimeout(timer));
}

export function middle({ x, y, width, height }: Box): Point {
  return { x: x + width / 2, y: y + height / 2 };
}

/** Points on a straight way, ends included. */
export function way(from: Point, to: Point, count = 24): Point[] {
  return Array.from({ length: count }, (_, i) => {
    const t = i / (count - 1);
    return { x: from.x + (to.x - from.x) * t, y: from.y + (to.y - from.y) * t };
  });
}

/** Points on a closed way around a middle, the first not repeated. */
export function loop(middle: Point, radii: Point, count = 40): Point[] {
  return Array.from({ length: count }, (_, i) => {
    const turn = (2 * Math.PI * i) / count;
    return { x: middle.x + radii.x * Math.sin(turn), y: middle.y + radii.y * Math.cos(turn) };
  });
}
