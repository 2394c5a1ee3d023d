import { TURNTABLE_PICTURES } from "../../wire/generated";

/** Where the pictures of a version from all around are (`LB9`). */
export function turntableOf(tree: string, version: number): string {
  return `/api/v1/trees/${encodeURIComponent(tree)}/versions/${version}/turntable`;
}

/** The picture that shows what was pushed so far to the right, in widths of the picture: one is once around. */
export function pictureAt(pushed: number): number {
  // The eye goes the other way.
  const picture = -Math.round(pushed * TURNTABLE_PICTURES) % TURNTABLE_PICTURES;
  return picture < 0 ? picture + TURNTABLE_PICTURES : Math.abs(picture);
}

/** How large a strip is as a background, one of its pictures to the width. */
export const SIZE = `${100 * TURNTABLE_PICTURES}% 100%`;

/** Where a strip as a background lies so that it shows one of its pictures. */
export function placeOf(picture: number): string {
  return `${(100 * picture) / (TURNTABLE_PICTURES - 1)}% 0`;
}
