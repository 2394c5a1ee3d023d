import { computed, type Signal } from "@preact/signals";
import type { Me, Role } from "../../wire/generated";
import { kept } from "../page/settings";
import { ask } from "../requests/request";

/** Which roles change trees; the others look at them. */
const CHANGES: Record<Role, boolean> = { viewer: false, editor: true, owner: true, admin: true };
/** Which roles delete them. */
const DELETES: Record<Role, boolean> = { viewer: false, editor: false, owner: true, admin: true };

/** What whoever is at this page may do (`AC8`). Until the server has said it, it is what it said last time. */
export class Rights {
  readonly me: Signal<Me | null>;
  /** Whether they may draw, save, and whatever else changes trees. */
  readonly mayChange = computed(() => CHANGES[this.me.value?.role ?? "owner"]);
  /** The only tree they may see; null where the library is open to them. */
  readonly onlyTree = computed(() => this.me.value?.tree ?? null);

  constructor(store: Storage) {
    this.me = kept<Me | null>(store, "me", null, isMe);
  }

  /** Whether they may begin trees, and add to the library. */
  get mayBegin(): boolean {
    return this.mayChange.value && this.onlyTree.value === null;
  }

  /** Whether they may delete trees, and take that back. */
  get mayDelete(): boolean {
    return DELETES[this.me.value?.role ?? "owner"] && this.onlyTree.value === null;
  }

  /** Asks the server; where it does not say, nothing is known that was not known before. */
  async ask(): Promise<void> {
    const me = await whoAmI();
    if (me !== null) {
      this.me.value = me;
    }
  }
}

/** Who the server takes this page for; null where it lets it not in, or is silent. */
export async function whoAmI(): Promise<Me | null> {
  return ask<Me>("GET", "/api/v1/me").catch(() => null);
}

function isMe(value: unknown): boolean {
  return typeof value === "object" && value !== null && "role" in value && Object.hasOwn(CHANGES, String(value.role));
}
