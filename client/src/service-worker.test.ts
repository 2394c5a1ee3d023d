import { readFileSync } from "node:fs";
import { join } from "node:path";
import { afterEach, describe, expect, it, vi } from "vitest";

const source = readFileSync(join(import.meta.dirname, "service-worker.js"), "utf8");

afterEach(() => vi.useRealTimers());

/** The worker over a network and what is kept; gives what it answers to a navigation. */
function setUp(network: () => Promise<string>, shell: string | null = "kept page", path = "/s/oak") {
  vi.useFakeTimers();
  const heard: Record<string, (event: unknown) => void> = {};
  const self = {
    addEventListener: (name: string, listener: (event: unknown) => void) => {
      heard[name] = listener;
    },
    location: { origin: "http://here" },
  };
  const caches = {
    open: async () => ({ match: async (path: string) => (path === "/" ? (shell ?? undefined) : undefined) }),
  };
  new Function("self", "caches", "fetch", source)(self, caches, network);
  let answer: Promise<string | undefined> = Promise.resolve("the browser's own");
  heard.fetch!({
    request: { method: "GET", url: `http://here${path}`, mode: "navigate" },
    respondWith: (promise: Promise<string>) => {
      answer = promise;
    },
  });
  return answer;
}

const slow = (milliseconds: number, text: string) => () =>
  new Promise<string>((resolve) => setTimeout(() => resolve(text), milliseconds));

describe("service worker", () => {
  it("gives the server's page while the server answers", async () => {
    const answer = setUp(slow(2500, "server's page"));
    await vi.advanceTimersByTimeAsync(2600);
    expect(await answer).toBe("server's page");
  });

  it("does not wait for a network that hangs", async () => {
    const answer = setUp(() => new Promise(() => {}));
    await vi.advanceTimersByTimeAsync(3100);
    expect(await answer).toBe("kept page");
  });

  it("gives what is kept at once where there is no network", async () => {
    const answer = setUp(() => Promise.reject(new TypeError("offline")));
    await vi.advanceTimersByTimeAsync(0);
    expect(await answer).toBe("kept page");
  });

  it("leaves the API, its page and what is downloaded to the browser", async () => {
    for (const path of ["/api", "/api/v1/sessions/oak/tree.glb", "/api/v1/openapi.json"]) {
      const answer = setUp(() => new Promise(() => {}), "kept page", path);
      await vi.advanceTimersByTimeAsync(3100);
      expect(await answer, path).toBe("the browser's own");
    }
  });

  it("goes on waiting where nothing is kept", async () => {
    const answer = setUp(slow(9000, "late page"), null);
    await vi.advanceTimersByTimeAsync(9100);
    expect(await answer).toBe("late page");
  });
});
