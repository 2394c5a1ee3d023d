import { afterEach, describe, expect, it, vi } from "vitest";
import { savedTree } from "../../../test/saved-tree";
import type { SavedTree } from "../../wire/generated";
import { belongingOf, regardless, saveNext } from "./belonging";

/** A library of one tree, and what is asked of it. */
function serve(tree: SavedTree, of = { id: tree.id, version: tree.version, saved: false }) {
  const asked: string[] = [];
  const state = { tree, gone: false, meanwhile: () => {} };
  vi.stubGlobal("fetch", async (path: string, { method, headers }: RequestInit) => {
    asked.push(`${method} ${path}`);
    const answer = (status: number, body: unknown) => new Response(JSON.stringify(body), { status });
    if (path.startsWith("/api/v1/sessions/")) return answer(200, { session: "s", tree: of });
    if (state.gone) return answer(404, { code: "not_found", detail: "There is no such tree." });
    if (method === "GET") return answer(200, state.tree);
    state.meanwhile();
    if (new Headers(headers).get("if-match") !== `"${state.tree.revision}"`)
      return answer(412, { code: "stale", detail: "It has changed." });
    const { version, revision } = state.tree;
    state.tree = { ...state.tree, version: version + 1, revision: revision + 1 };
    return answer(201, { number: version + 1 });
  });
  return { state, asked };
}

afterEach(() => vi.unstubAllGlobals());

const oak = savedTree({ id: "oak", version: 3, revision: 5 });

describe("saving the next version", () => {
  it("follows the one the session comes from", async () => {
    serve(oak);
    const belonging = (await belongingOf("s"))!;
    expect([belonging.version, belonging.saved]).toEqual([3, false]);
    expect(await saveNext(belonging, { session: "s" })).toEqual({ version: { number: 4 } });
  });

  it("another name meanwhile does not keep it back", async () => {
    const { state, asked } = serve(oak);
    const belonging = (await belongingOf("s"))!;
    state.tree = { ...oak, name: "Old oak", revision: 6 };
    expect(await saveNext(belonging, { session: "s" })).toEqual({ version: { number: 4 } });
    expect(asked.filter((one) => one.startsWith("POST")).length).toBe(2);
  });

  it("a version that somebody saved meanwhile is named, and goes before only if one wants it", async () => {
    const { state } = serve(oak);
    const belonging = (await belongingOf("s"))!;
    state.tree = { ...oak, version: 4, revision: 6, author: "Ann" };
    const saving = await saveNext(belonging, { session: "s" });
    expect(saving).toEqual({ overtaken: { tree: state.tree, version: 3, saved: false } });
    if (!("overtaken" in saving)) throw new Error("it was saved");
    state.meanwhile = () => {
      state.tree = { ...state.tree, version: 5, revision: 7 };
      state.meanwhile = () => {};
    };
    const again = await saveNext(regardless(saving.overtaken), { session: "s" });
    expect(again, "nor is the next one lost").toMatchObject({ overtaken: { tree: { version: 5 }, version: 4 } });
    if (!("overtaken" in again)) throw new Error("it was saved");
    expect(await saveNext(regardless(again.overtaken), { session: "s" })).toEqual({ version: { number: 6 } });
  });

  it("a session that goes on with an old version is overtaken from the start", async () => {
    const { asked } = serve(oak, { id: "oak", version: 1, saved: true });
    expect(await saveNext((await belongingOf("s"))!, { session: "s" })).toHaveProperty("overtaken");
    expect(asked.some((one) => one.startsWith("POST"))).toBe(false);
  });

  it("what fails otherwise is no such case", async () => {
    const { state } = serve(oak);
    const belonging = (await belongingOf("s"))!;
    state.gone = true;
    await expect(saveNext(belonging, { session: "s" })).rejects.toThrow("no such tree");
  });
});

describe("a session", () => {
  it("belongs to no tree that is deleted or gone", async () => {
    const { state } = serve({ ...oak, deleted_at: "2026-01-01T00:00:00Z" });
    expect(await belongingOf("s")).toBeNull();
    state.gone = true;
    expect(await belongingOf("s")).toBeNull();
  });
});
