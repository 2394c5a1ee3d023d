import { afterEach, describe, expect, it, vi } from "vitest";
import { logIn } from "./account";
import { askToEnter } from "./ask-to-enter";
import { redeem, secretIn } from "./invitation";

afterEach(() => vi.unstubAllGlobals());

/** A server that answers one request after the other. */
function answers(...bodies: object[]) {
  const fetch = vi.fn(async () => new Response(JSON.stringify(bodies.shift()), { status: 200 }));
  vi.stubGlobal("fetch", fetch);
  return fetch;
}

describe("an invitation", () => {
  it("is a link, the end of one, or its code alone", () => {
    for (const text of ["http://192.168.1.7:7700/pair#x_y-1", "#x_y-1", " x_y-1\n"]) {
      expect(secretIn(text)).toBe("x_y-1");
    }
  });

  it("AC3: leads back to where one came from, and nowhere else", async () => {
    for (const [search, path] of [
      ["", "/"],
      ["?to=%2Fs%2Foak", "/s/oak"],
      ["?to=https%3A%2F%2Fevil.example%2Fs%2Foak", "/"],
      ["?to=%2F%2Fevil.example", "/"],
    ] as const) {
      const fetch = answers({ role: "owner" });
      expect(await redeem("code", search)).toBe(path);
      expect(fetch).toHaveBeenCalledWith("/api/v1/redeem", expect.objectContaining({ body: '{"secret":"code"}' }));
    }
  });

  it("AC9: whoever logs in goes back to where they came from", async () => {
    const fetch = answers({ role: "editor" });
    expect(await logIn({ name: "Ada", password: "correct horse" }, "?to=%2Fs%2Foak")).toBe("/s/oak");
    const body = '{"name":"Ada","password":"correct horse"}';
    expect(fetch).toHaveBeenCalledWith("/api/v1/login", expect.objectContaining({ body }));
  });

  it("AC5: leads a guest to the tree that it is for", async () => {
    const fetch = answers({ role: "viewer", tree: "ash" }, { session: "oak" });
    expect(await redeem("code", "")).toBe("/s/oak");
    expect(fetch).toHaveBeenLastCalledWith("/api/v1/sessions", expect.objectContaining({ body: '{"tree":"ash"}' }));
  });

  it("AC3: that was used leads whoever it let in to where it did before, and nobody else", async () => {
    const used = { code: "refused", reason: "no-invitation", detail: "No." };
    const me = { role: "viewer", way: "device", tree: "ash" };
    const out = { code: "refused", reason: "not-let-in", detail: "No." };
    const serve = (asked: Response) =>
      vi.stubGlobal("fetch", async (path: string) => {
        if (path === "/api/v1/me") {
          return asked;
        }
        const isUsed = path === "/api/v1/redeem";
        return new Response(JSON.stringify(isUsed ? used : { session: "oak" }), { status: isUsed ? 404 : 200 });
      });
    serve(new Response(JSON.stringify(me)));
    expect(await redeem("code", "")).toBe("/s/oak");
    serve(new Response(JSON.stringify(out), { status: 401 }));
    await expect(redeem("code", "")).rejects.toMatchObject({ problem: { reason: "no-invitation" } });
  });

  it("is asked for by a page that is not let in", () => {
    const replace = vi.fn();
    const refused = (reason: "not-let-in" | "forbidden") => ({ code: "refused", reason, message: "No." }) as const;
    expect(askToEnter(refused("forbidden"), { pathname: "/", replace })).toBe(false);
    expect(replace).not.toHaveBeenCalled();
    askToEnter(refused("not-let-in"), { pathname: "/", replace });
    expect(replace).toHaveBeenLastCalledWith("/pair");
    askToEnter(refused("not-let-in"), { pathname: "/s/oak", replace });
    expect(replace).toHaveBeenLastCalledWith("/pair?to=%2Fs%2Foak");
  });
});
