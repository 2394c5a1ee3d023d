import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { Timeline } from "../../../wire/generated";
import { TimelineControl } from "./timeline-control";

const timelineAt = (step: number, last = 40): Timeline => ({
  line: 0,
  step,
  last_step: last,
  done: 2,
  operations: [
    { kind: "stroke", author: 1, first: 0, last: 16 },
    { kind: "growth", author: 1, first: 16, last },
  ],
  futures: [],
});

let frames: FrameRequestCallback[] = [];
let now = 0;

beforeEach(() => {
  frames = [];
  now = 0;
  vi.stubGlobal("requestAnimationFrame", (run: FrameRequestCallback) => frames.push(run));
  vi.stubGlobal("cancelAnimationFrame", () => frames.splice(0));
});
afterEach(() => vi.unstubAllGlobals());

function frame(): void {
  now += 16;
  for (const run of frames.splice(0)) {
    run(now);
  }
}

function control() {
  const server = { unsettled: 0, revision: 0, asked: [] as number[], taken: [] as number[], held: false };
  const time = new TimelineControl({
    goTo: (step) => {
      server.asked.push(step);
      server.unsettled = 1;
    },
    takeFuture: (future) => server.taken.push(future),
    ready: () => true,
    unsettled: () => server.unsettled,
    revision: () => server.revision,
    hold: () => {
      server.held = true;
      return () => {
        server.held = false;
      };
    },
  });
  time.receive(timelineAt(40));
  return { time, server };
}

describe("the playhead", () => {
  it("stands under the pointer and comes to rest at the server's step", () => {
    const { time, server } = control();
    time.pull(30);
    expect(time.step).toBe(30);
    frame();
    time.pull(20);
    frame();
    expect(server.asked).toEqual([30]);
    server.unsettled = 0;
    server.revision += 1;
    time.release();
    frame();
    expect(server.asked).toEqual([30, 20]);
    server.unsettled = 0;
    frame();
    expect([time.wanted.peek(), server.held]).toEqual([20, true]);
    time.receive(timelineAt(20));
    frame();
    expect([time.wanted.peek(), time.step, server.held]).toEqual([null, 20, false]);
    frame();
    expect(server.asked).toEqual([30, 20]);
  });

  it("keeps to the steps there are", () => {
    const { time } = control();
    time.by(9);
    expect(time.step).toBe(40);
    time.by(-99);
    expect(time.step).toBe(0);
  });

  it("goes from operation to operation", () => {
    const { time } = control();
    time.toEdge(-1);
    expect(time.step).toBe(16);
    time.toEdge(-1);
    expect(time.step).toBe(0);
    time.toEdge(1);
    expect(time.step).toBe(16);
  });

  it("lets go when its steps are no longer there", () => {
    const { time, server } = control();
    time.pull(35);
    frame();
    time.receive(timelineAt(10, 10));
    expect([time.wanted.peek(), server.held]).toEqual([null, false]);
  });

  it("lets go of a step the server never tells of", () => {
    const { time, server } = control();
    time.by(-3);
    frame();
    server.unsettled = 0;
    for (let i = 0; i < 60; i += 1) {
      frame();
    }
    expect(time.wanted.peek()).toBeNull();
    expect(server.asked).toEqual([37]);
  });

  it("takes another future from where it stands", () => {
    const { time, server } = control();
    time.pull(12);
    time.take(3);
    frame();
    expect([server.taken, server.asked, time.wanted.peek()]).toEqual([[3], [], null]);
  });
});
