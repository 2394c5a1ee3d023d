import type { Device, Person } from "../../wire/generated";
import { personColour } from "../document/timeline/authors";
import { say } from "../words/say";
import type { PeopleHere } from "./together";

/** A device of somebody else, or another one of one's own. */
export interface Companion {
  readonly device: Device;
  readonly person: Person;
  readonly name: string;
  readonly colour: string;
}

/** What somebody is called. */
export function nameOf({ name, person }: Person): string {
  return name ?? say("together.unnamed", { number: person });
}

/** All devices but this one, by their numbers. */
export function companions(here: PeopleHere | null): Companion[] {
  const all = (here?.people ?? []).flatMap((person) =>
    person.devices.map((device) => ({
      device,
      person,
      name: nameOf(person),
      colour: personColour(person.person),
    })),
  );
  return all.filter(({ device }) => device.device !== here?.you).sort((a, b) => a.device.device - b.device.device);
}

/** What a page that plays a copy of the session says it holds there. */
export const REPLAY = "replay";

/** Whether a device plays the design instead of being at it. */
export function isReplaying({ state, tool }: Device): boolean {
  return state !== "gone" && tool === REPLAY;
}

/** Whether this page's camera is followed. */
export function isFollowed(here: PeopleHere | null): boolean {
  return companions(here).some(({ device }) => device.follows === here?.you);
}

/** Who else sees what this page shows, by their devices. */
export function followersOf(here: PeopleHere): Person[] {
  const { you, people } = here;
  return people.filter(({ devices }) => devices.some(({ device, follows }) => device !== you && follows === you));
}

/** Who has come and who has left, by their numbers. */
export function changesOf(before: PeopleHere, after: PeopleHere): { came: Person[]; left: Person[] } {
  const numbers = ({ people }: PeopleHere) => new Set(people.map(({ person }) => person));
  const [old, now] = [numbers(before), numbers(after)];
  return {
    came: after.people.filter(({ person }) => !old.has(person)),
    left: before.people.filter(({ person }) => !now.has(person)),
  };
}
