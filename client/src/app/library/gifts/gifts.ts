import { signal } from "@preact/signals";
import type { NewMember, TreeMember } from "../../../wire/generated";
import { gone } from "../../access/directory";
import { RequestFailed } from "../../requests/request";
import type * as api from "./gift-api";

/** What came of giving something: nobody may be called so. */
export type Giving = "given" | "nobody" | "failed";

export interface GiftsOptions {
  readonly gift: api.Gift;
  readonly api: Pick<typeof api, "listMembers" | "addMember" | "removeMember">;
  /** Something was not done. */
  readonly failed: (error: unknown) => void;
}

/** To whom a tree or a collection is given. */
export class Gifts {
  /** Groups first, by name; null until they are known. */
  readonly members = signal<readonly TreeMember[] | null>(null);
  /** Why they are not known; null where nothing is wrong. */
  readonly failure = signal<unknown>(null);
  /** Whether something is being done. */
  readonly busy = signal(false);
  #options: GiftsOptions;
  /** Counts the questions: only the newest answer is taken. */
  #asked = 0;

  constructor(options: GiftsOptions) {
    this.#options = options;
  }

  /** Asks to whom it is given; where that fails, what was known stays. */
  async look(): Promise<void> {
    const turn = ++this.#asked;
    this.failure.value = null;
    try {
      const members = await this.#options.api.listMembers(this.#options.gift);
      if (turn === this.#asked) {
        this.members.value = members;
      }
    } catch (error) {
      if (turn === this.#asked && this.members.peek() === null) {
        this.failure.value = error;
      }
    }
  }

  /** Gives it to a user or a group, or with another role to who has it. */
  async give(member: NewMember): Promise<Giving> {
    let giving: Giving = "failed";
    await this.#do(async ({ addMember }, gift) => {
      try {
        await addMember(gift, member);
        giving = "given";
      } catch (error) {
        if (!isOfNobody(error)) {
          throw error;
        }
        giving = "nobody";
      }
    });
    return giving;
  }

  /** Takes it back; true once they have it no longer. */
  takeBack({ id }: TreeMember): Promise<boolean> {
    return this.#do(({ removeMember }, gift) => gone(removeMember(gift, id)));
  }

  /** Whether it was done; what went wrong is told, and how it stands now is asked in any case. */
  async #do(act: (api: GiftsOptions["api"], gift: api.Gift) => Promise<void>): Promise<boolean> {
    if (this.busy.peek()) {
      return false;
    }
    this.busy.value = true;
    let isDone = true;
    try {
      await act(this.#options.api, this.#options.gift);
    } catch (error) {
      this.#options.failed(error);
      isDone = false;
    }
    await this.look();
    this.busy.value = false;
    return isDone;
  }
}

/** Whether the server knows no user, or no group, by the name that was sent. */
function isOfNobody(error: unknown): boolean {
  return error instanceof RequestFailed && error.problem.reason === "none-such" && error.problem.field === "name";
}
