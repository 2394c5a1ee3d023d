import { beforeEach, describe, expect, it, vi } from "vitest";
import type { Hint } from "../../wire/generated";
import { handle, type MessageHandlers } from "../connection/page-message";
import { messageHandlers, type SessionTargets } from "../session-events";
import { DrawnInVain } from "./drawn-in-vain";

const stroke: Hint = { id: 3, stroke: 1, reason: "out_of_reach", position: [0, 70, 0] };
const stuck: Hint = { id: 7, stroke: 2, reason: "did_not_reach", position: [0, 20, 0] };
const lasso: Hint = { id: 9, reason: "nothing_grew", position: [4, 2, 0] };

describe("what was drawn in vain", () => {
  let timers: { run: () => void; cancelled: boolean }[] = [];
  const clock = {
    now: () => 0,
    after: (_: number, run: () => void) => {
      const timer = { run, cancelled: false };
      timers.push(timer);
      return () => {
        timer.cancelled = true;
      };
    },
  };
  const pass = () => timers.splice(0).forEach((timer) => void (timer.cancelled || timer.run()));

  beforeEach(() => {
    timers = [];
  });

  it("is shown for a while, however late it comes on the screen", () => {
    const vain = new DrawnInVain(clock);
    vain.show(stroke);
    pass();
    expect(vain.shown.value).toBe(stroke);
    vain.seen();
    pass();
    expect(vain.shown.value).toBeNull();
  });

  it("gives way to the next, which has its whole time", () => {
    const vain = new DrawnInVain(clock);
    vain.show(stroke);
    vain.seen();
    const [first] = timers;
    vain.show(lasso);
    expect(first?.cancelled).toBe(true);
    expect(vain.shown.value).toBe(lasso);
  });

  it("SG2: is what the server hints at", () => {
    const show = vi.fn();
    const trail = { inVain: vi.fn() };
    const page = {
      drawnInVain: { show, clear: vi.fn() },
      trail,
    } as unknown as Partial<SessionTargets> as SessionTargets;
    const handlers: MessageHandlers = messageHandlers(page);
    for (const hint of [stroke, stuck, lasso]) {
      handle(handlers, { type: "hint", hint });
      expect(show).toHaveBeenLastCalledWith(hint);
    }
    expect(trail.inVain.mock.calls, "its ghost is told as well").toEqual([[stroke.stroke], [stuck.stroke]]);
  });
});
