import { LinearFilter, type WebGLRenderer, WebGLRenderTarget } from "three";
import { PICTURE_SAMPLES } from "./quality";

/** The server takes no larger pictures. */
const MAX_URL_LENGTH = 192 * 1024;
const QUALITIES = [0.85, 0.7, 0.5, 0.3];

/** What `draw` draws, off screen, as a data URL small enough for the server. */
export async function encodePicture(
  renderer: WebGLRenderer,
  width: number,
  height: number,
  draw: () => void,
): Promise<string> {
  const target = new WebGLRenderTarget(width, height, {
    samples: PICTURE_SAMPLES,
    minFilter: LinearFilter,
    magFilter: LinearFilter,
  });
  const pixels = new Uint8ClampedArray(4 * width * height);
  try {
    renderer.setRenderTarget(target);
    draw();
    renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
  } finally {
    renderer.setRenderTarget(null);
    target.dispose();
  }
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext("2d");
  if (!context) throw new Error("This browser has no 2D canvas to make a picture with.");
  context.putImageData(new ImageData(upright(pixels, width, height), width, height), 0, 0);
  for (const quality of QUALITIES) {
    // A browser that cannot write WebP answers with PNG, whatever the quality; JPEG is then the smaller one.
    for (const type of ["image/webp", "image/jpeg"]) {
      const url = canvas.toDataURL(type, quality);
      if (url.startsWith(`data:${type}`) && url.length <= MAX_URL_LENGTH) return url;
    }
  }
  throw new Error("The picture is too large to be saved.");
}

/** The GPU counts lines from below. */
export function upright(pixels: Uint8ClampedArray<ArrayBuffer>, width: number, height: number) {
  const out = new Uint8ClampedArray(pixels.length);
  const line = 4 * width;
  for (let y = 0; y < height; y += 1) {
    out.set(pixels.subarray((height - 1 - y) * line, (height - y) * line), y * line);
  }
  // The scene is opaque; what transparent things left in the alpha channel is no part of the picture.
  for (let at = 3; at < out.length; at += 4) out[at] = 255;
  return out;
}
