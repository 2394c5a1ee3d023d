import type { Picture } from "../src/picture";

/** A cell that differs from the paper by more than this in one of its channels, of 256 steps, shows the tree. */
const APART = 20;
/** The feet of trees stand below this share of the picture, where the page alone has ground and shadow. */
const ABOVE_GROUND = 0.82;

/** How far two pictures of a tree are the same. */
export interface Agreement {
  /** Cells that show the tree in both pictures, of those that do in either. */
  readonly overlap: number;
  /** The mean colour of these in the second picture, less that in the first, in steps of 256 a channel. */
  readonly colour: readonly number[];
}

/** Of two pictures in cells, each of a tree before paper that is the same along each row. */
export function agreementOf(page: Picture, file: Picture): Agreement {
  const [inPage, inFile] = [treeIn(page), treeIn(file)];
  let [both, either] = [0, 0];
  const sum = [0, 0, 0];
  for (const [cell, there] of inPage.entries()) {
    if (there || inFile[cell]) either += 1;
    if (!there || !inFile[cell]) continue;
    both += 1;
    for (const channel of [0, 1, 2])
      sum[channel]! += file.pixels[cell * 4 + channel]! - page.pixels[cell * 4 + channel]!;
  }
  return { overlap: both / either, colour: sum.map((all) => all / both) };
}

/** Which cells show the tree: those that are not as the paper is at the left end of their row. */
function treeIn({ width, height, pixels }: Picture): boolean[] {
  const shown: boolean[] = [];
  for (let y = 0; y < Math.floor(height * ABOVE_GROUND); y++) {
    for (let x = 0; x < width; x++) {
      const apart = [0, 1, 2].map((channel) =>
        Math.abs(pixels[(y * width + x) * 4 + channel]! - pixels[y * width * 4 + channel]!),
      );
      shown.push(Math.max(...apart) > APART);
    }
  }
  return shown;
}
