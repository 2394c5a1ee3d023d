import { existsSync } from "node:fs";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";
import type { Darkroom, Picture } from "./picture";

/** Where the pictures lie that others are compared with. */
const FOLDER = join(import.meta.dirname, "../reference");
/** `WRITE_PICTURES=1` keeps what is drawn now, for when the looks have changed on purpose; look at it before it is kept. */
export const writes = process.env.WRITE_PICTURES === "1";

/** Pixels of the page, along each side, to one that is kept: edges and letters may lie a little otherwise. */
const COARSENESS = 3;
/** A tile's side in pixels that are kept. */
const TILE = 12;

/** How far apart two pictures are, in steps of a colour's 256. */
export interface Distance {
  /** Over all pixels. */
  readonly mean: number;
  /** In the tile where it is largest: a tree that is missing is a small part of a picture. */
  readonly worst: number;
}

/** What two pictures of the same thing may differ by: other processors round otherwise, and leaves are fine. */
export const TOLERANCE: Distance = { mean: 3, worst: 26 };

export function within({ mean, worst }: Distance, tolerance = TOLERANCE): boolean {
  return mean <= tolerance.mean && worst <= tolerance.worst;
}

/** Keeps a picture under a name. */
export async function keep(darkroom: Darkroom, picture: Picture, name: string): Promise<void> {
  await mkdir(FOLDER, { recursive: true });
  await writeFile(join(FOLDER, `${name}.png`), await darkroom.print(shrunk(picture)));
}

/** Compares a picture with the one kept under a name. */
export async function compare(darkroom: Darkroom, picture: Picture, name: string): Promise<Distance> {
  const path = join(FOLDER, `${name}.png`);
  if (!existsSync(path)) throw new Error(`no picture is kept as ${path}; WRITE_PICTURES=1 keeps what is drawn now`);
  return distance(shrunk(picture), await darkroom.develop(await readFile(path)));
}

/** The mean colour of each square of pixels. */
export function shrunk({ width, height, pixels }: Picture, by = COARSENESS): Picture {
  const small = { width: Math.floor(width / by), height: Math.floor(height / by) };
  const means = new Uint8Array(small.width * small.height * 4);
  for (let y = 0; y < small.height; y++) {
    for (let x = 0; x < small.width; x++) {
      for (let channel = 0; channel < 4; channel++) {
        let sum = 0;
        for (let v = y * by; v < (y + 1) * by; v++) {
          for (let u = x * by; u < (x + 1) * by; u++) sum += pixels[(v * width + u) * 4 + channel]!;
        }
        means[(y * small.width + x) * 4 + channel] = sum / by ** 2;
      }
    }
  }
  return { ...small, pixels: means };
}

/** Everything, where they are not even of one size. */
export function distance(a: Picture, b: Picture): Distance {
  if (a.width !== b.width || a.height !== b.height) return { mean: 255, worst: 255 };
  let [sum, worst] = [0, 0];
  for (let top = 0; top < a.height; top += TILE) {
    for (let left = 0; left < a.width; left += TILE) {
      const [right, bottom] = [Math.min(left + TILE, a.width), Math.min(top + TILE, a.height)];
      let tile = 0;
      for (let y = top; y < bottom; y++) {
        for (let x = left; x < right; x++) {
          const at = (y * a.width + x) * 4;
          for (let i = at; i < at + 3; i++) tile += Math.abs(a.pixels[i]! - b.pixels[i]!) / 3;
        }
      }
      sum += tile;
      worst = Math.max(worst, tile / ((right - left) * (bottom - top)));
    }
  }
  return { mean: sum / (a.width * a.height), worst };
}
