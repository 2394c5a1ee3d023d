/** More is not kept of what the fingers do while a tool's code is loaded. */
const MOST = 1000;

/** Holds presses, and what follows them, back while what they are for is loaded; then they happen in their order. */
export class PressQueue {
  #held: (() => void)[] | null = null;

  /** A finger or button goes down; `loading` says whether what it is for came, or is null where that is there. */
  press(happen: () => void, loading: Promise<boolean> | null): void {
    if (this.#held || !loading) {
      this.follow(happen);
      return;
    }
    this.#held = [happen];
    void loading.then((came) => {
      const held = this.#held ?? [];
      this.#held = null;
      for (const each of came ? held : []) {
        each();
      }
    });
  }

  /** What follows a press. */
  follow(happen: () => void): void {
    if (!this.#held) {
      happen();
    } else if (this.#held.length < MOST) {
      this.#held.push(happen);
    }
  }
}
