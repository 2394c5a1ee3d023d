import { afterEach, expect, it, vi } from "vitest";
import { followPixelRatio } from "./pixel-ratio";

/** A window that can be moved from screen to screen. */
function screens() {
  const queries = new Map<string, EventTarget>();
  vi.stubGlobal("devicePixelRatio", 1);
  vi.stubGlobal("matchMedia", (query: string) => {
    const list = new EventTarget();
    queries.set(query, list);
    return list;
  });
  return (ratio: number) => {
    const left = queries.get(`(resolution: ${globalThis.devicePixelRatio}dppx)`);
    vi.stubGlobal("devicePixelRatio", ratio);
    left?.dispatchEvent(new Event("change"));
  };
}

afterEach(() => vi.unstubAllGlobals());

it("reports another screen's pixels, each time, until it ends", () => {
  const moveTo = screens();
  const ratios: number[] = [];
  const stop = followPixelRatio(() => ratios.push(devicePixelRatio));
  moveTo(2);
  moveTo(1.25);
  moveTo(1);
  expect(ratios).toEqual([2, 1.25, 1]);
  stop();
  moveTo(2);
  expect(ratios.length).toBe(3);
});
