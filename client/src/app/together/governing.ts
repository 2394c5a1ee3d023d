import { type ReadonlySignal, signal } from "@preact/signals";
import type { GuestHere, KeptOut, LinkRole, RemovedPerson } from "../../wire/generated";
import type { changeLink } from "../library/links/link-api";
import type * as api from "./governing-api";
import type { PeopleHere } from "./together";

type GoverningApi = Pick<
  typeof api,
  "listRemovals" | "findOwner" | "listGuests" | "letBack" | "handOver" | "removePerson"
> & { readonly changeLink: typeof changeLink };

export interface GoverningOptions {
  readonly session: string;
  readonly api: GoverningApi;
  /** Something was not done, or is not known. */
  readonly failed: (error: unknown) => void;
}

/** Who comes to the open tree, who is kept out, and to whom it was handed over, for whoever says so. */
export class Governing {
  /** Who is kept out. */
  readonly removals = signal<readonly KeptOut[]>([]);
  /** To whom the tree was handed over. */
  readonly heir = signal<string | undefined>(undefined);
  /** Who of those here came by a link; null while nobody knows. */
  readonly guests = signal<readonly GuestHere[] | null>(null);
  readonly #options: GoverningOptions;
  /** Counts what is done: an answer to a question from before says nothing of how it stands now. */
  #turn = 0;
  #isWanted = false;
  #looking: Promise<void> | null = null;
  /** What is done, one after the other. */
  #deeds: Promise<unknown> = Promise.resolve();

  constructor(options: GoverningOptions) {
    this.#options = options;
  }

  /** Asks how it stands, one time after the other; however often that is wanted meanwhile, it is asked once more. */
  look(): Promise<void> {
    this.#isWanted = true;
    this.#looking ??= this.#rounds();
    return this.#looking;
  }

  /** Asks now, and whenever others are here or may do something else; what it gives ends that. */
  follow(people: ReadonlySignal<PeopleHere | null>): () => void {
    let before: string | undefined;
    return people.subscribe((here) => {
      // What they hold and whom they follow changes all the time, and nothing of this with it.
      const now = here?.people.map(({ person, role }) => `${person} ${role}`).join();
      if (now !== undefined && now !== before) {
        before = now;
        void this.look();
      }
    });
  }

  /** Lets a guest do more or less; what was chosen last is done last. */
  letDo({ tree, link }: GuestHere, role: LinkRole): Promise<unknown> {
    return this.#do(async ({ changeLink }) => {
      const before = this.guests.peek();
      this.guests.value =
        before?.map((guest) => (guest.link.id === link.id ? { ...guest, link: { ...guest.link, role } } : guest)) ??
        null;
      try {
        await changeLink(tree, link.id, role);
      } catch (error) {
        this.guests.value = before;
        throw error;
      }
    });
  }

  letBack({ id }: KeptOut): Promise<unknown> {
    return this.#do(({ letBack }, session) => letBack(session, id));
  }

  /** The tree is handed over to somebody, or to nobody any more; whether that was done. */
  async handOver(person: number | null): Promise<boolean> {
    return (await this.#do(({ handOver }, session) => handOver(session, person))) !== null;
  }

  /** Removes somebody; null where that was not done. */
  remove(person: number): Promise<RemovedPerson | null> {
    return this.#do(({ removePerson }, session) => removePerson(session, person));
  }

  /** What came of something, null where it was not done; what went wrong is said, and how it stands is asked again. */
  #do<Result>(act: (api: GoverningApi, session: string) => Promise<Result>): Promise<Result | null> {
    const one = async () => {
      const { api, session, failed } = this.#options;
      let result: Result | null = null;
      this.#turn++;
      try {
        result = await act(api, session);
      } catch (error) {
        failed(error);
      }
      this.#turn++;
      await this.look();
      return result;
    };
    const done = this.#deeds.then(one);
    this.#deeds = done;
    return done;
  }

  async #rounds(): Promise<void> {
    const { api, session, failed } = this.#options;
    while (this.#isWanted) {
      this.#isWanted = false;
      const turn = this.#turn;
      try {
        const asked = [api.listRemovals(session), api.findOwner(session), api.listGuests(session)] as const;
        const [removals, owner, guests] = await Promise.all(asked);
        if (turn === this.#turn) {
          this.removals.value = removals;
          this.heir.value = owner.name;
          this.guests.value = guests;
        }
      } catch (error) {
        failed(error);
      }
    }
    this.#looking = null;
  }
}
