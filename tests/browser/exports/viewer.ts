import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import type { Browser } from "playwright-core";
import { build } from "vite";
import { FINAL } from "../gallery/player";
import type { Shot } from "./shot";

/** What three.js found in a file. */
export interface Found {
  /** The program that the file says it is from, where three.js reads that. */
  readonly generator: string | null;
  /** Of the plants. */
  readonly names: readonly string[];
  readonly meshes: number;
  /** Those that are drawn, each instance's own. */
  readonly triangles: number;
  /** Those of wood. */
  readonly wood: number;
  /** Places of meshes that are shown many times. */
  readonly instances: number;
  readonly points: number;
  readonly textures: number;
  /** Of one plant. */
  readonly bones: number;
  /** Those of its loop of sway; 0 where it has none. */
  readonly seconds: number;
  /** The least and the most of all vertices along each axis, in metres. */
  readonly box: readonly [readonly number[], readonly number[]];
  /** A texture of 16-bit floats beside it, four to a texel, rows from below. */
  readonly floats: { readonly width: number; readonly height: number; readonly bits: readonly number[] } | null;
}

/** What three.js made of a file. */
export interface Seen {
  readonly found: Found;
  readonly picture: Buffer;
  /** The same picture without all that is not wood, where that is asked for. */
  readonly wood: Buffer | null;
}

/** What is asked for besides a picture. */
export interface Wish {
  /** How far it has come in its loop of sway, in seconds; without it stands as it grew. */
  readonly time?: number;
  readonly wood?: boolean;
}

/** Pixels drawn for each one of the picture, along each side, as for those of the page. */
const DETAIL = FINAL.oversampling;

/** A processor that has other work as well may need long for a picture, in milliseconds. */
const PATIENCE = 240_000;

/** The client's own copy of three.js. */
const three = dirname(
  dirname(createRequire(join(import.meta.dirname, "../../../client/package.json")).resolve("three")),
);

/** A file of the program, in the format of its ending. */
export interface Exported {
  readonly ending: string;
  readonly bytes: Buffer;
}

/** Loads files with three.js and takes pictures of them. */
export class Viewer {
  private constructor(
    private readonly browser: Browser,
    private readonly script: string,
  ) {}

  static async open(browser: Browser): Promise<Viewer> {
    const built = await build({
      configFile: false,
      logLevel: "warn",
      resolve: { alias: { three } },
      build: {
        write: false,
        minify: false,
        lib: { entry: join(import.meta.dirname, "page.js"), formats: ["iife"], name: "viewer" },
      },
    });
    const [bundle] = Array.isArray(built) ? built : [built];
    const chunk = bundle && "output" in bundle ? bundle.output[0] : null;
    if (!chunk) throw new Error("the viewer was not built");
    return new Viewer(browser, chunk.code);
  }

  async see(
    { ending, bytes }: Exported,
    width: number,
    height: number,
    shot: Shot,
    { time, wood = false }: Wish = {},
  ): Promise<Seen> {
    const page = await this.browser.newPage({ viewport: { width, height }, deviceScaleFactor: DETAIL });
    try {
      page.setDefaultTimeout(PATIENCE);
      const address = "http://viewer.test/";
      await page.route(`${address}**`, (route) =>
        route.request().url().endsWith(`.${ending}`)
          ? route.fulfill({ body: bytes, contentType: "application/octet-stream" })
          : route.fulfill({ body: "<!doctype html><body style='margin:0'></body>", contentType: "text/html" }),
      );
      await page.goto(address);
      await page.addScriptTag({ content: this.script });
      const found = (await page.evaluate(`show("/tree.${ending}", ${JSON.stringify(shot)}, ${time ?? null})`)) as Found;
      const picture = await page.screenshot();
      if (!wood) return { found, picture, wood: null };
      await page.evaluate("showWood()");
      return { found, picture, wood: await page.screenshot() };
    } finally {
      await page.close();
    }
  }
}
