import type { Browser, Page } from "playwright-core";
import { takeDrawingFaults } from "../src/drawing-faults";
import { Darkroom } from "../src/picture";
import type { RunningServer } from "../src/server";
import { Tablet } from "../src/tablet";
import { type Entry, query, type Shot } from "./catalogue";
import { perform } from "./performance";
import { print } from "./print";

/** How much work goes into a picture. */
export interface Care {
  /** The share of its width and height that a picture has. */
  readonly size: number;
  /** Pixels drawn for each one of the picture, along each side. */
  readonly oversampling: number;
}

/** Pictures to hang up, and those to judge a form by. */
export const FINAL: Care = { size: 1, oversampling: 1.5 };
export const DRAFT: Care = { size: 0.5, oversampling: 1 };

/** A tree to be grown: the seed of its session, and what is done there. */
export interface Play {
  readonly seed: number;
  readonly commands: readonly string[];
}

/** Bars and marks around the tree belong to whoever draws, not into a picture of it. */
const CANVAS_ALONE = `
  #app * { visibility: hidden !important }
  #app #workspace { visibility: visible !important }
`;
/** A processor that has other work as well may need long for a picture, in milliseconds. */
const PATIENCE = 240_000;
/** So long a wind blows before its picture is taken, in milliseconds. */
const BLOWN = 30000;

/** Plays sketches on a real server and takes their pictures in a real browser. */
export class Player {
  readonly #server: RunningServer;
  readonly #browser: Browser;
  readonly #darkroom: Darkroom;
  /** A page of the server without the client, for its sockets and its canvas. */
  readonly blank: Page;
  readonly #care: Care;

  private constructor(server: RunningServer, browser: Browser, darkroom: Darkroom, blank: Page, care: Care) {
    this.#server = server;
    this.#browser = browser;
    this.#darkroom = darkroom;
    this.blank = blank;
    this.#care = care;
  }

  static async open(server: RunningServer, browser: Browser, care: Care): Promise<Player> {
    const blank = await browser.newPage();
    await blank.goto(`${server.address}/health`);
    return new Player(server, browser, await Darkroom.open(browser), blank, care);
  }

  /** Plays the commands of an entry's trees, each in a session of its own, and gives their picture as JPEG. */
  async play(entry: Pick<Entry, "shot" | "undone" | "afterwards" | "beside">, trees: readonly Play[]): Promise<Buffer> {
    const pictures: Buffer[] = [];
    for (const { seed, commands } of trees) {
      const address = await this.#server.newSession(seed);
      await perform(this.blank, sessionAt(address), commands);
      pictures.push(...(await this.#pictures(address, entry)));
    }
    return print(this.blank, pictures, ...this.#sizeOf(entry.shot), entry.beside?.row);
  }

  /** Takes the picture of the session at an address as JPEG. */
  async photograph(address: string, entry: Pick<Entry, "shot" | "undone" | "afterwards">): Promise<Buffer> {
    return print(this.blank, await this.#pictures(address, entry), ...this.#sizeOf(entry.shot));
  }

  #sizeOf({ width, height }: Shot): [width: number, height: number] {
    const { size } = this.#care;
    return [Math.round(width * size), Math.round(height * size)];
  }

  /** What a session's page shows, before and after what is undone. */
  async #pictures(
    address: string,
    { shot, undone = 0, afterwards = [] }: Pick<Entry, "shot" | "undone" | "afterwards">,
  ): Promise<Buffer[]> {
    const [width, height] = this.#sizeOf(shot);
    const screen = { width, height, detail: this.#care.oversampling, watched: true };
    const tablet = await Tablet.open(this.#browser, this.#darkroom, address + query(shot), screen);
    try {
      tablet.page.setDefaultTimeout(PATIENCE);
      await tablet.untilQuiet();
      await tablet.page.addStyleTag({ content: CANVAS_ALONE });
      if (afterwards.length > 0) {
        await atRest(tablet.page);
        const commands = afterwards.map((command) => JSON.stringify(command));
        await perform(this.blank, sessionAt(address), commands);
        // The wind has come, and is held where it is: a picture that moves is never finished.
        await tablet.page.waitForSelector("canvas:not([data-still])", { state: "attached" });
        await tablet.page.waitForTimeout(BLOWN);
        await tablet.page.keyboard.press("a");
      }
      const pictures = [await atRest(tablet.page)];
      if (undone > 0) {
        // The camera stays where it is: the two can be compared.
        await perform(this.blank, sessionAt(address), Array(undone).fill('{"kind":"undo"}'));
        await tablet.untilQuiet();
        pictures.unshift(await atRest(tablet.page));
      }
      const faults = [...tablet.errors, ...takeDrawingFaults()];
      if (faults.length > 0) throw new Error(faults.join("; "));
      return pictures;
    } finally {
      await tablet.close();
    }
  }
}

function sessionAt(address: string): string {
  return address.slice(address.lastIndexOf("/") + 1);
}

/** What a page shows once its picture is finished. */
async function atRest(page: Page): Promise<Buffer> {
  // What has just come is part of the picture within two frames, which is no longer finished then.
  await page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(null)))),
  );
  await page.waitForSelector("canvas[data-still]", { state: "attached" });
  return page.screenshot();
}
