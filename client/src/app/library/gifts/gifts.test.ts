import { describe, expect, it } from "vitest";
import type { TreeMember } from "../../../wire/generated";
import { RequestFailed } from "../../requests/request";
import { Gifts } from "./gifts";
import { offeredNames } from "./offered-names";

const refused = (status: number) => new RequestFailed(status, { code: "refused", message: "no" });
const USERS = ["Ann", "Bo"];

/** A server where Ann and Bo log in, and what a page knows of a tree there. */
function desk() {
  let members: TreeMember[] = [];
  const failures: unknown[] = [];
  const trouble: { next: Error | null } = { next: null };
  const troubled = () => {
    const { next } = trouble;
    trouble.next = null;
    if (next) {
      throw next;
    }
  };
  const gifts = new Gifts({
    gift: { kind: "tree", id: "oak", name: "Oak" },
    failed: (error) => failures.push(error),
    api: {
      listMembers: async () => {
        troubled();
        return members;
      },
      addMember: async (_, { name, group = false, role }) => {
        troubled();
        if (group || !USERS.includes(name)) {
          throw new RequestFailed(404, { code: "not_found", reason: "none-such", field: "name", message: "no" });
        }
        const member = { id: `id-${name}`, name, group, role };
        members = [...members.filter((other) => other.id !== member.id), member];
        return member;
      },
      removeMember: async (_, id) => {
        troubled();
        members = members.filter((member) => member.id !== id);
      },
    },
  });
  return { gifts, failures, trouble, names: () => members.map(({ name, role }) => `${name}: ${role}`) };
}

describe("what is given", () => {
  it("AC22: is given, given with another role, and taken back", async () => {
    const { gifts, names, failures } = desk();
    expect(await gifts.give({ name: "Bo", role: "viewer" })).toBe("given");
    expect(await gifts.give({ name: "Bo", role: "editor" })).toBe("given");
    expect(names()).toEqual(["Bo: editor"]);
    const [bo] = gifts.members.value ?? [];
    expect(await gifts.takeBack(bo!)).toBe(true);
    expect([gifts.members.value, failures]).toEqual([[], []]);
  });

  it("AC22: a name of nobody is told apart from what else goes wrong", async () => {
    const { gifts, failures, trouble } = desk();
    expect(await gifts.give({ name: "Bob", role: "viewer" })).toBe("nobody");
    expect(await gifts.give({ name: "Bo", group: true, role: "viewer" })).toBe("nobody");
    expect(failures).toEqual([]);
    trouble.next = refused(403);
    expect(await gifts.give({ name: "Bo", role: "viewer" })).toBe("failed");
    expect([failures, gifts.busy.value]).toEqual([[refused(403)], false]);
  });

  it("AC22: what another has taken back already is taken back", async () => {
    const { gifts, failures, trouble } = desk();
    await gifts.give({ name: "Bo", role: "viewer" });
    const [bo] = gifts.members.value ?? [];
    trouble.next = refused(404);
    expect(await gifts.takeBack(bo!)).toBe(true);
    trouble.next = refused(403);
    expect(await gifts.takeBack(bo!)).toBe(false);
    expect(failures).toEqual([refused(403)]);
  });

  it("says why it is not known, and keeps what was known", async () => {
    const { gifts, trouble } = desk();
    trouble.next = refused(0);
    await gifts.look();
    expect([gifts.members.value, gifts.failure.value]).toEqual([null, refused(0)]);
    await gifts.look();
    expect([gifts.members.value, gifts.failure.value]).toEqual([[], null]);
    trouble.next = refused(0);
    await gifts.look();
    expect([gifts.members.value, gifts.failure.value]).toEqual([[], null]);
  });

  it("two presses give it once", async () => {
    const { gifts, names } = desk();
    const bo = { name: "Bo", role: "viewer" } as const;
    expect(await Promise.all([gifts.give(bo), gifts.give(bo)])).toEqual(["given", "failed"]);
    expect(names()).toEqual(["Bo: viewer"]);
  });
});

it("AC22: names are offered that go on from what is typed, but not of who has it", () => {
  const member = (name: string, group: boolean): TreeMember => ({ id: name, name, group, role: "viewer" });
  const names = ["Ada", "Élodie", "Ludo", "Zoë"];
  expect(offeredNames(names, "", "user", [member("Ada", false)])).toEqual(["Élodie", "Ludo", "Zoë"]);
  expect(offeredNames(names, "LO", "user", [])).toEqual(["Élodie"]);
  expect(offeredNames(names, "d", "user", [])).toEqual(["Ada", "Élodie", "Ludo"]);
  expect(offeredNames(["Paul", "Ulla"], "ul", "user", []), "who begins so comes first").toEqual(["Ulla", "Paul"]);
  expect(offeredNames(["Ada"], " zoe ", "user", [])).toEqual([]);
  expect(offeredNames(["Ada"], "", "group", [member("Ada", false)]), "a user is no group").toEqual(["Ada"]);
});
