import { afterEach, describe, expect, it, vi } from "vitest";
import { DEFAULTS } from "./growth-parameters";
import { growSchematic } from "./schematic-api";

afterEach(() => {
  vi.unstubAllGlobals();
  vi.useRealTimers();
});

describe("schematic tree", () => {
  it("SC1: is grown by the server with all the parameters", async () => {
    const asked: unknown[] = [];
    vi.stubGlobal("fetch", async (path: string, { method, body }: RequestInit) => {
      asked.push([path, method, JSON.parse(String(body))]);
      return new Response(JSON.stringify({ segments: [0, 0, 0, 1] }));
    });
    expect(await growSchematic(DEFAULTS)).toEqual({ segments: [0, 0, 0, 1] });
    expect(asked).toEqual([["/api/v1/schematic", "POST", DEFAULTS]]);
  });

  it("a server that never answers is not waited for", async () => {
    vi.useFakeTimers();
    vi.stubGlobal("fetch", () => new Promise(() => undefined));
    const failed = expect(growSchematic(DEFAULTS)).rejects.toThrow();
    await vi.advanceTimersByTimeAsync(5000);
    await failed;
  });
});
