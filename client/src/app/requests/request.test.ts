import { afterEach, describe, expect, it, vi } from "vitest";
import { deleteComment } from "../comments/comment-api";
import { createSession, findSession, socketAddress } from "../connection/session-api";
import { changeTree, deleteTree, saveVersion } from "../library/library-api";
import { orderTrees } from "../library/variations/job-api";
import { askAs } from "./principal";
import { RequestFailed } from "./request";

function answer(status: number, body: unknown) {
  const fetch = vi.fn(async () => new Response(body === undefined ? null : JSON.stringify(body), { status }));
  vi.stubGlobal("fetch", fetch);
  return fetch;
}

afterEach(() => vi.unstubAllGlobals());

describe("requests", () => {
  it("starts a session from a saved tree", async () => {
    const fetch = answer(201, { session: "oak" });
    expect(await createSession({ tree: "t1" })).toEqual({ session: "oak" });
    expect(fetch).toHaveBeenCalledWith("/api/v1/sessions", expect.objectContaining({ body: '{"tree":"t1"}' }));
  });

  it("AU1: says which client asks, once there is one", async () => {
    const fetch = answer(200, {});
    const headers = () => new Headers((fetch.mock.lastCall as unknown as [string, RequestInit])[1].headers);
    await findSession("oak");
    expect(headers().has("Espalier-Client")).toBe(false);
    askAs(() => "key-of-this-page");
    await changeTree("t", { name: "Oak" });
    expect(headers().get("Espalier-Client")).toBe("key-of-this-page");
    expect(headers().get("Content-Type")).toBe("application/json");
    askAs(() => null);
    await deleteTree("t");
    expect([...headers()]).toEqual([]);
  });

  it("CT5: deletes a comment also from a page that is closed meanwhile", async () => {
    const fetch = answer(204, undefined);
    await deleteComment("oak", 3, 2);
    const path = "/api/v1/trees/oak/threads/3/comments/2";
    expect(fetch).toHaveBeenCalledWith(path, expect.objectContaining({ method: "DELETE", keepalive: true }));
  });

  it("LB2: says which revision it changes, where that matters", async () => {
    const fetch = answer(201, {});
    const matched = () => {
      const [, { headers }] = fetch.mock.lastCall as unknown as [string, RequestInit];
      return new Headers(headers).get("If-Match");
    };
    await saveVersion("t", { session: "oak" }, 7);
    expect(matched()).toBe('"7"');
    await changeTree("t", { name: "Oak" });
    expect(matched()).toBeNull();
  });

  it("IK1: carries the key of what is to be done once", async () => {
    const fetch = answer(202, {});
    await orderTrees({ template: "oak", seeds: "1-2", format: "glb", options: {} }, "a-key");
    const [path, { headers }] = fetch.mock.lastCall as unknown as [string, RequestInit];
    expect([path, new Headers(headers).get("Idempotency-Key")]).toEqual(["/api/v1/grow", '"a-key"']);
  });

  it("tells a missing session from a failing server", async () => {
    answer(404, { code: "not_found", detail: "No such session." });
    expect(await findSession("elm")).toBeNull();
    answer(503, { code: "unavailable", detail: "The disk is full." });
    await expect(findSession("elm")).rejects.toThrow("The disk is full.");
  });

  it("ER1: hands on the server's own sentence", async () => {
    answer(400, { code: "out_of_range", field: "name", allowed: "1 to 80", detail: "The name is too long." });
    const failure = await changeTree("t", { name: "x".repeat(99) }).catch((error: unknown) => error);
    expect(failure).toBeInstanceOf(RequestFailed);
    expect(failure).toMatchObject({ status: 400, problem: { field: "name" }, message: "The name is too long." });
  });

  it("has a sentence where the server gives none", async () => {
    answer(500, undefined);
    await expect(createSession()).rejects.toThrow("500");
    vi.stubGlobal("fetch", async () => {
      throw new TypeError("network");
    });
    await expect(createSession()).rejects.toThrow("does not answer");
  });

  it("an answer without a body is fine", async () => {
    answer(204, undefined);
    await expect(deleteTree("t 1/2")).resolves.toBeUndefined();
  });

  it("keeps names inside their path", async () => {
    const fetch = answer(204, undefined);
    await deleteTree("../x");
    expect(fetch).toHaveBeenCalledWith("/api/v1/trees/..%2Fx", expect.anything());
    expect(socketAddress("a/b", { protocol: "https:", host: "h:1" })).toBe("wss://h:1/api/v1/sessions/a%2Fb/socket");
  });
});
