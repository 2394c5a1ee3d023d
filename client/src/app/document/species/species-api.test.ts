import { afterEach, describe, expect, it, vi } from "vitest";
import { listSpecies, pictureOf } from "./species-api";

afterEach(() => vi.unstubAllGlobals());

const answer = (body: unknown, status = 200) =>
  vi.stubGlobal("fetch", async () => new Response(JSON.stringify(body), { status }));

describe("species", () => {
  it("are those of the server", async () => {
    answer([{ slug: "oak" }]);
    expect(await listSpecies()).toEqual([{ slug: "oak" }]);
  });

  it("are none where the server knows of none", async () => {
    answer({ code: "not_found", detail: "there is nothing at this address" }, 404);
    expect(await listSpecies()).toEqual([]);
  });

  it("a server that is silent is reported", async () => {
    vi.stubGlobal("fetch", async () => {
      throw new TypeError("no network");
    });
    await expect(listSpecies()).rejects.toThrow("does not answer");
  });

  it("a server in trouble is not one without species", async () => {
    answer({ code: "unavailable", detail: "starting" }, 503);
    await expect(listSpecies()).rejects.toThrow("starting");
  });

  it("each has an address for its picture", () => {
    expect(pictureOf("cedar-of-lebanon")).toBe("/api/v1/species/cedar-of-lebanon/picture");
  });
});
