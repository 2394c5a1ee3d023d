import { signal } from "@preact/signals";
import { describe, expect, it } from "vitest";
import type { GuestHere, LinkRole, Person } from "../../wire/generated";
import { RequestFailed } from "../requests/request";
import { Governing } from "./governing";
import type { PeopleHere } from "./together";

const settled = () => new Promise((resolve) => setTimeout(resolve));
const refused = new RequestFailed(403, { code: "refused", message: "no" });

function guest(role: LinkRole): GuestHere {
  return { person: 2, tree: "oak", link: { id: "l", name: "Bo", role, since: "", until: "", used: true } };
}

function here(...people: Partial<Person>[]): PeopleHere {
  const all = people.map((part, i): Person => ({ person: i + 1, role: "owner", devices: [], ...part }));
  return { type: "people", you: 10, people: all, more: 0 };
}

/** A server where Bo came by a link; requests for the guests, and changes, may be held back. */
function desk() {
  let role: LinkRole = "editor";
  const failures: unknown[] = [];
  const changed: LinkRole[] = [];
  const asked = { guests: 0 };
  const held: { guests: (() => void)[] | null; changes: (() => void)[] | null } = { guests: null, changes: null };
  const wait = (place: "guests" | "changes") => {
    const waiting = held[place];
    return waiting === null ? null : new Promise<void>((go) => waiting.push(go));
  };
  const trouble: { next: Error | null } = { next: null };
  const governing = new Governing({
    session: "s",
    failed: (error) => failures.push(error),
    api: {
      listRemovals: async () => [],
      findOwner: async () => ({}),
      listGuests: async () => {
        asked.guests += 1;
        const now = guest(role);
        await wait("guests");
        return [now];
      },
      letBack: async () => {},
      handOver: async () => ({ name: "Bo" }),
      removePerson: async () => {
        throw refused;
      },
      changeLink: async (_tree, _link, next) => {
        await wait("changes");
        const { next: error } = trouble;
        trouble.next = null;
        if (error) {
          throw error;
        }
        role = next;
        changed.push(next);
        return guest(role).link;
      },
    },
  });
  const shown = () => governing.guests.value?.[0]?.link.role;
  return { governing, failures, changed, asked, held, trouble, shown };
}

describe("who governs the open tree", () => {
  it("asks again when somebody comes, goes or may do something else, and not at every move of theirs", async () => {
    const { governing, asked } = desk();
    const people = signal<PeopleHere | null>(here({}));
    const end = governing.follow(people);
    await settled();
    expect(asked.guests).toBe(1);
    people.value = here({ devices: [{ device: 10, state: "away" }] });
    await settled();
    expect(asked.guests, "somebody looks away").toBe(1);
    people.value = here({}, { role: "viewer" });
    await settled();
    people.value = here({}, { role: "editor" });
    await settled();
    expect(asked.guests).toBe(3);
    end();
    people.value = here({});
    await settled();
    expect(asked.guests).toBe(3);
  });

  it("asks once more, however often that is wanted while it waits for an answer", async () => {
    const { governing, asked, held } = desk();
    held.guests = [];
    const all = [1, 2, 3, 4].map(() => governing.look());
    await settled();
    expect(asked.guests).toBe(1);
    for (const go of held.guests.splice(0)) go();
    held.guests = null;
    await Promise.all(all);
    expect(asked.guests).toBe(2);
  });

  it("AC12: of two choices the later one counts, in whatever time the server answers them", async () => {
    const { governing, changed, held, shown } = desk();
    await governing.look();
    held.changes = [];
    const [one] = governing.guests.value ?? [];
    const first = governing.letDo(one!, "viewer");
    const second = governing.letDo(one!, "commenter");
    await settled();
    expect([held.changes.length, shown()], "one at a time, shown at once").toEqual([1, "viewer"]);
    const [go] = held.changes;
    held.changes = null;
    go!();
    await Promise.all([first, second]);
    expect(changed).toEqual(["viewer", "commenter"]);
    expect(shown()).toBe("commenter");
  });

  it("AC12: an answer from before a choice does not take it back", async () => {
    const { governing, held, shown } = desk();
    await governing.look();
    held.guests = [];
    const slow = governing.look();
    await settled();
    const chosen = governing.letDo(governing.guests.value![0]!, "viewer");
    await settled();
    const [go] = held.guests.splice(0);
    const seen: unknown[] = [];
    const end = governing.guests.subscribe(() => seen.push(shown()));
    held.guests = null;
    go!();
    await Promise.all([slow, chosen]);
    end();
    expect(seen).not.toContain("editor");
    expect(shown()).toBe("viewer");
  });

  it("says what is refused, and shows what holds", async () => {
    const { governing, failures, trouble, shown } = desk();
    await governing.look();
    trouble.next = refused;
    await governing.letDo(governing.guests.value![0]!, "viewer");
    expect([failures, shown()]).toEqual([[refused], "editor"]);
    expect(await governing.remove(2)).toBeNull();
    expect(failures).toEqual([refused, refused]);
    expect(await governing.handOver(2)).toBe(true);
  });
});
