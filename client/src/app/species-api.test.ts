import { afterEach, describe, expect, it, vi } from "vitest";
import type { Parameters, Species } from "../wire/generated";
import { isGrown, listSpecies } from "./species-api";

afterEach(() => vi.unstubAllGlobals());

const answer = (body: unknown, status = 200) =>
  vi.stubGlobal("fetch", async () => new Response(JSON.stringify(body), { status }));

describe("species", () => {
  it("are those of the server", async () => {
    answer([{ slug: "oak" }]);
    expect(await listSpecies()).toEqual([{ slug: "oak" }]);
  });

  it("are none where the server knows of none", async () => {
    answer({ code: "not_found", message: "there is nothing at this address" }, 404);
    expect(await listSpecies()).toEqual([]);
  });

  it("a server that is silent is told of", async () => {
    vi.stubGlobal("fetch", async () => {
      throw new TypeError("no network");
    });
    await expect(listSpecies()).rejects.toThrow("does not answer");
  });

  it("the one in force is known by its parameters, as 32-bit floats", () => {
    const parameters = { apical_control: 0.515, buds_per_node: 2, trunk_upward: true, vigor_model: "priority" };
    const oak = { parameters } as unknown as Species;
    const sent = { ...parameters, apical_control: Math.fround(0.515) } as unknown as Parameters;
    expect(isGrown(oak, sent)).toBe(true);
    for (const change of [{ apical_control: 0.516 }, { trunk_upward: false }, { vigor_model: "borchert_honda" }]) {
      expect(isGrown(oak, { ...sent, ...change }), JSON.stringify(change)).toBe(false);
    }
  });
});
