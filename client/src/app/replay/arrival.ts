import { effect } from "@preact/signals";
import type { Studio } from "../studio";

/** So many drawn frames without a change mean that all rows that wait for a place on the way have come. */
const QUIET_FRAMES = 3;

/** Goes to a step, and waits until the whole tree of that step is there. */
export async function arrive(studio: Studio, step: number, stop: AbortSignal): Promise<void> {
  const command = studio.goTo(step);
  await until(() => studio.finished.value >= command, stop);
  for (let quiet = 0, revision = studio.revision.peek(); quiet < QUIET_FRAMES; ) {
    await new Promise(requestAnimationFrame);
    stop.throwIfAborted();
    quiet = revision === studio.revision.peek() ? quiet + 1 : 0;
    revision = studio.revision.peek();
  }
}

/** Waits until something is true that depends on signals. */
function until(check: () => boolean, stop: AbortSignal): Promise<void> {
  return new Promise((resolve, reject) => {
    const dispose = effect(() => {
      if (check()) {
        queueMicrotask(end);
      }
    });
    const end = () => {
      dispose();
      stop.removeEventListener("abort", giveUp);
      resolve();
    };
    const giveUp = () => {
      dispose();
      reject(stop.reason);
    };
    stop.addEventListener("abort", giveUp, { once: true });
    if (stop.aborted) {
      giveUp();
    }
  });
}
