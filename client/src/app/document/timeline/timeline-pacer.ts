/** How long a step that is asked for may stay away before another is asked for, in milliseconds. */
export const PATIENCE = 400;

/** What is known of the server when a frame is about to be drawn. */
export interface TravelState {
  /** `go_to` commands that are not yet answered. */
  readonly unsettled: number;
  /** The step in its last message. */
  readonly step: number;
  /** Counts the frames of rows that came in. */
  readonly revision: number;
}

/**
 * Turns a playhead that is pulled about into `go_to`, one at a time: the next is asked for when the tree of the one
 * before has come, so that a heavy tree skips steps and never falls behind the finger.
 */
export class TravelPacer {
  #asked: { readonly step: number; readonly at: number; readonly revision: number } | null = null;

  /** The user has taken hold of the playhead. */
  take(): void {
    this.#asked = null;
  }

  /** The step to ask for now, if any. */
  tick(now: number, wanted: number, { unsettled, step, revision }: TravelState): number | null {
    const asked = this.#asked;
    if (asked) {
      const arrived = step === asked.step || revision !== asked.revision;
      if (unsettled > 0 || (!arrived && now - asked.at < PATIENCE) || wanted === asked.step) {
        return null;
      }
    } else if (unsettled > 0 || wanted === step) {
      return null;
    }
    this.#asked = { step: wanted, at: now, revision };
    return wanted;
  }

  /** Whether the playhead's last place was asked for. */
  followed(wanted: number, step: number): boolean {
    return wanted === (this.#asked?.step ?? step);
  }
}
