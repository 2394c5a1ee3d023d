import { afterEach, beforeEach, expect, it, vi } from "vitest";
import type { FrameFence } from "./frame-fence";
import { QualityControl } from "./quality";
import { RenderLoop } from "./render-loop";

let frames: FrameRequestCallback[];
let now: number;
const fence = { behind: vi.fn(() => false), set: vi.fn(), forget: vi.fn() };
const draw = vi.fn(() => false);
let loop: RenderLoop;

/** Lets time pass, and the browser call for a frame. */
function frame(milliseconds = 16): void {
  now += milliseconds;
  for (const callback of frames.splice(0)) callback(now);
}

beforeEach(() => {
  vi.clearAllMocks();
  vi.useFakeTimers();
  frames = [];
  now = 0;
  vi.stubGlobal("requestAnimationFrame", (callback: FrameRequestCallback) => frames.push(callback));
  vi.stubGlobal("cancelAnimationFrame", () => {});
  vi.stubGlobal("window", globalThis);
  vi.spyOn(performance, "now").mockImplementation(() => now);
  fence.behind.mockReturnValue(false);
  loop = new RenderLoop(
    draw,
    () => false,
    () => {},
    fence as unknown as FrameFence,
    new QualityControl(),
  );
});
afterEach(() => {
  loop.dispose();
  vi.unstubAllGlobals();
  vi.restoreAllMocks();
  vi.useRealTimers();
});

it("what is asked for is drawn with the next frame, and no more than that", () => {
  loop.invalidate();
  loop.invalidate();
  frame();
  expect(draw).toHaveBeenCalledOnce();
  expect(fence.set).toHaveBeenCalledExactlyOnceWith(now);
  frame();
  expect(draw).toHaveBeenCalledOnce();
});

it("a card that is behind gets nothing more to do, and then the newest", () => {
  fence.behind.mockReturnValue(true);
  for (let i = 0; i < 50; i += 1) {
    loop.stir();
    frame();
  }
  expect(draw).not.toHaveBeenCalled();
  fence.behind.mockReturnValue(false);
  frame();
  expect(draw).toHaveBeenCalledOnce();
});

it("the first picture is asked for while the card gets ready for it", () => {
  fence.behind.mockReturnValue(true);
  fence.forget.mockImplementationOnce(() => fence.behind.mockReturnValue(false));
  loop.open();
  frame();
  expect(draw).toHaveBeenCalledOnce();
});

it("frames that are waited for count as slow, and the next are quicker", () => {
  const scales: number[] = [];
  for (let i = 0; i < 6; i += 1) {
    loop.stir();
    fence.behind.mockReturnValue(true);
    for (let wait = 0; wait < 20; wait += 1) frame();
    fence.behind.mockReturnValue(false);
    frame();
    scales.push(loop.control.quality.scale);
  }
  expect(scales[0]).toBe(1);
  expect(scales.at(-1)).toBeLessThan(0.5);
});
