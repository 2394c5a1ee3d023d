import { afterEach, expect, it, vi } from "vitest";
import { RequestFailed } from "../requests/request";
import { Rights } from "./rights";

afterEach(() => vi.unstubAllGlobals());

function store(kept: Record<string, string> = {}): Storage {
  return {
    getItem: (key: string) => kept[key] ?? null,
    setItem: (key: string, value: string) => {
      kept[key] = value;
    },
  } as unknown as Storage;
}

/** What somebody may: change trees, begin them, have many grown, delete them, let others in for one. */
function rightsOf(rights: Rights): readonly boolean[] {
  return [rights.mayChange.peek(), rights.mayBegin, rights.mayOrder, rights.mayDelete, rights.mayShare];
}

it.each([
  [{ role: "admin" }, [true, true, true, true, true]],
  [{ role: "owner" }, [true, true, true, true, true]],
  [{ role: "editor" }, [true, true, true, false, false]],
  [{ role: "commenter" }, [false, false, false, false, false]],
  [{ role: "viewer" }, [false, false, false, false, false]],
  [{ role: "none" }, [false, false, false, false, false]],
  [{ role: "owner", tree: "ash" }, [true, false, false, false, false]],
  [{ role: "editor", tree: "ash" }, [true, false, false, false, false]],
] as const)("AC8: %j is told what they may", async (me, may) => {
  vi.stubGlobal("fetch", async () => new Response(JSON.stringify({ ...me, way: "device" })));
  const kept = {};
  const rights = new Rights(store(kept));
  expect(rightsOf(rights), "nothing is taken from whoever is not known").toEqual([true, true, true, true, true]);
  await rights.ask();
  expect(rightsOf(rights)).toEqual(may);
  expect(rightsOf(new Rights(store(kept))), "the next page knows it from the start").toEqual(may);
});

it.each([
  [{ role: "editor", way: "login" }, [true, true]],
  [{ role: "none", way: "login" }, [true, false]],
  [{ role: "none", way: "device" }, [false, false]],
  [{ role: "viewer", way: "device", tree: "ash" }, [false, false]],
] as const)("AC21: %j ends programs of their own, and makes them", async (me, may) => {
  vi.stubGlobal("fetch", async () => new Response(JSON.stringify(me)));
  const rights = new Rights(store());
  await rights.ask();
  expect([rights.mayOwnTokens, rights.mayMakeTokens]).toEqual(may);
});

it("AC18: what one may with the open tree is told apart from what one may elsewhere", async () => {
  vi.stubGlobal("fetch", async () => new Response(JSON.stringify({ role: "editor", way: "login" })));
  const kept = {};
  const rights = new Rights(store(kept));
  await rights.ask();
  expect(rights.mayGovern).toBe(false);
  rights.grant("owner");
  await rights.ask();
  expect([rights.mayGovern, rights.mayShare, rights.mayDelete], "of other trees no more than before").toEqual([
    true,
    false,
    false,
  ]);
  expect(new Rights(store(kept)).mayGovern, "nor on the next page").toBe(false);
  rights.grant("commenter");
  expect([rights.mayComment, rights.mayChange.peek(), rights.mayBegin]).toEqual([true, false, true]);
  rights.leave();
  expect([rights.mayChange.peek(), rights.mayGovern]).toEqual([true, false]);
});

it("AC8: what was known stays where the server is silent", async () => {
  vi.stubGlobal("fetch", () => Promise.reject(new Error("no network")));
  const rights = new Rights(store({ "espalier.me": '{"role":"viewer","way":"device"}' }));
  await expect(rights.ask()).rejects.toBeInstanceOf(RequestFailed);
  expect(rights.mayChange.peek()).toBe(false);
  const odd = new Rights(store({ "espalier.me": '{"role":"king"}' }));
  expect(odd.mayChange.peek()).toBe(true);
});

it("AC8: who asks while the question is on its way waits for the same answer", async () => {
  const fetch = vi.fn(async () => new Response(JSON.stringify({ role: "viewer", way: "device" })));
  vi.stubGlobal("fetch", fetch);
  const rights = new Rights(store());
  await Promise.all([rights.ask(), rights.ask()]);
  expect([fetch.mock.calls.length, rights.mayBegin]).toEqual([1, false]);
  await rights.ask();
  expect(fetch, "later the server is asked again").toHaveBeenCalledTimes(2);
});
