import type { Page } from "playwright-core";

/** Of lossy WebP, 0 to 1: what moves shows no blocks, and a loop has two or three megabytes. */
const QUALITY = 0.75;

interface Frame {
  /** A whole file of one picture. */
  readonly webp: Buffer;
  readonly milliseconds: number;
}

/** Has a page pack an animated PNG as animated WebP, which goes on for ever and is a fraction as large. */
export async function loopOf(page: Page, apng: Buffer): Promise<Buffer> {
  const { width, height, frames } = await page.evaluate(
    async ({ source, quality }) => {
      const data = await (await fetch(`data:image/png;base64,${source}`)).arrayBuffer();
      const decoder = new ImageDecoder({ data, type: "image/png" });
      await decoder.tracks.ready;
      const { frameCount = 0 } = decoder.tracks.selectedTrack ?? {};
      const frames: { base64: string; milliseconds: number }[] = [];
      let [width, height] = [0, 0];
      for (let frameIndex = 0; frameIndex < frameCount; frameIndex += 1) {
        const { image } = await decoder.decode({ frameIndex });
        [width, height] = [image.displayWidth, image.displayHeight];
        const canvas = document.createElement("canvas");
        [canvas.width, canvas.height] = [width, height];
        // Without transparency each picture is one chunk.
        canvas.getContext("2d", { alpha: false })!.drawImage(image, 0, 0);
        const base64 = canvas.toDataURL("image/webp", quality).split(",")[1] ?? "";
        frames.push({ base64, milliseconds: (image.duration ?? 0) / 1000 });
        image.close();
      }
      return { width, height, frames };
    },
    { source: apng.toString("base64"), quality: QUALITY },
  );
  const pictures = frames.map(({ base64, milliseconds }) => ({ webp: Buffer.from(base64, "base64"), milliseconds }));
  if (pictures.length < 2) throw new Error("the picture does not move");
  return packed(width, height, pictures);
}

/** One file of pictures that have one size, one after the other without end. */
export function packed(width: number, height: number, frames: readonly Frame[]): Buffer {
  const canvas = Buffer.alloc(10);
  const ANIMATED = 0x02;
  canvas.writeUInt8(ANIMATED, 0);
  canvas.writeUIntLE(width - 1, 4, 3);
  canvas.writeUIntLE(height - 1, 7, 3);
  // White behind it, and for ever.
  const animation = Buffer.from([255, 255, 255, 255, 0, 0]);
  // Times are summed before they are rounded, so that the whole lasts as long as it should.
  let ends = 0;
  const chunks = frames.map(({ webp, milliseconds }) => {
    const began = Math.round(ends);
    ends += milliseconds;
    const head = Buffer.alloc(16);
    head.writeUIntLE(width - 1, 6, 3);
    head.writeUIntLE(height - 1, 9, 3);
    head.writeUIntLE(Math.round(ends) - began, 12, 3);
    const ALONE = 0x02;
    head.writeUInt8(ALONE, 15);
    return chunk("ANMF", Buffer.concat([head, pixelsOf(webp)]));
  });
  const body = Buffer.concat([Buffer.from("WEBP"), chunk("VP8X", canvas), chunk("ANIM", animation), ...chunks]);
  return chunk("RIFF", body);
}

/** The chunk with the pixels of a file of one picture. */
function pixelsOf(webp: Buffer): Buffer {
  for (let at = 12; at + 8 <= webp.length; ) {
    const size = webp.readUInt32LE(at + 4);
    if (["VP8 ", "VP8L"].includes(webp.toString("latin1", at, at + 4))) return chunkAt(webp, at, size);
    at += 8 + size + (size % 2);
  }
  throw new Error("a picture came without pixels");
}

function chunkAt(file: Buffer, at: number, size: number): Buffer {
  return chunk(file.toString("latin1", at, at + 4), file.subarray(at + 8, at + 8 + size));
}

function chunk(name: string, content: Buffer): Buffer {
  const head = Buffer.alloc(8);
  head.write(name, 0, "latin1");
  head.writeUInt32LE(content.length, 4);
  return Buffer.concat([head, content, Buffer.alloc(content.length % 2)]);
}
