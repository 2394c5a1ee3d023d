/** Who keeps something held: it is let go once the last of them has let go. */
export class Holds {
  #tell: (held: boolean) => void;
  #holders = new Set<object>();

  /** `tell` is called when the first takes hold and when the last lets go. */
  constructor(tell: (held: boolean) => void) {
    this.#tell = tell;
  }

  get held(): boolean {
    return this.#holders.size > 0;
  }

  /** Takes hold; returns what lets go, which does so once however often it is called. */
  take(): () => void {
    const holder = {};
    this.#holders.add(holder);
    if (this.#holders.size === 1) {
      this.#tell(true);
    }
    return () => {
      if (this.#holders.delete(holder) && this.#holders.size === 0) {
        this.#tell(false);
      }
    };
  }
}
