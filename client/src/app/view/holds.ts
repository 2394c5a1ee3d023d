/** Counts the holders of something; it is released when the last of them has released it. */
export class Holds {
  #tell: (held: boolean) => void;
  #holders = new Set<object>();

  /** `tell` is called when the first holder comes and when the last one leaves. */
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
