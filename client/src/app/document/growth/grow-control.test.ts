import { afterEach, beforeEach, expect, it } from "vitest";
import type { Command } from "../../../wire/generated";
import { GrowControl } from "./grow-control";

let beat: FrameRequestCallback | null = null;
beforeEach(() => {
  globalThis.requestAnimationFrame = (callback) => {
    beat = callback;
    return 1;
  };
  globalThis.cancelAnimationFrame = () => {
    beat = null;
  };
});
afterEach(() => {
  Reflect.deleteProperty(globalThis, "requestAnimationFrame");
  Reflect.deleteProperty(globalThis, "cancelAnimationFrame");
});

/** A server that takes commands on and does them when it is told to. */
function held(bud: number | null = null) {
  const sent: Command[] = [];
  const backlog = { unsettled: 0, pending: 0 };
  const growth = new GrowControl({
    submit: (command) => {
      sent.push(command);
      backlog.unsettled += command.kind === "stop" ? 0 : 1;
      return sent.length;
    },
    ready: () => true,
    newGesture: () => 9,
    unsettled: () => backlog.unsettled,
    pendingSteps: () => backlog.pending,
    bud: () => bud,
    hold: () => () => {},
  });
  const frames = (from: number, to: number) => {
    for (let time = from; time < to; time += 16) beat?.(time);
  };
  return { sent, backlog, growth, frames };
}

it("asks for one step at a time, and stops it when it is released", () => {
  const { sent, backlog, growth, frames } = held();
  growth.to(1);
  frames(0, 5000);
  expect(sent, "the server has not answered").toEqual([{ kind: "grow", steps: 1, gesture: 9 }]);
  [backlog.unsettled, backlog.pending] = [0, 1];
  growth.reported();
  frames(5000, 9000);
  expect(sent, "the step is not done").toHaveLength(1);
  backlog.pending = 0;
  growth.reported();
  frames(9000, 9020);
  expect(sent).toHaveLength(2);
  growth.release();
  expect(sent.slice(2)).toEqual([{ kind: "stop" }]);
  expect([growth.isHeld, growth.deflection.value]).toEqual([false, 0]);
});

it("goes on after a step that came to nothing, once it is told that nothing is left to do", () => {
  const { sent, backlog, growth, frames } = held();
  growth.to(-1);
  frames(0, 16);
  backlog.unsettled = 0;
  frames(16, 5000);
  expect(sent, "nothing was reported of it").toHaveLength(1);
  growth.done(1);
  frames(5000, 5016);
  expect(sent).toHaveLength(2);
});

it("waits for no step that another server was asked for", () => {
  const { sent, backlog, growth, frames } = held();
  growth.to(1);
  frames(0, 16);
  growth.release();
  growth.forget();
  backlog.unsettled = 0;
  growth.to(1);
  frames(16, 32);
  expect(sent.map(({ kind }) => kind)).toEqual(["grow", "stop", "grow"]);
});

it("has nothing to stop where nothing is under way, or the tree grows back", () => {
  const { sent, backlog, growth, frames } = held(4);
  growth.to(1);
  frames(0, 32);
  backlog.unsettled = 0;
  growth.reported();
  growth.release();
  growth.to(-1);
  frames(32, 64);
  growth.release();
  growth.release();
  expect(sent).toEqual([
    { kind: "grow", steps: 1, gesture: 9, bud: 4 },
    { kind: "ungrow", steps: 1 },
  ]);
});
