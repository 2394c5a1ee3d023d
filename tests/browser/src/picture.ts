import type { Browser, Page } from "playwright-core";

/** A screenshot as pixels. */
export interface Picture {
  readonly width: number;
  readonly height: number;
  /** RGBA, row by row. */
  readonly pixels: Uint8Array;
}

/** A part of a picture, in pixels. */
export interface Box {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

/** Unpacks PNG files with a page of its own, so that no package for it is needed. */
export class Darkroom {
  readonly #page: Page;

  private constructor(page: Page) {
    this.#page = page;
  }

  static async open(browser: Browser): Promise<Darkroom> {
    return new Darkroom(await browser.newPage());
  }

  /** A screenshot as pixels of the page, however many of the device's there are to one. */
  async develop(png: Buffer, detail = 1): Promise<Picture> {
    const { width, height, base64 } = await this.#page.evaluate(
      async ({ source, detail }) => {
        const image = new Image();
        image.src = `data:image/png;base64,${source}`;
        await image.decode();
        const canvas = document.createElement("canvas");
        canvas.width = Math.round(image.width / detail);
        canvas.height = Math.round(image.height / detail);
        const context = canvas.getContext("2d", { willReadFrequently: true });
        if (!context) throw new Error("there is no 2D canvas");
        context.drawImage(image, 0, 0, canvas.width, canvas.height);
        const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
        // A few million numbers would be slow to hand over one by one.
        let text = "";
        for (let i = 0; i < data.length; i += 32768) text += String.fromCharCode(...data.subarray(i, i + 32768));
        return { width: canvas.width, height: canvas.height, base64: btoa(text) };
      },
      { source: png.toString("base64"), detail },
    );
    return { width, height, pixels: new Uint8Array(Buffer.from(base64, "base64")) };
  }

  /** Pixels as a PNG file. */
  async print({ width, height, pixels }: Picture): Promise<Buffer> {
    const base64 = await this.#page.evaluate(
      ({ width, height, base64 }) => {
        const canvas = document.createElement("canvas");
        canvas.width = width;
        canvas.height = height;
        const pixels = Uint8ClampedArray.from(atob(base64), (letter) => letter.charCodeAt(0));
        canvas.getContext("2d")?.putImageData(new ImageData(pixels, width, height), 0, 0);
        return canvas.toDataURL("image/png").split(",")[1] ?? "";
      },
      { width, height, base64: Buffer.from(pixels).toString("base64") },
    );
    return Buffer.from(base64, "base64");
  }
}

type Pixel = readonly [red: number, green: number, blue: number];

function share(box: Box, holds: (at: number) => boolean, width: number): number {
  let count = 0;
  for (let y = box.y; y < box.y + box.height; y++) {
    for (let x = box.x; x < box.x + box.width; x++) {
      if (holds((y * width + x) * 4)) count++;
    }
  }
  return count / (box.width * box.height);
}

function pixel({ pixels }: Picture, at: number): Pixel {
  return [pixels[at] ?? 0, pixels[at + 1] ?? 0, pixels[at + 2] ?? 0];
}

/** The share of a box's pixels that differ visibly between two pictures. */
export function changed(before: Picture, after: Picture, box: Box = whole(after)): number {
  const differs = (at: number) => {
    const [a, b] = [pixel(before, at), pixel(after, at)];
    return Math.abs(a[0] - b[0]) + Math.abs(a[1] - b[1]) + Math.abs(a[2] - b[2]) > 36;
  };
  return share(box, differs, after.width);
}

/** The share of a box's pixels that changed to bark or leaf: red or green where the sky was blue. */
export function becameTree(before: Picture, after: Picture, box: Box): number {
  const differs = (at: number) => {
    const [a, b] = [pixel(before, at), pixel(after, at)];
    const moved = Math.abs(a[0] - b[0]) + Math.abs(a[1] - b[1]) + Math.abs(a[2] - b[2]) > 36;
    return moved && Math.max(b[0], b[1]) > b[2] + 6;
  };
  return share(box, differs, after.width);
}

/** How many clearly different colours there are; an empty or broken canvas has one or two. */
export function colours(picture: Picture): number {
  const seen = new Set<number>();
  for (let at = 0; at < picture.pixels.length; at += 4 * 37) {
    const [r, g, b] = pixel(picture, at);
    seen.add(((r >> 4) << 8) | ((g >> 4) << 4) | (b >> 4));
  }
  return seen.size;
}

export function whole({ width, height }: Picture): Box {
  return { x: 0, y: 0, width, height };
}
