import { describe, expect, it } from "vitest";
import type { ListedGroup, ListedUser } from "../../wire/generated";
import { StillBusy } from "../requests/listing";
import { RequestFailed } from "../requests/request";
import { Directory, type DirectoryOptions } from "./directory";

const refused = (status: number) => new RequestFailed(status, { code: "refused", message: "no" });

function user(name: string, revision = 1): ListedUser {
  return { id: `id-${name}`, name, role: "editor", own_role: "editor", groups: [], created_at: "2026-01-01", revision };
}

/** A server with two people and a group, and the directory of a page. */
function desk() {
  let users = [user("Ada"), user("Bo", 3)];
  let group: ListedGroup = { id: "g", name: "Studio", role: "owner", members: [], created_at: "", revision: 1 };
  const failures: unknown[] = [];
  const revisions: number[] = [];
  const trouble: { next: Error | null } = { next: null };
  const troubled = () => {
    const { next } = trouble;
    trouble.next = null;
    if (next) {
      throw next;
    }
  };
  const api: DirectoryOptions["api"] = {
    listUsers: async () => {
      troubled();
      return users;
    },
    listGroups: async () => [group],
    addUser: async ({ name }) => {
      troubled();
      users = [...users, user(name)];
      return user(name);
    },
    changeUser: async (id, change, revision) => {
      revisions.push(revision);
      troubled();
      if (revision !== users.find((one) => one.id === id)?.revision) {
        throw refused(412);
      }
      users = users.map((one) => (one.id === id ? { ...one, ...change, revision: one.revision + 1 } : one));
      return users[0]!;
    },
    removeUser: async (id) => {
      troubled();
      users = users.filter((one) => one.id !== id);
    },
    addGroup: async () => group,
    changeGroup: async (_, change, revision) => {
      revisions.push(revision);
      group = { ...group, ...change, revision: group.revision + 1 };
      return group;
    },
    removeGroup: async () => {},
    setMember: async (_, id, isIn) => {
      troubled();
      group = { ...group, members: isIn ? [...group.members, { id, name: id }] : [] };
      return group;
    },
  };
  const there = {
    users: () => users,
    /** Somebody else does that. */
    change: (name: string, part: Partial<ListedUser>) => {
      users = users.map((one) => (one.name === name ? { ...one, ...part } : one));
    },
  };
  const directory = new Directory({ api, failed: (error) => failures.push(error) });
  return { directory, failures, revisions, trouble, there };
}

describe("who can log in", () => {
  it("is listed with groups, and why not where the server does not say", async () => {
    const { directory, trouble } = desk();
    trouble.next = refused(403);
    await directory.look();
    expect([directory.users.value, directory.failure.value]).toEqual([null, refused(403)]);
    await directory.look();
    expect(directory.failure.value).toBeNull();
    expect(directory.users.value?.map(({ name }) => name)).toEqual(["Ada", "Bo"]);
    expect(directory.groups.value?.map(({ name }) => name)).toEqual(["Studio"]);
    // What is known stays where the server is silent.
    trouble.next = refused(0);
    await directory.look();
    expect([directory.users.value?.length, directory.failure.value]).toEqual([2, null]);
  });

  it("AC19: is changed as it was last seen, so that nobody undoes what another has just done", async () => {
    const { directory, revisions } = desk();
    await directory.look();
    expect(await directory.changeUser("id-Bo", { role: "viewer" })).toBe(true);
    expect(await directory.changeUser("id-Bo", { role: "editor" })).toBe(true);
    expect(await directory.changeGroup("g", { role: "viewer" })).toBe(true);
    expect(revisions).toEqual([3, 4, 1]);
  });

  it("AC19: a role is changed though the password was meanwhile, but not a role that another has changed", async () => {
    const { directory, there, failures } = desk();
    await directory.look();
    there.change("Bo", { revision: 7 });
    expect(await directory.changeUser("id-Bo", { role: "viewer" })).toBe(true);
    expect(there.users().find(({ name }) => name === "Bo")).toMatchObject({ role: "viewer", revision: 8 });
    there.change("Bo", { own_role: "owner", revision: 9 });
    expect(await directory.changeUser("id-Bo", { role: "commenter" })).toBe(false);
    expect(failures).toEqual([refused(412)]);
    // It was looked again: whoever insists now knows what they overwrite.
    expect(await directory.changeUser("id-Bo", { role: "commenter" })).toBe(true);
  });

  it("AC19: what is refused is said, and how it stands is asked again", async () => {
    const { directory, failures, trouble } = desk();
    await directory.look();
    const before = directory.users.value;
    trouble.next = refused(409);
    expect(await directory.removeUser("id-Ada")).toBe(false);
    expect(failures).toEqual([refused(409)]);
    expect(directory.users.value).toEqual(before);
    expect(directory.busy.value).toBe(false);
  });

  it("AC19, AC20: whoever another has removed already is removed", async () => {
    const { directory, failures, trouble } = desk();
    await directory.look();
    trouble.next = refused(404);
    expect(await directory.removeUser("id-Ada")).toBe(true);
    trouble.next = refused(404);
    expect(await directory.setMember("g", "id-Ada", false)).toBe(true);
    // But nobody is in a group that is gone.
    trouble.next = refused(404);
    expect(await directory.setMember("g", "id-Ada", true)).toBe(false);
    expect(failures).toEqual([refused(404)]);
  });

  it("two presses add somebody once", async () => {
    const { directory, failures } = desk();
    await directory.look();
    const added = { name: "Cy", role: "viewer", password: "correct horse" } as const;
    expect(await Promise.all([directory.addUser(added), directory.addUser(added)])).toEqual([true, false]);
    expect(directory.users.value?.map(({ name }) => name)).toEqual(["Ada", "Bo", "Cy"]);
    expect(failures, "and the second says why it did nothing").toEqual([new StillBusy()]);
  });

  it("says where it is not known how it stands after what was done", async () => {
    const { directory, failures, trouble } = desk();
    await directory.look();
    const removing = directory.removeUser("id-Ada");
    await Promise.resolve();
    trouble.next = refused(0);
    expect([await removing, failures]).toEqual([true, [refused(0)]]);
    await directory.look();
    expect(directory.users.value?.map(({ name }) => name)).toEqual(["Bo"]);
  });
});
