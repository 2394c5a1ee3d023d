import { signal } from "@preact/signals";
import type { OpenedFrame } from "../../wire/envelope";
import type { Author, ServerMessage } from "../../wire/generated";

export type PeopleHere = Extract<ServerMessage, { type: "people" }>;
export type Gathered = Extract<ServerMessage, { type: "gathered" }>;

/** Takes what others do, once the code that shows it is there. */
export interface Listener {
  receive(frame: OpenedFrame): void;
  gathered(call: Gathered): void;
  /** Follows the camera of a device, or none any more. */
  follow(device: number | null): void;
  /** Brings everyone to what this page shows; false where nobody can be told. */
  gather(): boolean;
}

/** What the server tells of others who have the tree open, and who on this page listens. */
export class Together {
  /** Who is here, as was told last; null while nobody knows. */
  readonly people = signal<PeopleHere | null>(null);
  /** Who did what is on the line of time: those whom this page has met, and in a replay whom that names. */
  readonly authors = signal<readonly Author[]>([]);
  /** The device whose camera this page follows. */
  readonly followed = signal<number | null>(null);
  /** How often somebody has brought this page to their view. */
  readonly visits = signal(0);
  listener: Listener | null = null;

  /** These are here now; what they are called is known after they have left as well. */
  meet(here: PeopleHere): void {
    this.people.value = here;
    const known = this.authors.peek();
    const nameOf = (number: number) => known.find(({ person }) => person === number)?.name;
    const renamed = here.people.flatMap(({ person, name }) =>
      name !== undefined && name !== nameOf(person) ? [{ person, name }] : [],
    );
    if (renamed.length > 0) {
      const stays = known.filter((author) => renamed.every(({ person }) => person !== author.person));
      this.authors.value = [...stays, ...renamed];
    }
  }

  /** Nobody tells any more who is here; what people are called who did something stays, and whom this page follows. */
  lost(): void {
    this.people.value = null;
  }

  /** People and devices have other numbers from now on: what is known of them is of nobody. */
  renumbered(): void {
    this.authors.value = [];
    this.followed.value = null;
  }

  /** Another session was opened. */
  forget(): void {
    this.lost();
    this.renumbered();
  }
}
