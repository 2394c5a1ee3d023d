import { computed, type Signal, signal } from "@preact/signals";
import { LEAST_ROLES, type Me, ROLES, type Role } from "../../wire/generated";
import { kept } from "../page/settings";
import { ask } from "../requests/request";

/** What a role may do, as the server's table says. */
export function may(role: Role, action: keyof typeof LEAST_ROLES): boolean {
  return ROLES.indexOf(role) >= ROLES.indexOf(LEAST_ROLES[action]);
}

/** What whoever is at this page may do (`AC8`). Until the server has said it, it is what it said last time. */
export class Rights {
  readonly me: Signal<Me | null>;
  /** What they may do with the tree that is open, where its session has said so (`AU3`). */
  readonly here = signal<Role | null>(null);
  /** Whether they may draw, save, and whatever else changes the tree that is open. */
  readonly mayChange = computed(() => may(this.#here, "EditSession"));
  /** The only tree they may see; null where the library is open to them. */
  readonly onlyTree = computed(() => this.me.value?.tree ?? null);
  /** The question on its way. */
  #asked: Promise<void> | null = null;

  constructor(store: Storage) {
    this.me = kept<Me | null>(store, "me", null, isMe);
  }

  /** Whether they may say what they think of trees. */
  get mayComment(): boolean {
    return may(this.#here, "Comment");
  }

  /** Whether they may begin trees, and add to the library. */
  get mayBegin(): boolean {
    return may(this.#everywhere, "SaveTree") && this.onlyTree.value === null;
  }

  /** Whether they may delete trees, and take that back. */
  get mayDelete(): boolean {
    return may(this.#everywhere, "DeleteTree") && this.onlyTree.value === null;
  }

  /** Whether they may let others in for any one tree. */
  get mayShare(): boolean {
    return may(this.#everywhere, "ShareTree") && this.onlyTree.value === null;
  }

  /** Whether they say who comes to the tree that is open, and who owns it. */
  get mayGovern(): boolean {
    return may(this.#here, "ShareTree");
  }

  /** Whether they may let go on what the server did not outlive (`OP5`). */
  get mayResume(): boolean {
    return may(this.#here, "ResumeSession");
  }

  /** Whether they say who comes in (`AC19`). */
  get mayChangePeople(): boolean {
    return may(this.#everywhere, "ChangePeople") && this.onlyTree.value === null;
  }

  /** Whether they have programs that act as themselves, or had some, and perhaps a password of their own (`AC21`). */
  get mayOwnTokens(): boolean {
    const isUser = this.me.value?.way === "login";
    return (isUser || may(this.#everywhere, "OwnTokens")) && this.onlyTree.value === null;
  }

  /** Whether they may let one more program act as themselves. */
  get mayMakeTokens(): boolean {
    return may(this.#everywhere, "MakeToken") && this.onlyTree.value === null;
  }

  /** Whether they may see how the server is (`SV2`). */
  get maySeeServer(): boolean {
    return may(this.#everywhere, "SeeServer") && this.onlyTree.value === null;
  }

  /** Whether they may have trees grown into files. */
  get mayOrder(): boolean {
    return may(this.#everywhere, "GrowTrees") && this.onlyTree.value === null;
  }

  /** They may do with the open tree what this role may, from now on; perhaps because they may it everywhere. */
  grant(role: Role): void {
    this.here.value = role;
    void this.ask().catch(() => {});
  }

  /** Another tree is opened, of which nothing is said yet, or in which everybody does the same. */
  leave(role: Role | null = null): void {
    this.here.value = role;
  }

  get #everywhere(): Role {
    return this.me.value?.role ?? "owner";
  }

  get #here(): Role {
    return this.here.value ?? this.#everywhere;
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
  return (
    typeof value === "object" &&
    value !== null &&
    "role" in value &&
    (value.role === "none" || ROLES.includes(value.role as Role))
  );
}
