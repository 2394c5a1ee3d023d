import type { PeopleHere } from "./together";

/** The number of whoever is at this page; null while nobody has said. */
export function personHere(here: PeopleHere | null): number | null {
  const own = here?.people.find(({ devices }) => devices.some(({ device }) => device === here.you));
  return own?.person ?? null;
}
