import type { ReadonlySignal } from "@preact/signals";
import type { NewMember, TreeMember } from "../../../wire/generated";
import { gone, Listing } from "../../requests/listing";
import { RequestFailed } from "../../requests/request";
import type * as api from "./gift-api";

/** What came of giving something: nobody may be called so; why else it failed has been said. */
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
  readonly members: ReadonlySignal<readonly TreeMember[] | null>;
  /** Why they are not known; null where nothing is wrong. */
  readonly failure: ReadonlySignal<unknown>;
  readonly #options: GiftsOptions;
  readonly #listing: Listing<readonly TreeMember[]>;

  constructor(options: GiftsOptions) {
    const { api, gift, failed } = options;
    this.#options = options;
    this.#listing = new Listing({ ask: () => api.listMembers(gift), failed });
    this.members = this.#listing.known;
    this.failure = this.#listing.failure;
  }

  /** Asks to whom it is given; where that fails, what was known stays. */
  look(): Promise<void> {
    return this.#listing.look();
  }

  /** Gives it to a user or a group, or with another role to who has it. */
  async give(member: NewMember): Promise<Giving> {
    const { api, gift } = this.#options;
    let giving: Giving = "failed";
    await this.#listing.do(async () => {
      try {
        const given = await api.addMember(gift, member);
        giving = "given";
        return (members) =>
          members.some(({ id }) => id === given.id)
            ? members.map((other) => (other.id === given.id ? given : other))
            : [...members, given];
      } catch (error) {
        if (!isOfNobody(error)) {
          throw error;
        }
        giving = "nobody";
        return undefined;
      }
    });
    return giving;
  }

  /** Takes it back; true once they have it no longer. */
  takeBack({ id }: TreeMember): Promise<boolean> {
    const { api, gift } = this.#options;
    return this.#listing.do(async () => {
      await gone(api.removeMember(gift, id));
      return (members) => members.filter((other) => other.id !== id);
    });
  }
}

/** Whether the server knows no user, or no group, by the name that was sent. */
function isOfNobody(error: unknown): boolean {
  return error instanceof RequestFailed && error.problem.reason === "none-such" && error.problem.field === "name";
}
