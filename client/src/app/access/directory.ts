import { signal } from "@preact/signals";
import type { ChangeGroup, ChangeUser, ListedGroup, ListedUser, NewGroup, NewUser } from "../../wire/generated";
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

/** Who can log in, and the groups in which some of them may more. */
export class Directory {
  /** By name; null until they are known. */
  readonly users = signal<readonly ListedUser[] | null>(null);
  readonly groups = signal<readonly ListedGroup[] | null>(null);
  /** Why they are not known; null where nothing is wrong. */
  readonly failure = signal<unknown>(null);
  /** Whether something is being done. */
  readonly busy = signal(false);
  #options: DirectoryOptions;
  /** Counts the questions: only the newest answer is taken. */
  #asked = 0;

  constructor(options: DirectoryOptions) {
    this.#options = options;
  }

  /** Asks who there is; where that fails, what was known stays. */
  async look(): Promise<void> {
    const turn = ++this.#asked;
    this.failure.value = null;
    try {
      const { api } = this.#options;
      const [users, groups] = await Promise.all([api.listUsers(), api.listGroups()]);
      if (turn === this.#asked) {
        this.users.value = users;
        this.groups.value = groups;
      }
    } catch (error) {
      if (turn === this.#asked && this.users.peek() === null) {
        this.failure.value = error;
      }
    }
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
  async #do(act: (api: PeopleApi) => Promise<unknown>): Promise<boolean> {
    if (this.busy.peek()) {
      return false;
    }
    this.busy.value = true;
    let isDone = true;
    try {
      await act(this.#options.api);
    } catch (error) {
      this.#options.failed(error);
      isDone = false;
    }
    await this.look();
    this.busy.value = false;
    return isDone;
  }
}

/** What somebody else has removed already is removed. */
export async function gone(removal: Promise<unknown>): Promise<void> {
  try {
    await removal;
  } catch (error) {
    if (!(error instanceof RequestFailed && error.status === 404)) {
      throw error;
    }
  }
}
