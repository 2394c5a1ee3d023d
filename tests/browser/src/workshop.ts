import type { Browser } from "playwright-core";
import { afterAll, afterEach, beforeAll, expect } from "vitest";
import { perform } from "../gallery/performance";
import { Darkroom } from "./picture";
import type { Screen } from "./screens";
import { type RunningServer, Server } from "./server";
import { theBrowser, theServer } from "./shared";
import { Tablet } from "./tablet";
import { type Point, way } from "./ways";

/** A place so many pixels to the right of the seedling and above it on a tablet on its side; nearer on narrow glass. */
export type Place = (right: number, up: number) => Point;

/** Where the first seed stands in a fresh view on a tablet on its side. */
export const SEED: Point = { x: 597, y: 750 };

/** A tablet with a session of its own. */
export interface Opened {
  readonly tablet: Tablet;
  readonly address: string;
}

/** One on which something has grown. */
export interface Grown extends Opened {
  readonly metamers: number;
}

/** One with a slender stem, and places about it. */
export interface Stem extends Grown {
  readonly at: Place;
}

/** So far a place about the seedling lies at most from it to the side, in pixels. */
const ASIDE = 320;

/** The session that a tablet is in. */
export function sessionOf({ page }: Tablet): string {
  return new URL(page.url()).pathname.split("/").at(-1)!;
}

function inJson(commands: readonly object[]): string[] {
  return commands.map((command) => JSON.stringify(command));
}

/** Where the seedling stands on the glass. */
export async function seedling(tablet: Tablet): Promise<Point> {
  const { x, y, width, height } = await tablet.boxOf(tablet.page.locator(".seedling").first());
  return { x: x + width / 2, y: y + 0.9 * height };
}

/** A server, a browser and tablets for the tests of one file. */
export class Workshop<At extends RunningServer = RunningServer> {
  #browser: Browser | null = null;
  #darkroom: Darkroom | null = null;
  #tablets: Tablet[] = [];

  private constructor(readonly server: At) {}

  /** Has everything ready before the file's tests, and each test end with its tablets closed and without errors. */
  static forThisFile(): Workshop {
    return Workshop.#at(theServer());
  }

  /** The same with a server of the file's own, for tests that stop it, or that want its library for themselves. */
  static withItsOwnServer(options: readonly string[] = []): Workshop<Server> {
    const server = new Server(options);
    beforeAll(() => server.start());
    afterAll(() => server.stop());
    const workshop = Workshop.#at(server);
    // A test that failed may have left it silent.
    afterEach(() => server.resume());
    return workshop;
  }

  static #at<At extends RunningServer>(server: At): Workshop<At> {
    const workshop = new Workshop(server);
    beforeAll(() => workshop.#start());
    afterEach(() => workshop.#clear());
    afterAll(() => workshop.#stop());
    return workshop;
  }

  /** Unpacks and packs pictures. */
  get darkroom(): Darkroom {
    if (!this.#darkroom) throw new Error("the browser has not been started");
    return this.#darkroom;
  }

  /** Has a page without the client do commands in the session at an address. */
  act(address: string, commands: readonly object[]): Promise<void> {
    return this.#act(address, commands, "done");
  }

  /** Has one begin them: what they ask for may still be growing. */
  begin(address: string, commands: readonly object[]): Promise<void> {
    return this.#act(address, commands, "acknowledged");
  }

  async #act(address: string, commands: readonly object[], awaited: "done" | "acknowledged"): Promise<void> {
    if (!this.#browser) throw new Error("the browser has not been started");
    const page = await this.#browser.newPage();
    await page.goto(`${this.server.address}/health`);
    await perform(page, address.slice(address.lastIndexOf("/") + 1), inJson(commands), awaited);
    await page.close();
  }

  /**
   * Has whoever is at a tablet do commands in its session, from a page that draws nothing: while one draws, its hello
   * may come too late (`HS1`).
   */
  async actAs(tablet: Tablet, commands: readonly object[]): Promise<void> {
    const page = await tablet.page.context().newPage();
    await page.goto(`${this.server.address}/health`);
    await perform(page, sessionOf(tablet), inJson(commands));
    await page.close();
  }

  /** Another tablet with the page at an address. */
  async open(address: string, screen?: Screen): Promise<Tablet> {
    if (!this.#browser || !this.#darkroom) throw new Error("the browser has not been started");
    const tablet = await Tablet.open(this.#browser, this.#darkroom, address, screen);
    this.#tablets.push(tablet);
    return tablet;
  }

  /** A tablet with nothing but a seed. */
  async fresh(screen?: Screen): Promise<Opened> {
    const address = await this.server.newSession(5);
    return { tablet: await this.open(address, screen), address };
  }

  /** One on which a tree was drawn with the brush as it is. */
  async drawn(screen?: Screen): Promise<Grown> {
    const { tablet, address } = await this.fresh(screen);
    await tablet.swipe([way(SEED, { x: SEED.x, y: 330 })]);
    const { metamers } = await tablet.untilQuiet();
    expect(metamers).toBeGreaterThan(20);
    return { tablet, address, metamers };
  }

  /** One on which a slender stem was sketched 350 pixels high, so that places on it can be found again. */
  async stem(screen?: Screen): Promise<Stem> {
    const { tablet, address } = await this.fresh(screen);
    await tablet.page.getByLabel("Brush radius", { exact: true }).focus();
    await tablet.page.keyboard.press("Home");
    const seed = await seedling(tablet);
    const scale = Math.min(1, seed.x / ASIDE);
    const at: Place = (right, up) => ({ x: seed.x + scale * right, y: seed.y - scale * up });
    await tablet.swipe([way(at(0, 0), at(0, 350))]);
    const { metamers } = await tablet.untilQuiet();
    expect(metamers).toBeGreaterThan(5);
    return { tablet, address, metamers, at };
  }

  async #start(): Promise<void> {
    this.#browser = await theBrowser();
    this.#darkroom = await Darkroom.open(this.#browser);
  }

  async #clear(): Promise<void> {
    const errors = this.#tablets.flatMap((tablet) => tablet.errors);
    for (const tablet of this.#tablets.splice(0)) await tablet.close();
    expect(errors).toEqual([]);
  }

  async #stop(): Promise<void> {
    await this.#browser?.close();
  }
}
