import { MAX_THUMBNAIL_BYTES } from "../../wire/generated";
import type { Stage } from "../view/stage";

/** A line over a view, as shares of its width and height. */
export type Line = readonly (readonly [x: number, y: number])[];

/** Pixels across of pictures that go with comments; the first that is not too large goes. */
const WIDTHS = [640, 480, 320] as const;

/** What the page shows now with what was drawn over it, as a data URL; null where none can be made. */
export async function picture(stage: Pick<Stage, "view" | "pixels">, lines: readonly Line[]): Promise<string | null> {
  const pixels = stage.pixels();
  if (!pixels || !stage.view) {
    return null;
  }
  for (const width of WIDTHS) {
    const height = Math.max(1, Math.round((width * pixels.height) / pixels.width));
    const plain = await stage.view.thumbnail(width, height);
    const url = plain && (await withLines(plain, width, height, lines));
    if (url && bytesOf(url) <= MAX_THUMBNAIL_BYTES) {
      return url;
    }
  }
  return null;
}

/** The bytes that a base64 data URL holds. */
function bytesOf(url: string): number {
  return ((url.length - url.indexOf(",") - 1) * 3) / 4;
}

async function withLines(url: string, width: number, height: number, lines: readonly Line[]): Promise<string | null> {
  if (lines.length === 0) {
    return url;
  }
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [width, height];
  const pen = canvas.getContext("2d");
  if (!pen) {
    return null;
  }
  const image = new Image();
  image.src = url;
  await image.decode();
  pen.drawImage(image, 0, 0, width, height);
  pen.lineCap = "round";
  pen.lineJoin = "round";
  // White below, so that the line shows on every ground.
  for (const [colour, wide] of [
    ["#ffffff", width / 90],
    ["#d6336c", width / 160],
  ] as const) {
    pen.strokeStyle = colour;
    pen.lineWidth = wide;
    for (const line of lines) {
      pen.beginPath();
      for (const [x, y] of line.length === 1 ? [line[0]!, line[0]!] : line) {
        pen.lineTo(x * width, y * height);
      }
      pen.stroke();
    }
  }
  return canvas.toDataURL("image/jpeg", 0.85);
}
