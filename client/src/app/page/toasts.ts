import { signal } from "@preact/signals";

export interface Toast {
  readonly id: number;
  readonly text: string;
}

const SHOWN_FOR = 4500;
const MOST = 3;

/** Short notes at the edge of the screen that go by themselves. */
export class Toasts {
  readonly list = signal<readonly Toast[]>([]);
  #next = 1;

  show(text: string): void {
    const id = this.#next++;
    // The same note twice is one note shown longer.
    const others = this.list.value.filter((toast) => toast.text !== text);
    this.list.value = [...others.slice(-(MOST - 1)), { id, text }];
    setTimeout(() => this.dismiss(id), SHOWN_FOR);
  }

  dismiss(id: number): void {
    this.list.value = this.list.value.filter((toast) => toast.id !== id);
  }
}
