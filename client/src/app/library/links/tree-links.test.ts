import { describe, expect, it } from "vitest";
import { Virtual } from "../../../../test/virtual-clock";
import type { TreeLink } from "../../../wire/generated";
import { RequestFailed } from "../../requests/request";
import { FIRST_WISH, linkOf } from "./lasting";
import { isOnlyHere } from "./only-here";
import { TreeLinks } from "./tree-links";

const settled = () => new Promise((resolve) => setTimeout(resolve));
const refused = (status: number) => new RequestFailed(status, { code: "refused", message: "No." });

/** A server with the links of one tree. */
function desk() {
  const there: TreeLink[] = [];
  const failures: unknown[] = [];
  const clock = new Virtual();
  const trouble: { next: RequestFailed | null } = { next: null };
  const or = () => {
    const { next } = trouble;
    trouble.next = null;
    if (next) throw next;
  };
  /** Changes that wait for their answer; null where they are answered at once. */
  const held: { changes: (() => void)[] | null } = { changes: null };
  let asked = 0;
  const links = new TreeLinks({
    tree: "oak",
    clock,
    failed: (error) => failures.push(error),
    api: {
      listLinks: async () => {
        asked += 1;
        or();
        return there.map((link) => ({ ...link }));
      },
      makeLink: async (_, { role, name = "" }) => {
        or();
        const id = `link-${there.length}`;
        there.unshift({ id, name, role, since: "", until: "", used: false });
        return { id, url: `http://192.168.1.7:7700/pair#${id}` };
      },
      changeLink: async (_, id, role) => {
        const { changes } = held;
        await (changes && new Promise<void>((go) => changes.push(go)));
        or();
        const found = there.findIndex((link) => link.id === id);
        const changed = { ...there[found]!, role };
        there[found] = changed;
        return changed;
      },
      revokeLink: async (_, id) => {
        or();
        there.splice(
          there.findIndex((link) => link.id === id),
          1,
        );
      },
    },
  });
  return { links, there, failures, clock, trouble, held, asked: () => asked };
}

describe("the links of a tree", () => {
  it("AC12: who was invited may do something else from then on", async () => {
    const { links, there, failures, trouble } = desk();
    await links.make({ role: "editor", name: "Ann" });
    await links.change("link-0", "viewer");
    expect([links.list.value?.[0]?.role, there[0]?.role]).toEqual(["viewer", "viewer"]);
    trouble.next = refused(403);
    await links.change("link-0", "editor");
    expect([failures.length, links.list.value?.[0]?.role]).toEqual([1, "viewer"]);
  });

  it("AC12: of two choices the later one counts, in whatever time the server answers them", async () => {
    const { links, there, held } = desk();
    await links.make({ role: "editor", name: "Ann" });
    held.changes = [];
    const both = Promise.all([links.change("link-0", "viewer"), links.change("link-0", "commenter")]);
    await settled();
    // The server is slow with the first and quick with the second.
    const [first, second] = held.changes;
    held.changes = null;
    second?.();
    first!();
    await both;
    expect([there[0]?.role, links.list.value?.[0]?.role]).toEqual(["commenter", "commenter"]);
  });

  it("AC12: what was changed is shown where it cannot be asked again", async () => {
    const { links, trouble, held } = desk();
    await links.make({ role: "editor", name: "Ann" });
    held.changes = [];
    const changing = links.change("link-0", "viewer");
    await settled();
    const silent = links.look();
    held.changes[0]!();
    await Promise.resolve();
    trouble.next = refused(503);
    await Promise.all([changing, silent]);
    expect(links.list.value?.[0]?.role).toBe("viewer");
  });

  it("AC12: one that is made is listed, and it is seen when somebody comes by it", async () => {
    const { links, there, clock, asked } = desk();
    const end = links.follow();
    await settled();
    expect(links.list.value).toEqual([]);
    await links.make({ role: "editor", name: "Ann" });
    expect(links.fresh.value?.url).toBe("http://192.168.1.7:7700/pair#link-0");
    expect([links.list.value?.[0]?.name, links.came.value, links.making.value]).toEqual(["Ann", false, false]);
    there[0] = { ...there[0]!, used: true };
    clock.pass(3000);
    await settled();
    expect(links.came.value).toBe(true);
    const before = asked();
    clock.pass(30_000);
    expect(asked(), "then nothing is asked any more").toBe(before);
    end();
    links.fresh.value = null;
    clock.pass(30_000);
    expect(asked()).toBe(before);
  });

  it("AC12: one that is revoked goes from the list, its address too", async () => {
    const { links, there, failures, trouble } = desk();
    await links.make({ role: "viewer" });
    await links.revoke("link-0");
    expect([links.list.value, links.fresh.value, there]).toEqual([[], null, []]);
    await links.make({ role: "viewer" });
    trouble.next = refused(503);
    await links.revoke("link-0");
    expect([links.list.value?.length, failures.length]).toEqual([1, 1]);
    // Somebody else was quicker.
    there.splice(0);
    trouble.next = refused(404);
    await links.revoke("link-0");
    expect([links.list.value, failures.length]).toEqual([[], 1]);
  });

  it("says why it is not known, and keeps what was known", async () => {
    const { links, failures, trouble } = desk();
    trouble.next = refused(0);
    await links.look();
    expect([links.list.value, links.failure.value]).toEqual([null, expect.any(RequestFailed)]);
    await links.look();
    expect([links.list.value, links.failure.value]).toEqual([[], null]);
    trouble.next = refused(0);
    await links.look();
    expect([links.list.value, links.failure.value]).toEqual([[], null]);
    trouble.next = refused(400);
    await links.make({ role: "viewer" });
    expect([links.fresh.value, links.making.value, failures.length]).toEqual([null, false, 1]);
  });
});

it("AC12: a link lasts as many hours as are chosen, or as long as they come", () => {
  const hours = (lasting: "day" | "week" | "month" | "year") => linkOf({ ...FIRST_WISH, lasting }, "Guest").hours;
  expect([hours("day"), hours("week"), hours("month"), hours("year")]).toEqual([24, 168, 720, 8760]);
  expect(linkOf({ role: "editor", lasting: "open", name: " Ann " }, "Guest")).toEqual({ role: "editor", name: "Ann" });
  expect(linkOf(FIRST_WISH, "Guest").name).toBe("Guest");
});

it("an address that means the machine itself leads nowhere from another one", () => {
  for (const host of ["127.0.0.1:7700", "localhost", "oak.localhost:80", "[::1]:7700"]) {
    expect(isOnlyHere(`http://${host}/pair#x`), host).toBe(true);
  }
  for (const host of ["192.168.1.7:7700", "trees.example", "notlocalhost", "localhost.example", "127.0.0.1.example"]) {
    expect(isOnlyHere(`http://${host}/pair#x`), host).toBe(false);
  }
});
