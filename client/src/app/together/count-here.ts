import type { PeopleHere } from "./together";

/** How many people are here, as far as is known, where so many pages are connected: somebody may have several. */
export function countHere(here: PeopleHere | null, pages: number): number {
  if (here === null || here.more > 0) {
    return pages;
  }
  return here.people.filter(({ devices }) => devices.some(({ state }) => state !== "gone")).length;
}
