import { computed, type ReadonlySignal } from "@preact/signals";
import type { ChangeGroup, ChangeUser, ListedGroup, ListedUser, NewGroup, NewUser } from "../../wire/generated";
import { gone, Listing } from "../requests/listing";
import { RequestFailed } from "../requests/request";
import type * as api from "./people-api";

type PeopleApi = Pick<
  typeof api,
  | "listUsers"
  | "addUser"
  | "changeUser"
  | "removeUser"
  | "listGroups"
  | "addGroup"
  | "changeGroup"
  | "removeGroup"
  | "setMember"
>;

export interface DirectoryOptions {
  readonly api: PeopleApi;
  /** Something was not done. */
  readonly failed: (error: unknown) => void;
}

/** Who there is. */
interface Known {
  readonly users: readonly ListedUser[];
  readonly groups: readonly ListedGroup[];
}

/** Who can log in, and the groups in which some of them may more. */
export class Directory {
  /** By name; null until they are known. */
  readonly users = computed(() => this.#listing.known.value?.users ?? null);
  readonly groups = computed(() => this.#listing.known.value?.groups ?? null);
  /** Why they are not known; null where nothing is wrong. */
  readonly failure: ReadonlySignal<unknown>;
  /** Whether something is being done. */
  readonly busy: ReadonlySignal<boolean>;
  readonly #api: PeopleApi;
  readonly #listing: Listing<Known>;

  constructor({ api, failed }: DirectoryOptions) {
    this.#api = api;
    const ask = async () => {
      const [users, groups] = await Promise.all([api.listUsers(), api.listGroups()]);
      return { users, groups };
    };
    this.#listing = new Listing({ ask, failed });
    this.failure = this.#listing.failure;
    this.busy = this.#listing.busy;
  }

  /** Asks who there is; where that fails, what was known stays. */
  look(): Promise<void> {
    return this.#listing.look();
  }

  addUser(user: NewUser): Promise<boolean> {
    return this.#do((api) => api.addUser(user));
  }

  changeUser(id: string, change: ChangeUser): Promise<boolean> {
    const known = () => this.users.peek()?.find((user) => user.id === id);
    const theirs = () => [change.name && known()?.name, change.role && known()?.own_role];
    return this.#do((api) => this.#change(known, theirs, (revision) => api.changeUser(id, change, revision)));
  }

  removeUser(id: string): Promise<boolean> {
    return this.#do((api) => gone(api.removeUser(id)));
  }

  addGroup(group: NewGroup): Promise<boolean> {
    return this.#do((api) => api.addGroup(group));
  }

  changeGroup(id: string, change: ChangeGroup): Promise<boolean> {
    const known = () => this.groups.peek()?.find((group) => group.id === id);
    const theirs = () => [change.name && known()?.name, change.role && known()?.role];
    return this.#do((api) => this.#change(known, theirs, (revision) => api.changeGroup(id, change, revision)));
  }

  removeGroup(id: string): Promise<boolean> {
    return this.#do((api) => gone(api.removeGroup(id)));
  }

  /** Somebody is in a group from now on, or not any more. */
  setMember(group: string, user: string, isIn: boolean): Promise<boolean> {
    return this.#do((api) => (isIn ? api.setMember(group, user, true) : gone(api.setMember(group, user, false))));
  }

  /**
   * Changes what nobody else has changed since it was seen; something else of it, as a password or members, may have
   * changed meanwhile. `seen` gives what is to be changed as it stands.
   */
  async #change(
    known: () => { readonly revision: number } | undefined,
    seen: () => readonly unknown[],
    send: (revision: number) => Promise<unknown>,
  ): Promise<void> {
    const before = JSON.stringify(seen());
    try {
      await send(known()?.revision ?? 0);
    } catch (error) {
      if (!(error instanceof RequestFailed && error.status === 412)) {
        throw error;
      }
      await this.look();
      if (JSON.stringify(seen()) !== before) {
        throw error;
      }
      await send(known()?.revision ?? 0);
    }
  }

  /** Whether it was done; what went wrong is said, and how it stands now is asked in any case. */
  #do(act: (api: PeopleApi) => Promise<unknown>): Promise<boolean> {
    return this.#listing.do(async () => {
      await act(this.#api);
      return undefined;
    });
  }
}
