import { useEffect, useMemo, useRef } from "preact/hooks";
import type { Studio } from "../../studio";
import { changesOf, companions, followersOf, nameOf } from "../../together/people";
import { Room } from "../../together/room";
import type { PeopleHere } from "../../together/together";
import { say } from "../../words/say";
import { Pointers } from "./pointers";

export { CompanyChips } from "./company-chips";

/** Somebody who comes back within so many milliseconds has not left. */
const LEFT_AFTER = 5000;

/** Others who have the tree open: their pointers over the picture, and a note when they come and leave. */
export function Company({ studio }: { studio: Studio }) {
  const place = useRef<HTMLDivElement>(null);
  const room = useMemo(() => new Room(studio), [studio]);
  useEffect(() => {
    const canvas = place.current?.parentElement?.querySelector("canvas");
    return canvas ? room.enter(canvas) : undefined;
  }, [room]);
  useEffect(() => tellOfChanges(studio), [studio]);
  return (
    <div class="company" aria-hidden="true" ref={place}>
      {/* What others point to is not in the copy that is played. */}
      {!studio.link.replaying.value && (
        <Pointers studio={studio} room={room} all={companions(studio.together.people.value)} />
      )}
    </div>
  );
}

/** Notes who comes, who leaves, and who begins to follow this page; a short break is none. */
function tellOfChanges({ together, toasts }: Studio): () => void {
  let before: PeopleHere | null = null;
  const leaving = new Map<number, ReturnType<typeof setTimeout>>();
  const back = (person: number) => {
    const timer = leaving.get(person);
    clearTimeout(timer);
    return leaving.delete(person);
  };
  const stop = together.people.subscribe((here) => {
    if (here === null) {
      before = null;
      return;
    }
    const { came, left } = before === null ? { came: [], left: [] } : changesOf(before, here);
    const followed = new Set(before === null ? [] : followersOf(before).map(({ person }) => person));
    before = here;
    for (const person of followersOf(here)) {
      if (!followed.has(person.person)) {
        toasts.show(say("together.followed", { name: nameOf(person) }));
      }
    }
    for (const person of came) {
      if (!back(person.person)) {
        toasts.show(say("together.came", { name: nameOf(person) }));
      }
    }
    for (const person of left) {
      const gone = () => {
        leaving.delete(person.person);
        toasts.show(say("together.left", { name: nameOf(person) }));
      };
      leaving.set(person.person, setTimeout(gone, LEFT_AFTER));
    }
  });
  return () => {
    stop();
    for (const timer of leaving.values()) {
      clearTimeout(timer);
    }
  };
}
