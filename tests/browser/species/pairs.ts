import type { Page } from "playwright-core";

/** A tree on the sheet, and the same one grown by hand. */
export interface Pair {
  readonly name: string;
  /** A PNG file. */
  readonly sheet: Buffer;
  /** A JPEG file. */
  readonly byHand: Buffer;
}

/** Pixels of each picture. */
export const SIZE = { width: 180, height: 186 };

/** Has a page lay pairs out in rows, each with its name below, and pack them as JPEG. */
export async function layOut(page: Page, pairs: readonly Pair[]): Promise<Buffer> {
  const url = (type: string, picture: Buffer) => `data:image/${type};base64,${picture.toString("base64")}`;
  const base64 = await page.evaluate(
    async ({ pairs, size, columns, gap, label, quality }) => {
      const [across, down] = [2 * size.width + gap, size.height + label];
      const canvas = document.createElement("canvas");
      canvas.width = Math.min(columns, pairs.length) * across;
      canvas.height = Math.ceil(pairs.length / columns) * down;
      const context = canvas.getContext("2d");
      if (!context) throw new Error("there is no 2D canvas");
      context.fillStyle = "white";
      context.fillRect(0, 0, canvas.width, canvas.height);
      context.imageSmoothingQuality = "high";
      context.font = "15px sans-serif";
      context.textAlign = "center";
      for (const [index, { name, pictures }] of pairs.entries()) {
        const [x, y] = [(index % columns) * across + gap / 2, Math.floor(index / columns) * down];
        for (const [place, source] of pictures.entries()) {
          const image = new Image();
          image.src = source;
          await image.decode();
          context.drawImage(image, x + place * size.width, y, size.width, size.height);
        }
        context.fillStyle = "#34382e";
        context.fillText(name, x + size.width, y + size.height + 19);
      }
      return canvas.toDataURL("image/jpeg", quality).split(",")[1] ?? "";
    },
    {
      pairs: pairs.map(({ name, sheet, byHand }) => ({ name, pictures: [url("png", sheet), url("jpeg", byHand)] })),
      size: SIZE,
      columns: 4,
      gap: 14,
      label: 32,
      quality: 0.8,
    },
  );
  return Buffer.from(base64, "base64");
}
