import type { ExportFormat } from "../../wire/generated";

/** Pixels across and down. */
export interface PictureSize {
  readonly width: number;
  readonly height: number;
}

/** How large the server's pictures are where nobody says more, by the endings of their files. */
export const USUAL_SIZES: Readonly<Record<string, PictureSize>> = {
  png: { width: 1000, height: 1000 },
  "sway.png": { width: 480, height: 540 },
};
/** Sizes to pick from: two of screens on their side, one upright, and a square. */
export const PICTURE_SIZES = ["1920x1080", "3840x2160", "1080x1920", "2048x2048"] as const;
/** The fewest pixels along a side. */
export const LEAST_SIDE = 16;
/** The most pixels of one picture. */
export const MOST_PIXELS = 16_000_000;
/** The most pixels of all pictures of a file together (`EX6`). */
export const MOST_DRAWN = 400_000_000;

/** A size as options have it. */
export function sizeIn(text: string | undefined): PictureSize | null {
  const [, width, height] = /^(\d+)x(\d+)$/.exec(text ?? "") ?? [];
  return width === undefined ? null : { width: Number(width), height: Number(height) };
}

export function sizeText({ width, height }: PictureSize): string {
  return `${width}x${height}`;
}

/** A size with one side changed, and how it was kept to what a picture may have. */
export interface ChangedSize {
  readonly size: PictureSize;
  /** What the side was made, since no more or no less is allowed beside the other; null where it is as was wanted. */
  readonly kept: { readonly to: "most" | "least"; readonly pixels: number } | null;
}

/** A size with one side changed: whole, and no more than one picture may have beside the other. */
export function withSide(size: PictureSize, side: "width" | "height", pixels: number): ChangedSize {
  const other = side === "width" ? size.height : size.width;
  const most = Math.floor(MOST_PIXELS / other);
  const wanted = Math.round(pixels);
  const whole = Math.min(most, Math.max(LEAST_SIDE, wanted));
  const kept = whole === wanted ? null : ({ to: whole < wanted ? "most" : "least", pixels: whole } as const);
  return { size: { ...size, [side]: whole }, kept };
}

/** Pixels of all pictures of a file together; 0 where it has none. */
export function pixelsDrawn({ ending }: ExportFormat, options: ReadonlyMap<string, string>): number {
  const size = sizeIn(options.get("size")) ?? USUAL_SIZES[ending];
  return size ? size.width * size.height * Number(options.get("frames") ?? 1) : 0;
}

/** Whether the server makes so many pixels for one file. */
export function isDrawn(format: ExportFormat, options: ReadonlyMap<string, string>): boolean {
  return pixelsDrawn(format, options) <= MOST_DRAWN;
}
