import { LinearFilter, type WebGLRenderer, WebGLRenderTarget } from "three";
import { PICTURE_SAMPLES } from "./quality";
import { upright } from "./thumbnail";

/** Pixels of a tile across and down: what is drawn at once, so that a large picture needs no large memory. */
const TILE = 1024;

/** A rectangle of a picture, in its pixels from the left and the top. */
export interface Tile {
  readonly x: number;
  readonly y: number;
  readonly width: number;
  readonly height: number;
}

/** The tiles that a picture is drawn in. */
export function tilesOf(width: number, height: number): readonly Tile[] {
  const starts = (length: number) => Array.from({ length: Math.ceil(length / TILE) }, (_, i) => i * TILE);
  return starts(height).flatMap((y) =>
    starts(width).map((x) => ({ x, y, width: Math.min(TILE, width - x), height: Math.min(TILE, height - y) })),
  );
}

export interface PictureOptions {
  readonly renderer: WebGLRenderer;
  /** Pixels across and down. */
  readonly width: number;
  readonly height: number;
  /** Draws one tile into what the renderer draws on. */
  readonly draw: (tile: Tile) => void;
  readonly stop: AbortSignal;
  /** Hears what share of the picture is drawn. */
  readonly tell: (share: number) => void;
}

/** A picture as PNG, drawn tile by tile; between them the page answers, and may stop it. */
export async function pictureInTiles({ renderer, width, height, draw, stop, tell }: PictureOptions): Promise<Blob> {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext("2d");
  if (!context) throw new Error("This browser has no 2D canvas to make a picture with.");
  const tiles = tilesOf(width, height);
  for (const [i, tile] of tiles.entries()) {
    context.putImageData(drawn(renderer, tile, draw), tile.x, tile.y);
    tell((i + 1) / tiles.length);
    await new Promise((resolve) => setTimeout(resolve));
    stop.throwIfAborted();
  }
  const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, "image/png"));
  stop.throwIfAborted();
  if (!blob) throw new Error("This browser cannot make a picture as large as that.");
  return blob;
}

function drawn(renderer: WebGLRenderer, tile: Tile, draw: (tile: Tile) => void): ImageData {
  const { width, height } = tile;
  const target = new WebGLRenderTarget(width, height, {
    samples: PICTURE_SAMPLES,
    minFilter: LinearFilter,
    magFilter: LinearFilter,
  });
  const pixels = new Uint8ClampedArray(4 * width * height);
  try {
    renderer.setRenderTarget(target);
    draw(tile);
    renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
  } finally {
    renderer.setRenderTarget(null);
    target.dispose();
  }
  return new ImageData(upright(pixels, width, height), width, height);
}
