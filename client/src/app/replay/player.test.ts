import { signal } from "@preact/signals";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { Timeline } from "../../wire/generated";
import { TimeScale } from "../document/timeline/timeline";
import { ReplayPlayer } from "./player";

/** Two strokes of twenty steps; somebody has gone back to the middle of the second. */
const LINE: Timeline = {
  line: 0,
  step: 30,
  last_step: 40,
  done: 2,
  operations: [
    { kind: "stroke", author: 1, first: 0, last: 20 },
    { kind: "stroke", author: 2, first: 20, last: 40 },
  ],
  futures: [],
};

/** A line of time that follows at once, and frames that are drawn by hand. */
class Line {
  readonly timeline = signal<Timeline | null>(LINE);
  readonly scale = signal(new TimeScale(LINE));
  readonly asked: number[] = [];
  readonly release = vi.fn();
  step = LINE.step;

  pull(step: number): void {
    this.to(step);
  }

  to(step: number): void {
    this.step = step;
    this.asked.push(step);
  }
}

let frames: ((now: number) => void)[] = [];
let now = 0;

/** Draws frames for so long, in milliseconds. */
function draw(milliseconds: number): void {
  for (const end = now + milliseconds; now < end; ) {
    now += 16;
    for (const frame of frames.splice(0)) {
      frame(now);
    }
  }
}

beforeEach(() => {
  frames = [];
  now = 1000;
  vi.stubGlobal("requestAnimationFrame", (frame: (now: number) => void) => frames.push(frame));
  vi.stubGlobal("cancelAnimationFrame", () => {
    frames = [];
  });
});

afterEach(() => vi.unstubAllGlobals());

function playing(): { line: Line; player: ReplayPlayer } {
  const line = new Line();
  const player = new ReplayPlayer(line);
  player.stands();
  player.play();
  return { line, player };
}

describe("a replay", () => {
  it("plays from the first step to where the design stands, and ends there", () => {
    const { line, player } = playing();
    draw(player.length / 2);
    expect(player.playing.value).toBe(true);
    const middle = line.step;
    expect(middle).toBeGreaterThan(0);
    expect(middle).toBeLessThan(30);
    draw(player.length);
    expect(player.playing.value).toBe(false);
    expect(line.step).toBe(30);
    expect(line.asked.every((step, i) => step >= (line.asked[i - 1] ?? 0))).toBe(true);
    expect(line.release).toHaveBeenCalled();
  });

  it("goes on where it was paused, and from the beginning at its end", () => {
    const { line, player } = playing();
    draw(player.length / 2);
    player.toggle();
    const paused = line.step;
    draw(1000);
    expect(line.step).toBe(paused);
    player.toggle();
    draw(100);
    expect(line.step).toBeGreaterThanOrEqual(paused);
    draw(player.length);
    player.toggle();
    draw(50);
    expect(line.step).toBeLessThan(5);
  });

  it("goes at the speed that is chosen, in a circle", () => {
    const { line, player } = playing();
    const speeds = Array.from({ length: 5 }, () => {
      player.faster();
      return player.speed.value;
    });
    expect(speeds).toEqual([2, 4, 8, 0.5, 1]);
    player.faster();
    draw(player.length / 2 + 50);
    expect(line.step).toBe(30);
  });

  it("skips nothing where the page was not drawn for a while", () => {
    const { line, player } = playing();
    draw(100);
    now += 60_000;
    draw(16);
    expect(player.playing.value).toBe(true);
    expect(line.step).toBeLessThan(10);
  });
});
