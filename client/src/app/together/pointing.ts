import type { Pointer } from "../../wire/generated";

/** A finger that has lifted points to what it touched for so many milliseconds more. */
export const POINTED_FOR = 8000;

/** Where a pointer of this page is on the canvas, and what it points to. */
export class Pointing {
  #place: { readonly x: number; readonly y: number; readonly isTouch: boolean } | null = null;
  #liftedAt: number | null = null;
  #found: { readonly pointer: Pointer; readonly view: string } | null = null;

  /** It is here. */
  at(x: number, y: number, isTouch: boolean): void {
    this.#place = { x, y, isTouch };
    this.#liftedAt = null;
    this.#found = null;
  }

  /** A finger is there no longer. */
  lift(now: number): void {
    if (this.#place?.isTouch) {
      this.#liftedAt = now;
    }
  }

  /** It points nowhere any more. */
  leave(): void {
    this.#place = null;
    this.#found = null;
  }

  /**
   * What it points to, as `find` finds it at a place of the canvas. It stays on the wood that it was put on, whatever
   * becomes of that; but where the view has moved under a mouse, the mouse is at something else.
   */
  pointer(view: string, now: number, find: (x: number, y: number) => Pointer | null): Pointer | null {
    if (this.#liftedAt !== null && now - this.#liftedAt > POINTED_FOR) {
      this.leave();
      this.#liftedAt = null;
    }
    if (this.#place === null) {
      return null;
    }
    const { x, y, isTouch } = this.#place;
    if (this.#found === null || (!isTouch && this.#found.view !== view)) {
      const pointer = find(x, y);
      this.#found = pointer && { pointer, view };
    }
    return this.#found?.pointer ?? null;
  }
}
