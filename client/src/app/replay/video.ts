import {
  BufferTarget,
  CanvasSource,
  getFirstEncodableVideoCodec,
  Mp4OutputFormat,
  Output,
  QUALITY_HIGH,
  WebMOutputFormat,
} from "mediabunny";
import type { PictureSize } from "../../scene/camera/sight";
import type { FrameSink } from "./frame-archive";

/** A kind of video that this browser can make. */
export interface VideoKind {
  readonly ending: "mp4" | "webm";
  readonly codec: "avc" | "vp9" | "vp8";
}

/** What this browser can encode, that which most programs play first; null where it encodes nothing. */
export async function videoKind({ width, height }: PictureSize): Promise<VideoKind | null> {
  // Browsers encode on pages alone that came by https, or from this machine.
  if (!("VideoEncoder" in globalThis)) {
    return null;
  }
  const codec = await getFirstEncodableVideoCodec(["avc", "vp9", "vp8"], { width, height });
  if (codec === "avc") {
    return { ending: "mp4", codec };
  }
  return codec === "vp9" || codec === "vp8" ? { ending: "webm", codec } : null;
}

/** Pictures as a video of so many a second. */
export async function video({ ending, codec }: VideoKind, size: PictureSize, rate: number): Promise<FrameSink> {
  const canvas = new OffscreenCanvas(size.width, size.height);
  const context = canvas.getContext("2d");
  const target = new BufferTarget();
  const output = new Output({ format: ending === "mp4" ? new Mp4OutputFormat() : new WebMOutputFormat(), target });
  const source = new CanvasSource(canvas, { codec, bitrate: QUALITY_HIGH });
  output.addVideoTrack(source, { frameRate: rate });
  await output.start();
  let number = 0;
  return {
    async add(picture) {
      const bitmap = await createImageBitmap(picture);
      context?.drawImage(bitmap, 0, 0);
      bitmap.close();
      await source.add(number / rate, 1 / rate);
      number += 1;
    },
    async finish() {
      await output.finalize();
      return new Blob([target.buffer ?? new ArrayBuffer()], { type: `video/${ending}` });
    },
    async cancel() {
      await output.cancel();
    },
  };
}
