/** A screen that the page is opened on. */
export interface Screen {
  readonly width: number;
  readonly height: number;
  /** Device pixels per pixel of the page. */
  readonly detail: number;
  /** Whether the picture is drawn all the time, and not only while one is taken of it: for tests of the drawing itself. */
  readonly watched?: boolean;
  /** Whether what slides in moves, and a replay begins by itself, though the picture is not watched. */
  readonly moves?: boolean;
  /** Whether the page is kept by its service worker, which takes a copy of all its files each time one is opened anew. */
  readonly kept?: boolean;
  /** Whether it has a mouse and no touch. */
  readonly mouse?: boolean;
}

/** A tablet on its side, as people see it, but for its pixels: the processor draws each of them. */
export const LANDSCAPE: Screen = { width: 1194, height: 834, detail: 0.5 };
/** That tablet for tests of the drawing itself, which goes on as it does for people. */
export const WATCHED: Screen = { ...LANDSCAPE, watched: true };
/** One with still coarser ones, for tests that are not about looks. */
export const COARSE: Screen = { ...LANDSCAPE, detail: 0.4 };

/** For tests in which no picture is taken. */
export const SMALL: Screen = { width: 900, height: 640, detail: 0.2 };
export const PHONE: Screen = { width: 390, height: 844, detail: 0.6 };
