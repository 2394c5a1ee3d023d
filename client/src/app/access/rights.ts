import { computed, type Signal } from "@preact/signals";
import { LEAST_ROLES, type Me, ROLES, type Role } from "../../wire/generated";
import { kept } from "../page/settings";
import { ask } from "../requests/request";

/** What a role may do, as the server's table says. */
function may(role: Role, action: keyof typeof LEAST_ROLES): boolean {
  return ROLES.indexOf(role) >= ROLES.indexOf(LEAST_ROLES[action]);
}

/** What whoever is at this page may do (`AC8`). Until the server has said it, it is what it said last time. */
export class Rights {
  readonly me: Signal<Me | null>;
  /** Whether they may draw, save, and whatever else changes trees. */
  readonly mayChange = computed(() => may(this.me.value?.role ?? "owner", "EditSession"));
  /** The only tree they may see; null where the library is open to them. */
  readonly onlyTree = computed(() => this.me.value?.tree ?? null);
  /** The question on its way. */
  #asked: Promise<void> | null = null;

  constructor(store: Storage) {
    this.me = kept<Me | null>(store, "me", null, isMe);
  }

  /** Whether they may say what they think of trees. */
  get mayComment(): boolean {
    return may(this.me.value?.role ?? "owner", "Comment");
  }

  /** Whether they may begin trees, and add to the library. */
  get mayBegin(): boolean {
    return this.mayChange.value && this.onlyTree.value === null;
  }

  /** Whether they may delete trees, and take that back. */
  get mayDelete(): boolean {
    return may(this.me.value?.role ?? "owner", "DeleteTree") && this.onlyTree.value === null;
  }

  /** Whether they may let others in for one tree. */
  get mayShare(): boolean {
    return may(this.me.value?.role ?? "owner", "ShareTree") && this.onlyTree.value === null;
  }

  /** Whether they may let go on what the server did not outlive (`OP5`). */
  get mayResume(): boolean {
    return may(this.me.value?.role ?? "owner", "ResumeSession");
  }

  /** Whether they may see how the server is (`SV2`). */
  get maySeeServer(): boolean {
    return may(this.me.value?.role ?? "owner", "SeeServer") && this.onlyTree.value === null;
  }

  /** Whether they may have trees grown into files. */
  get mayOrder(): boolean {
    return may(this.me.value?.role ?? "owner", "GrowTrees") && this.onlyTree.value === null;
  }

  /** They may do what this role may, from now on. */
  grant(role: Role): void {
    this.me.value = { way: "machine", ...this.me.peek(), role };
  }

  /** Asks the server, once for all who want to know; fails where it does not say, and what was known before stays. */
  ask(): Promise<void> {
    this.#asked ??= askWho()
      .then((me) => {
        this.me.value = me;
      })
      .finally(() => {
        this.#asked = null;
      });
    return this.#asked;
  }
}

/** Who the server takes this page for; null where it lets it not in, or is silent. */
export async function whoAmI(): Promise<Me | null> {
  return askWho().catch(() => null);
}

function askWho(): Promise<Me> {
  return ask<Me>("GET", "/api/v1/me");
}

function isMe(value: unknown): boolean {
  return typeof value === "object" && value !== null && "role" in value && ROLES.includes(value.role as Role);
}
