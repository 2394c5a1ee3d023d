import { afterEach, beforeEach, expect, it, vi } from "vitest";
import type { FrameFence } from "./frame-fence";
import { QualityControl, REST_AFTER } from "./quality";
import { RenderLoop } from "./render-loop";

let frames: FrameRequestCallback[];
let now: number;
const fence = { behind: vi.fn(() => false), set: vi.fn(), forget: vi.fn() };
const draw = vi.fn(() => false);
let loop: RenderLoop;
let notified: boolean[];

/** Lets time pass, and the browser call for a frame. */
function frame(milliseconds = 16): void {
  now += milliseconds;
  for (const callback of frames.splice(0)) callback(now);
}

beforeEach(() => {
  vi.clearAllMocks();
  vi.useFakeTimers();
  frames = [];
  notified = [];
  now = 0;
  vi.stubGlobal("requestAnimationFrame", (callback: FrameRequestCallback) => frames.push(callback));
  vi.stubGlobal("cancelAnimationFrame", () => {});
  vi.stubGlobal("window", globalThis);
  vi.spyOn(performance, "now").mockImplementation(() => now);
  fence.behind.mockReturnValue(false);
  make(new QualityControl());
});

/** A loop whose picture at rest is another than those of its movements. */
function make(control: QualityControl): void {
  loop = new RenderLoop(
    draw,
    () => true,
    (still) => notified.push(still),
    fence as unknown as FrameFence,
    control,
  );
}

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

it("a slow device draws a coarse picture at rest, and finer ones over it until they would take too long", () => {
  const control = new QualityControl(true);
  make(control);
  const scales: number[] = [];
  draw.mockImplementation(() => {
    scales.push(control.quality.scale);
    return false;
  });
  loop.open();
  frame();
  now += REST_AFTER;
  vi.advanceTimersByTime(REST_AFTER);
  for (let i = 0; i < 20 && frames.length > 0; i += 1) frame(8000 * control.quality.cost);
  expect(frames).toEqual([]);
  expect(scales).toEqual([...scales].sort((a, b) => a - b));
  expect(scales[0]).toBe(0.4);
  expect(scales.at(-1)).toBeGreaterThan(0.5);
  expect(notified, "at rest once, when nothing more comes").toEqual([true]);
});

it("what moves meanwhile is drawn at once, without the finer picture", () => {
  const control = new QualityControl(true);
  make(control);
  loop.open();
  frame();
  now += REST_AFTER;
  vi.advanceTimersByTime(REST_AFTER);
  frame();
  expect(control.rising).toBe(true);
  loop.stir();
  frame(3000);
  expect(control.resting).toBe(false);
  expect(control.quality.scale).toBe(0.4);
});
