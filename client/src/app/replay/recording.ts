import type { FrameSink } from "./frame-archive";

/** Pictures a second. */
export const RATE = 24;
/** How long the last picture stays, in seconds. */
const STAYS = 1.5;

export interface RecordingOptions {
  /** How long the design takes to play, in seconds. */
  readonly seconds: number;
  /** The step to be seen when so much of it has played, from 0 to 1. */
  readonly stepAt: (share: number) => number;
  /** Shows the tree at a step, and waits until all of it is there. */
  readonly show: (step: number) => Promise<void>;
  readonly photograph: (stop: AbortSignal) => Promise<Blob>;
  readonly sink: FrameSink;
  readonly stop: AbortSignal;
  /** Hears how many pictures of how many are made. */
  readonly tell: (made: number, all: number) => void;
}

/** Plays a design picture by picture, however long each takes, and gives the file that the pictures make. */
export async function record(options: RecordingOptions): Promise<Blob> {
  const { seconds, stepAt, show, photograph, sink, stop, tell } = options;
  const moving = Math.max(2, Math.round(seconds * RATE));
  const all = moving + Math.round(STAYS * RATE);
  let shown: number | null = null;
  let picture: Blob | null = null;
  try {
    for (let i = 0; i < all; i += 1) {
      const step = stepAt(Math.min(1, i / (moving - 1)));
      if (picture === null || step !== shown) {
        await show(step);
        stop.throwIfAborted();
        picture = await photograph(stop);
        shown = step;
      }
      await sink.add(picture);
      stop.throwIfAborted();
      tell(i + 1, all);
    }
    return await sink.finish();
  } catch (error) {
    await sink.cancel();
    throw error;
  }
}
