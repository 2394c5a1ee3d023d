import { afterEach, expect, test, vi } from "vitest";
import { Exports } from "./exports";

afterEach(() => vi.unstubAllGlobals());

/** The paths that are asked while a file is made, and what it is called. */
async function asked(session: string | null, saved: { id: string; version: number } | null) {
  const paths: string[] = [];
  vi.stubGlobal("fetch", async (path: string) => {
    paths.push(new URL(path, "http://here").pathname);
    return new Response("tree", { headers: { "content-length": "4" } });
  });
  const given: string[] = [];
  const exports = new Exports({
    session: () => session,
    photograph: async () => new Blob(),
    give: (_, name) => void given.push(name),
    failed: (error) => expect.unreachable(String(error)),
  });
  await exports.file("obj", "Oak", new Map(), saved);
  return { paths, given };
}

test("a file is made of the tree on the page", async () => {
  expect(await asked("s", null)).toEqual({ paths: ["/api/v1/sessions/s/tree.obj"], given: ["Oak.obj"] });
});

test("a tree of the library becomes a file whatever is on the page, and where nothing is", async () => {
  const made = { paths: ["/api/v1/trees/ash%2Fwood/versions/3/tree.obj"], given: ["Oak.obj"] };
  expect(await asked("s", { id: "ash/wood", version: 3 })).toEqual(made);
  expect(await asked(null, { id: "ash/wood", version: 3 })).toEqual(made);
});
