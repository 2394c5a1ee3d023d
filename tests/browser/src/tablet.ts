import { mkdir } from "node:fs/promises";
import { join } from "node:path";
import type { Browser, BrowserContext, CDPSession, Download, Locator, Page } from "playwright-core";
import { atMost } from "./at-most";
import { FRAMES, isAtRest, restAsked } from "./at-rest";
import { screenshots } from "./browser";
import { withClient } from "./client-build";
import { type Facts, factsOf } from "./facts";
import { Glass } from "./glass";
import { PATIENCE } from "./patience";
import type { Box, Darkroom, Picture } from "./picture";
import { COARSE, type Screen } from "./screens";
import { until } from "./server";
import type { Point } from "./ways";

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

/** For what may be gone before it can be pressed. */
const BRIEFLY = { timeout: 5000 };
/** What narrow glass may have no button for but in its menu. */
const FOLDING: ReadonlySet<string> = new Set([
  ...["Background", "Wind", "Structure", "Grammars", "Scene"],
  ...["Hide everything", "New tree", "Save", "Library", "Share", "Comments", "Download", "Settings", "Help"],
]);
/** `ALBUM=1` takes pictures as well of which no test asks anything, for people to look at. */
const ALBUM = process.env.ALBUM === "1";
/** The page's picture. */
const CANVAS = "#workspace";
/** The attribute by which the page knows that nobody looks at it. */
const UNSEEN = "data-unseen";
/** The canvas once its picture is at rest. */
const STILL = "canvas[data-still]";

/** One tablet with the page open: real touch points in, screenshots out. */
export class Tablet extends Glass {
  /** What the page wrote to its console as an error. */
  readonly errors: string[] = [];
  readonly #context: BrowserContext;
  readonly #darkroom: Darkroom;
  readonly #screen: Screen;

  private constructor(context: BrowserContext, page: Page, touch: CDPSession, darkroom: Darkroom, screen: Screen) {
    super(page, touch, screen.mouse !== true);
    this.#context = context;
    this.#darkroom = darkroom;
    this.#screen = screen;
    page.on("pageerror", (error) => this.errors.push(String(error)));
  }

  static async open(browser: Browser, darkroom: Darkroom, address: string, screen = COARSE): Promise<Tablet> {
    const { width, height, detail, watched = false, moves = watched, kept = false, mouse = false } = screen;
    const viewport = { width, height };
    const context = await browser.newContext({
      viewport,
      reducedMotion: moves ? "no-preference" : "reduce",
      serviceWorkers: kept ? "allow" : "block",
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
      // However long it takes: a picture is the same on every machine.
      if (localStorage.getItem("espalier.whole-picture") === null)
        localStorage.setItem("espalier.whole-picture", "true");
    });
    if (!watched) await context.addInitScript(lookAway, { canvas: CANVAS, unseen: UNSEEN });
    await withClient(context);
    const page = await context.newPage();
    const tablet = new Tablet(context, page, await context.newCDPSession(page), darkroom, screen);
    await page.goto(address);
    // An invitation leads to where it lets in.
    if (address.includes("/pair#")) await page.waitForURL(/\/s\//);
    await tablet.untilReady();
    return tablet;
  }

  async close(): Promise<void> {
    await this.#context.close();
  }

  async facts(): Promise<Facts> {
    return factsOf(this.page);
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

  /** One finger that is held still on a place until something has come of it. */
  async hold(place: Point, what: string, check: (facts: Facts) => boolean): Promise<Facts> {
    await this.touch("touchStart", [place]);
    const facts = await this.until(what, check);
    await this.touch("touchEnd", []);
    return facts;
  }

  /** Two frames of the page's; one that draws nothing is not waited for. */
  async frames(): Promise<void> {
    const drawn = this.page.evaluate(
      () => new Promise<void>((done) => requestAnimationFrame(() => requestAnimationFrame(() => done()))),
    );
    await atMost(FRAMES, drawn);
  }

  async tap(label: string): Promise<void> {
    const inMenu = this.page.locator(".tool-bar").getByRole("button", { name: label, exact: true });
    const control = this.page.getByLabel(label, { exact: true }).or(inMenu);
    await (FOLDING.has(label) ? this.pressInBar(control) : this.press(control.first()));
  }

  /** Presses a control that the bar may have folded into its menu. */
  async pressInBar(control: Locator): Promise<void> {
    const more = this.page.getByRole("button", { name: "More", exact: true, expanded: false });
    // The bar may get its room, and lose its menu, while a finger is on the way.
    await until("the control is at hand", async () => {
      if ((await control.count()) > 0) return true;
      if ((await more.count()) > 0) await (this.touches ? more.tap(BRIEFLY) : more.click(BRIEFLY)).catch(() => {});
      return false;
    });
    await this.press(control.first());
  }

  /** Presses a control with a finger, or with the mouse where there is one. */
  async press(control: Locator): Promise<void> {
    await (this.touches ? control.tap() : control.click());
  }

  /** The file that the page hands over after a control was pressed. */
  async download(control: Locator): Promise<Download> {
    const [file] = await Promise.all([this.page.waitForEvent("download"), this.press(control)]);
    return file;
  }

  /** Takes up a tool by what its button is called. */
  async take(button: Tool): Promise<void> {
    // On narrow glass the tools are folded.
    const folded = this.page.getByRole("button", { name: /^All tools/, expanded: false });
    if ((await folded.count()) > 0) await this.press(folded);
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
      await this.page.waitForSelector(STILL, { state: "attached" });
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
    await until("the page comes to rest", () => this.page.evaluate(isAtRest, restAsked("settled")));
  }

  /** What slides or fades in has come; what it says may go on changing. */
  async untilCome(): Promise<void> {
    await until("all that slides in has come", () => this.page.evaluate(isAtRest, restAsked("come")));
  }

  /** Notes from now on what comes with a text, if only for a moment: what this gives waits until it has, and says its text. */
  async watchFor(selector: string, text = ""): Promise<() => Promise<string>> {
    const watched = { selector, text };
    const noted = await this.page.evaluateHandle(({ selector, text }) => {
      const noted: { text: string | null } = { text: null };
      const watcher = new MutationObserver(() => {
        const found = [...document.querySelectorAll(selector)].find((one) => one.textContent?.includes(text));
        if (found === undefined) return;
        noted.text = found.textContent ?? "";
        watcher.disconnect();
      });
      watcher.observe(document, { subtree: true, childList: true, attributes: true });
      return noted;
    }, watched);
    return async () => {
      let seen: string | null = null;
      await until(`${selector} ${text} comes`, async () => {
        seen = await noted.evaluate((noted) => noted.text);
        return seen !== null;
      });
      return seen ?? "";
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
