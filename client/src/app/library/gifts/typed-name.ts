import { signal } from "@preact/signals";
import type { Giving } from "./gifts";

export const RECEIVERS = ["user", "group"] as const;
export type Receiver = (typeof RECEIVERS)[number];

/** To whom something is to be given. */
export interface Called {
  readonly kind: Receiver;
  /** Empty where nothing is typed. */
  readonly name: string;
}

/** The name of a user or a group while it is typed. */
export class TypedName {
  readonly kind = signal<Receiver>("user");
  readonly text = signal("");
  /** What was to be given to nobody: to this name, which nobody has, or to none at all. */
  readonly nobody = signal<Called | null>(null);

  /** What is typed now. */
  get called(): Called {
    return { kind: this.kind.value, name: this.text.value.trim() };
  }

  type(text: string): void {
    this.text.value = text;
    this.nobody.value = null;
  }

  choose(kind: Receiver): void {
    this.kind.value = kind;
    this.nobody.value = null;
  }

  /** The server has answered what was asked with `called`; what is typed by now is something else, and stays. */
  answered(called: Called, giving: Giving): void {
    if (giving === "nobody") {
      this.nobody.value = called;
    } else if (giving === "given" && called.kind === this.kind.peek() && called.name === this.text.peek().trim()) {
      this.type("");
    }
  }
}
