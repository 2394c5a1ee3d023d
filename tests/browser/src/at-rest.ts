/** What a page is asked: whether all that slides or fades in has come, or whether nothing of it changes any more, either. */
export type Rest = "come" | "settled";

/** So long two frames may take, in milliseconds: a page that draws none is not waited for. */
export const FRAMES = 5000;
/** So far apart a page is looked at to see whether it changes, in milliseconds, and so often in one call. */
const PAUSE = 50;
const ROUNDS = 20;

/** What `isAtRest` takes in the page, where nothing else of this file is known. */
export interface RestAsked {
  readonly rest: Rest;
  readonly frames: number;
  readonly pause: number;
  readonly rounds: number;
}

export function restAsked(rest: Rest): RestAsked {
  return { rest, frames: FRAMES, pause: PAUSE, rounds: rest === "come" ? 1 : ROUNDS };
}

/** In the page: whether it is at rest two frames from now; what it says may go on changing where it has only to come. */
export async function isAtRest({ rest, frames, pause, rounds }: RestAsked): Promise<boolean> {
  const wait = (time: number) => new Promise<void>((done) => setTimeout(done, time));
  const twoFrames = () => new Promise<void>((done) => requestAnimationFrame(() => requestAnimationFrame(() => done())));
  // A part that is being loaded has not come.
  const hasCome = () =>
    document.querySelector('[aria-busy="true"]') === null &&
    document.getAnimations().every(({ effect, playState }) => {
      return playState !== "running" || effect?.getComputedTiming().endTime === Number.POSITIVE_INFINITY;
    });
  let before: string | null = null;
  for (let round = 1; ; round++) {
    await Promise.race([twoFrames(), wait(frames)]);
    if (hasCome()) {
      const now: string | null = rest === "come" ? before : document.body.outerHTML;
      if (now === before) return true;
      before = now;
    }
    if (round === rounds) return false;
    await wait(pause);
  }
}
