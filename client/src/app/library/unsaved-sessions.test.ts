import { afterEach, describe, expect, it, vi } from "vitest";
import { forgetSession, unsavedSessions } from "./unsaved-sessions";

function answer(status: number, body?: unknown) {
  const fetch = vi.fn(async () => new Response(body === undefined ? null : JSON.stringify(body), { status }));
  vi.stubGlobal("fetch", fetch);
  return fetch;
}

afterEach(() => vi.unstubAllGlobals());

const OAK = { session: "oak", saved: false, metamers: 7, people: 0, used_at: "2026-05-01T09:00:00.000Z" };

describe("unsaved sessions", () => {
  it("LB11: lists what the server has, with the pictures of this device", async () => {
    const elm = { ...OAK, session: "elm", people: 2, tree: { id: "t/1", name: "Elm", version: 3 } };
    const fetch = answer(200, { sessions: [OAK, elm, { ...OAK, session: "seed", metamers: 0 }] });
    const remembered = [
      { session: "oak", metamers: 3, left: "2025", thumbnail: "data:x" },
      { session: "saved meanwhile", metamers: 3, left: "2025" },
    ];
    expect(await unsavedSessions("machine", remembered)).toEqual([
      { session: "oak", metamers: 7, left: OAK.used_at, people: 0, thumbnail: "data:x" },
      {
        session: "elm",
        metamers: 7,
        left: OAK.used_at,
        people: 2,
        of: "Elm",
        thumbnail: "/api/v1/trees/t%2F1/versions/3/thumbnail",
      },
    ]);
    expect(fetch).toHaveBeenCalledWith("/api/v1/sessions?saved=false&limit=100", expect.anything());
  });

  it("LB11: has the server draw what no device remembers, unless it is large", async () => {
    const large = { ...OAK, session: "wood", metamers: 400_000 };
    answer(200, { sessions: [{ ...OAK, session: "a b" }, large] });
    const pictures = (await unsavedSessions("machine", [])).map(({ thumbnail }) => thumbnail);
    expect(pictures).toEqual(["/api/v1/sessions/a%20b/tree.png?size=240x240", undefined]);
  });

  it("LB11: who has logged in sees their own", async () => {
    const fetch = answer(200, { sessions: [] });
    await unsavedSessions("login", []);
    expect(fetch).toHaveBeenCalledWith("/api/v1/sessions?saved=false&limit=100&mine=true", expect.anything());
  });

  it("takes one off the list", async () => {
    const fetch = answer(204);
    await forgetSession("a/b");
    expect(fetch).toHaveBeenCalledWith("/api/v1/sessions/a%2Fb", expect.objectContaining({ method: "DELETE" }));
  });
});
