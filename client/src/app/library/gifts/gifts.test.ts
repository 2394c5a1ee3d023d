import { describe, expect, it } from "vitest";
import type { TreeMember } from "../../../wire/generated";
import { StillBusy } from "../../requests/listing";
import { RequestFailed } from "../../requests/request";
import { Gifts } from "./gifts";
import { offeredNames } from "./offered-names";
import { TypedName } from "./typed-name";

const refused = (status: number) => new RequestFailed(status, { code: "refused", message: "no" });
const USERS = ["Ann", "Bo"];

/** A server where Ann and Bo log in, and what a page knows of a tree there. */
function desk() {
  let members: TreeMember[] = [];
  const failures: unknown[] = [];
  const trouble: { next: Error | null; silent: boolean } = { next: null, silent: false };
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
        if (trouble.silent) {
          throw refused(0);
        }
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
    expect(failures).toEqual([refused(403)]);
    expect(await gifts.give({ name: "Bo", role: "viewer" }), "and nothing is in the way of more").toBe("given");
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

  it("two presses give it once, and the second says why it did nothing", async () => {
    const { gifts, names, failures } = desk();
    const bo = { name: "Bo", role: "viewer" } as const;
    expect(await Promise.all([gifts.give(bo), gifts.give(bo)])).toEqual(["given", "failed"]);
    expect(names()).toEqual(["Bo: viewer"]);
    expect(failures).toEqual([new StillBusy()]);
  });

  it("AC22: what was given or taken back is listed so where nobody says how it stands", async () => {
    const { gifts, failures, trouble } = desk();
    await gifts.look();
    const listed = () => gifts.members.value?.map(({ name, role }) => `${name}: ${role}`);
    trouble.silent = true;
    await gifts.give({ name: "Ann", role: "viewer" });
    await gifts.give({ name: "Bo", role: "viewer" });
    await gifts.give({ name: "Ann", role: "editor" });
    expect(listed()).toEqual(["Ann: editor", "Bo: viewer"]);
    expect(await gifts.takeBack(gifts.members.value![0]!)).toBe(true);
    expect(listed()).toEqual(["Bo: viewer"]);
    expect(failures, "and it is said each time").toEqual(Array(4).fill(refused(0)));
  });
});

describe("a name that is typed", () => {
  it("goes once it was given, but not what was typed meanwhile", () => {
    const typed = new TypedName();
    typed.type("Bo ");
    const bo = typed.called;
    typed.answered(bo, "failed");
    expect(typed.text.value).toBe("Bo ");
    typed.answered(bo, "given");
    expect(typed.text.value).toBe("");
    typed.type("Ann");
    typed.answered(bo, "given");
    expect(typed.text.value).toBe("Ann");
    typed.type("Bo");
    typed.choose("group");
    typed.answered(bo, "given");
    expect(typed.called, "a group is not a person").toEqual({ kind: "group", name: "Bo" });
  });

  it("says of whom nobody has heard, until something else is typed", () => {
    const typed = new TypedName();
    typed.type("Bob");
    const bob = typed.called;
    typed.type("Bobb");
    typed.answered(bob, "nobody");
    expect([typed.nobody.value, typed.text.value]).toEqual([{ kind: "user", name: "Bob" }, "Bobb"]);
    typed.type("Bo");
    expect(typed.nobody.value).toBeNull();
    typed.answered(typed.called, "nobody");
    typed.choose("group");
    expect(typed.nobody.value).toBeNull();
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
