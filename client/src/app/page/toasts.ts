import { signal } from "@preact/signals";

/** What can still be done about what a note tells. */
export interface ToastAction {
  readonly label: string;
  readonly act: () => void;
}

export interface Toast {
  readonly id: number;
  readonly text: string;
  readonly action?: ToastAction;
}

const SHOWN_FOR = 4500;
/** One that offers something stays until it can be read and reached. */
export const OFFERED_FOR = 10_000;
const MOST = 3;

/** Short notes at the edge of the screen that go by themselves. */
export class Toasts {
  readonly list = signal<readonly Toast[]>([]);
  #next = 1;

  show(text: string, action?: ToastAction): void {
    const id = this.#next++;
    // The same note twice is one note shown longer.
    const others = this.list.value.filter((toast) => toast.text !== text);
    this.list.value = [...others.slice(-(MOST - 1)), { id, text, ...(action === undefined ? {} : { action }) }];
    setTimeout(() => this.dismiss(id), action === undefined ? SHOWN_FOR : OFFERED_FOR);
  }

  /** What a note says is known by now. */
  withdraw(text: string): void {
    this.list.value = this.list.value.filter((toast) => toast.text !== text);
  }

  dismiss(id: number): void {
    this.list.value = this.list.value.filter((toast) => toast.id !== id);
  }
}
