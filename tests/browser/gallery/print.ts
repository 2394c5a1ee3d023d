import type { Page } from "playwright-core";

/** Of JPEG, 0 to 1: bark and leaves show no blocks, and a picture has a few hundred kilobytes. */
const QUALITY = 0.82;
/** Between pictures side by side, as a share of their width. */
const GAP = 0.012;

/** Has a page bring PNG pictures to a size, put them side by side, in rows of so many, and pack them as JPEG. */
export async function print(
  page: Page,
  pngs: readonly Buffer[],
  width: number,
  height: number,
  row = pngs.length,
): Promise<Buffer> {
  const base64 = await page.evaluate(
    async ({ sources, width, height, row, gap, quality }) => {
      const canvas = document.createElement("canvas");
      const across = (count: number, size: number) => count * size + (count - 1) * gap;
      canvas.width = across(row, width);
      canvas.height = across(Math.ceil(sources.length / row), height);
      const context = canvas.getContext("2d");
      if (!context) throw new Error("there is no 2D canvas");
      context.fillStyle = "white";
      context.fillRect(0, 0, canvas.width, canvas.height);
      context.imageSmoothingQuality = "high";
      for (const [place, source] of sources.entries()) {
        const image = new Image();
        image.src = `data:image/png;base64,${source}`;
        await image.decode();
        const [column, line] = [place % row, Math.floor(place / row)];
        context.drawImage(image, column * (width + gap), line * (height + gap), width, height);
      }
      return canvas.toDataURL("image/jpeg", quality).split(",")[1] ?? "";
    },
    {
      sources: pngs.map((png) => png.toString("base64")),
      width,
      height,
      row,
      gap: Math.round(width * GAP),
      quality: QUALITY,
    },
  );
  return Buffer.from(base64, "base64");
}
