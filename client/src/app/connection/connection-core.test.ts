import { describe, expect, it } from "vitest";
import { type Command, type DocumentState, type Parameters, PROTOCOL_VERSION, type Resume } from "../../wire/generated";
import {
  CHECK_EVERY,
  type ClientRecord,
  ConnectionCore,
  type Effect,
  HELD_LONG,
  OPEN_WITHIN,
  PING_AFTER,
  PONG_WITHIN,
  WATCHFUL,
} from "./connection-core";

const state: DocumentState = {
  step: 0,
  metamers: 1,
  axes: 1,
  leaves: 0,
  metamer_budget: 1000,
  budget_reached: false,
  can_undo: false,
  can_redo: false,
  pending_steps: 0,
  people: 1,
  age: 0,
};
const parameters = {} as Parameters;
const undo: Command = { kind: "undo" };

function setUp(options: { record?: ClientRecord; resume?: () => Resume | undefined; random?: number } = {}) {
  let keys = 0;
  const core = new ConnectionCore({
    newKey: () => `key-${++keys}-of-the-test`,
    resume: options.resume ?? (() => undefined),
    random: () => options.random ?? 1,
    ...(options.record ? { record: options.record } : {}),
  });
  const welcome = (
    now: number,
    acknowledged: number,
    extra: { resumed?: boolean; protocol?: number; epoch?: number } = {},
  ) =>
    core.message(now, {
      type: "welcome",
      protocol: extra.protocol ?? PROTOCOL_VERSION,
      session: "s",
      epoch: extra.epoch ?? 7,
      resumed: extra.resumed ?? false,
      acknowledged,
      parameters,
      state,
    });
  const connect = (now = 0, acknowledged = 0) => {
    core.start(now);
    core.opened(now);
    welcome(now, acknowledged);
    core.effects();
  };
  /** Lets the backoff run out and greets again; gives what was sent after the welcome. */
  const reconnect = (acknowledged: number) => {
    core.tick(core.deadline ?? 0);
    core.opened(core.deadline ?? 0);
    core.effects();
    welcome(core.deadline ?? 0, acknowledged, { resumed: true });
    return sentIds(core.effects());
  };
  return { core, welcome, connect, reconnect };
}

function sentIds(effects: Effect[]): number[] {
  return effects.flatMap((effect) =>
    effect.kind === "send" && effect.message.type === "command" ? effect.message.id : [],
  );
}

function kinds(effects: Effect[]): string[] {
  return effects.map((effect) => effect.kind);
}

describe("handshake", () => {
  it("HS1: says hello first, with its key and no resume", () => {
    const { core } = setUp();
    core.start(0);
    expect(core.effects()).toEqual([{ kind: "open" }]);
    core.opened(5);
    const message = { type: "hello", protocol: PROTOCOL_VERSION, client: "key-1-of-the-test" };
    expect(core.effects()).toEqual([{ kind: "send", message }]);
    expect(core.phase).toBe("greeting");
  });

  it("RS1: a returning client says what it holds", () => {
    const held = { epoch: 7, generations: [3, 9], rows: 300 };
    const { core } = setUp({ resume: () => held });
    core.start(0);
    core.opened(0);
    expect(core.effects()[1]).toMatchObject({ message: { type: "hello", resume: held } });
  });

  it("RS1: forgets its rows when the resume was not taken up", () => {
    const { core, welcome } = setUp();
    core.start(0);
    core.opened(0);
    core.effects();
    welcome(0, 0, { resumed: false });
    const done = core.effects().map((effect) => (effect.kind === "message" ? effect.message.type : effect.kind));
    expect(done).toEqual(["forget-rows", "parameters", "state", "programme", "obstacles", "widths"]);
  });

  it("RS2, PS3: people keep their numbers until the server has read the session anew", () => {
    const { core, welcome } = setUp();
    const again = (epoch: number) => {
      core.closed(core.deadline ?? 0, 1006);
      core.tick(core.deadline ?? 0);
      core.opened(core.deadline ?? 0);
      core.effects();
      welcome(core.deadline ?? 0, 0, { epoch });
      return kinds(core.effects()).filter((kind) => kind === "renumbered" || kind === "message")[0];
    };
    core.start(0);
    core.opened(0);
    welcome(0, 0);
    expect(kinds(core.effects()), "nobody had a number").not.toContain("renumbered");
    expect(again(7)).toBe("message");
    expect(again(8), "before anybody is named").toBe("renumbered");
    expect(again(8)).toBe("message");
  });

  it("keeps its rows when the resume was taken up", () => {
    const { core, welcome } = setUp();
    core.start(0);
    core.opened(0);
    core.effects();
    welcome(0, 0, { resumed: true });
    expect(kinds(core.effects())).not.toContain("forget-rows");
  });

  it("HS1: another version asks for a reload and stops", () => {
    const { core, connect } = setUp();
    connect();
    core.closed(1, 4000);
    expect(core.effects()).toEqual([{ kind: "reload" }]);
    expect([core.phase, core.stopReason, core.deadline]).toEqual(["stopped", "version", null]);
  });

  it("HS8: waits as long as the server tells how far it is", () => {
    const { core, welcome } = setUp();
    core.start(0);
    core.opened(0);
    expect(core.loading).toBe(null);
    for (const [at, share] of [
      [7_000, 0],
      [14_000, 0.5],
      [21_000, 0.5],
    ] as const) {
      core.message(at, { type: "loading", share });
      core.tick(at + 1_000);
      expect([core.phase, core.loading]).toEqual(["greeting", share]);
    }
    welcome(22_000, 0);
    expect([core.phase, core.loading]).toEqual(["connected", null]);
  });

  it("HS8: comes back where it is told nothing any more", () => {
    const { core } = setUp();
    core.start(0);
    core.opened(0);
    core.message(1_000, { type: "loading", share: 0.5 });
    core.tick(1_000 + OPEN_WITHIN);
    expect([core.phase, core.loading]).toEqual(["waiting", null]);
    core.tick(core.deadline ?? 0);
    core.opened(core.deadline ?? 0);
    expect(core.loading).toBe(null);
  });

  it("HS3: an unknown session stops for good", () => {
    const { core } = setUp();
    core.start(0);
    core.closed(1, 4003);
    core.wake(2);
    core.tick(1e6);
    expect([core.phase, core.stopReason]).toEqual(["stopped", "unknown-session"]);
  });

  it("HS6: a session that cannot be opened stops for good, with the server's sentence", () => {
    const { core } = setUp();
    core.start(0);
    core.effects();
    core.closed(1, 4007, "The session is damaged: 7.");
    expect(core.effects()).toEqual([{ kind: "cannot-open", sentence: "The session is damaged: 7." }]);
    core.wake(2);
    core.tick(1e6);
    expect([core.phase, core.stopReason, core.effects()]).toEqual(["stopped", "cannot-open", []]);
  });

  it("AC17: who was removed does not come back by themselves, and hears by whom", () => {
    const { core, connect } = setUp();
    connect();
    core.effects();
    core.closed(1, 4005, "removed: Ann");
    expect(core.effects()).toEqual([{ kind: "cannot-open", sentence: "removed: Ann" }]);
    core.wake(2);
    core.tick(1e6);
    expect([core.phase, core.effects()]).toEqual(["stopped", []]);
  });

  it("OP3: a notice is handed on", () => {
    const { core, connect } = setUp();
    connect();
    core.effects();
    const message = { type: "notice", notice: { kind: "damaged", entry: 7 } } as const;
    core.message(1, message);
    expect(core.effects()).toEqual([{ kind: "message", message }]);
  });

  it("HS4: a replaced client goes on under a fresh key", () => {
    const { core, connect, reconnect } = setUp();
    connect();
    core.submit(0, { kind: "stroke_begin", stroke: 1 });
    core.message(1, { type: "acknowledged", id: 1 });
    core.submit(0, { kind: "stroke_end", stroke: 1 });
    core.submit(0, { kind: "bend_end", bend: 1 });
    core.submit(0, undo);
    core.effects();
    core.closed(2, 4004);
    expect(kinds(core.effects())).toEqual(["rekeyed"]);
    expect(core.record().key).toBe("key-2-of-the-test");
    // What begins a stroke or a bend belongs to the old key, so its end is not carried over; the undo is.
    expect(core.record().pending).toEqual([{ id: 1, command: undo }]);
    expect(reconnect(0)).toEqual([1]);
  });
});

describe.each([1001, 1011])("a server that closes with %i", (code) => {
  it("HS5: is come back to, and what it had not acknowledged is sent again", () => {
    const held = { epoch: 7, generations: [3], rows: 200 };
    const { core, connect, welcome } = setUp({ resume: () => held });
    connect();
    core.submit(0, undo);
    core.submit(0, undo);
    core.message(1, { type: "acknowledged", id: 1 });
    core.effects();
    core.closed(2, code);
    expect([core.phase, core.stopReason]).toEqual(["waiting", null]);
    const again = core.deadline ?? Number.NaN;
    core.tick(again);
    expect(kinds(core.effects())).toEqual(["open"]);
    core.opened(again);
    expect(core.effects()).toMatchObject([{ message: { type: "hello", client: "key-1-of-the-test", resume: held } }]);
    welcome(again, 1, { resumed: true });
    expect(sentIds(core.effects())).toEqual([2]);
  });
});

describe("commands", () => {
  it("CM1: numbers commands from 1 and sends them at once", () => {
    const { core, connect } = setUp();
    connect();
    expect([core.submit(0, undo), core.submit(0, undo)]).toEqual([1, 2]);
    expect(sentIds(core.effects())).toEqual([1, 2]);
  });

  it("CM1: keeps commands while offline and sends them in order", () => {
    const { core, connect, reconnect } = setUp();
    connect();
    core.submit(0, undo);
    core.closed(1, 1006);
    core.submit(0, undo);
    core.submit(0, undo);
    expect(sentIds(core.effects())).toEqual([1]);
    expect(reconnect(0)).toEqual([1, 2, 3]);
  });

  it("CM1: does not resend what the welcome acknowledges", () => {
    const { core, connect, reconnect } = setUp();
    connect();
    for (let i = 0; i < 4; i++) core.submit(0, undo);
    core.closed(1, 1006);
    core.effects();
    expect(reconnect(3)).toEqual([4]);
    expect(core.settled).toBe(3);
  });

  it("CM1: sends again through any number of lost sockets", () => {
    const { core, connect, reconnect } = setUp();
    connect();
    core.submit(0, undo);
    core.submit(0, undo);
    for (let i = 0; i < 5; i++) {
      core.closed(core.deadline ?? 0, 1006);
      core.effects();
      expect(reconnect(0)).toEqual([1, 2]);
    }
  });

  it("CM2: an acknowledgement settles everything up to its id", () => {
    const { core, connect } = setUp();
    connect();
    for (let i = 0; i < 3; i++) core.submit(0, undo);
    core.message(1, { type: "acknowledged", id: 2 });
    expect([core.settled, core.unsettled("undo")]).toEqual([2, 1]);
    core.message(1, { type: "acknowledged", id: 1 });
    expect(core.settled).toBe(2);
  });

  it("CM3: a refusal is reported once and counts as settled", () => {
    const { core, connect } = setUp();
    connect();
    core.submit(0, undo);
    core.effects();
    const problem = { code: "refused", reason: "nothing-to-undo", message: "There is nothing to undo." } as const;
    core.message(1, { type: "refused", id: 1, problem });
    core.message(1, { type: "refused", id: 1, problem });
    expect(core.effects()).toEqual([{ kind: "refused", problem, command: undo }]);
    expect([core.settled, core.unsettled("undo")]).toEqual([1, 0]);
  });

  it("CM3: a refused number is sent again, so that no gap arises", () => {
    const { core, connect, reconnect } = setUp();
    connect();
    core.submit(0, undo);
    core.message(1, {
      type: "refused",
      id: 1,
      problem: { code: "out_of_range", reason: "out-of-range", message: "No." },
    });
    core.submit(0, undo);
    core.closed(2, 1006);
    core.effects();
    expect(reconnect(0)).toEqual([1, 2]);
  });

  it("CM1: takes a new key where a gap would be refused", () => {
    const { core, connect, reconnect } = setUp();
    connect();
    for (let i = 0; i < 3; i++) core.submit(0, undo);
    core.message(1, { type: "acknowledged", id: 2 });
    core.closed(2, 1006);
    core.effects();
    expect(reconnect(0)).toEqual([]);
    expect([core.phase, core.record().key]).toEqual(["waiting", "key-2-of-the-test"]);
    expect(reconnect(0)).toEqual([1]);
  });

  it("goes on from what an earlier page left", () => {
    const first = setUp();
    first.connect();
    first.core.submit(0, undo);
    first.core.message(1, { type: "acknowledged", id: 1 });
    first.core.closed(2, 1006);
    first.core.submit(0, { kind: "redo" });
    const second = setUp({ record: first.core.record() });
    second.core.start(0);
    second.core.opened(0);
    expect(second.core.effects()[1]).toMatchObject({ message: { client: "key-1-of-the-test" } });
    second.welcome(0, 1);
    expect(sentIds(second.core.effects())).toEqual([2]);
    expect(second.core.next).toBe(3);
  });
});

describe("a server without room", () => {
  const behind = { code: "too_many", reason: "behind", message: "Wait." } as const;
  const gap = { code: "refused", reason: "number-taken", message: "A gap." } as const;
  const move = (stroke: number): Command => ({ kind: "stroke_end", stroke });
  const strokesIn = (effects: Effect[]) =>
    effects.flatMap((effect) =>
      effect.kind === "send" && effect.message.type === "command"
        ? [[effect.message.id, "stroke" in effect.message.command ? effect.message.command.stroke : "stop"]]
        : [],
    );

  /** Five commands on their way, for the third of which there was no room. */
  function full() {
    const all = setUp();
    all.connect();
    for (let stroke = 1; stroke <= 5; stroke++) all.core.submit(0, move(stroke));
    all.core.effects();
    all.core.message(10, { type: "refused", id: 3, problem: behind });
    return all;
  }
  const drain = ({ core }: ReturnType<typeof setUp>) => {
    core.message(11, { type: "refused", id: 4, problem: gap });
    core.message(12, { type: "refused", id: 5, problem: gap });
  };

  it("LM23: has commands sent again in their order, and nobody is told that they were refused", () => {
    const all = full();
    const { core } = all;
    expect(core.submit(11, move(6))).toBe(6);
    drain(all);
    expect([core.effects(), core.settled, core.deadline]).toEqual([[], 0, 262]);
    core.tick(261);
    expect(core.effects()).toEqual([]);
    core.tick(262);
    expect(strokesIn(core.effects())).toEqual([[3, 3]]);
    core.message(270, { type: "acknowledged", id: 3 });
    expect([strokesIn(core.effects()), core.settled]).toEqual([
      [
        [4, 4],
        [5, 5],
      ],
      3,
    ]);
    core.message(280, { type: "acknowledged", id: 5 });
    expect(strokesIn(core.effects())).toEqual([[6, 6]]);
    core.message(290, { type: "acknowledged", id: 6 });
    expect(core.submit(300, move(7))).toBe(7);
    expect([strokesIn(core.effects()), core.settled]).toEqual([[[7, 7]], 6]);
  });

  it("LM23: what is refused for good when it comes again holds nothing up", () => {
    const all = full();
    const { core } = all;
    drain(all);
    core.tick(262);
    core.effects();
    const problem = { code: "refused", reason: "stroke-gone", message: "It ended." } as const;
    core.message(270, { type: "refused", id: 3, problem });
    core.message(271, { type: "acknowledged", id: 2 });
    const effects = core.effects();
    expect(effects[0]).toEqual({ kind: "refused", problem, command: move(3) });
    expect(strokesIn(effects)).toEqual([
      [4, 4],
      [5, 5],
    ]);
  });

  it("LM23: is asked again, and spoken of once that has taken long", () => {
    const all = full();
    const { core } = all;
    drain(all);
    const held: boolean[] = [];
    for (const until = 10 + 2 * HELD_LONG; (core.deadline ?? until) < until; ) {
      const now = core.deadline!;
      core.tick(now);
      if (strokesIn(core.effects()).length > 0) core.message(now + 1, { type: "refused", id: 3, problem: behind });
      held.push(core.isHeldUp(now + 1));
    }
    expect([held[0], held.at(-1)]).toEqual([false, true]);
    expect(core.phase, "it was heard of all the time").toBe("connected");
    core.tick(core.deadline!);
    core.message(7000, { type: "acknowledged", id: 3 });
    core.message(7010, { type: "acknowledged", id: 5 });
    expect(core.isHeldUp(9999)).toBe(false);
  });

  it("LM23: a stop goes before what waits, and again behind what was done before it", () => {
    const all = full();
    const { core } = all;
    drain(all);
    expect(core.submit(20, { kind: "stop" })).toBe(6);
    expect(strokesIn(core.effects())).toEqual([[3, "stop"]]);
    core.message(30, { type: "acknowledged", id: 3 });
    expect(strokesIn(core.effects())).toEqual([
      [4, 3],
      [5, 4],
    ]);
    expect(core.settled, "the third of the page is still on its way").toBe(2);
    core.message(40, { type: "acknowledged", id: 5 });
    expect(strokesIn(core.effects())).toEqual([
      [6, 5],
      [7, "stop"],
    ]);
    const done = { type: "done", id: 5, step: 1, metamers: 1 } as const;
    core.message(41, done);
    expect(core.effects()).toEqual([{ kind: "message", message: { ...done, id: 4 } }]);
    core.message(50, { type: "acknowledged", id: 7 });
    expect([core.settled, core.submit(60, move(8))]).toEqual([7, 8]);
    expect(strokesIn(core.effects())).toEqual([[8, 8]]);
  });

  it("LM23: a stop that was on its way goes first as well, once", () => {
    const all = setUp();
    const { core } = all;
    all.connect();
    core.submit(0, move(1));
    core.submit(0, { kind: "stop" });
    core.effects();
    core.message(10, { type: "refused", id: 1, problem: behind });
    core.message(11, { type: "refused", id: 2, problem: gap });
    core.tick(core.deadline!);
    expect(strokesIn(core.effects())).toEqual([[1, "stop"]]);
    core.message(300, { type: "acknowledged", id: 1 });
    core.effects();
    core.message(310, { type: "refused", id: 2, problem: behind });
    core.message(311, { type: "refused", id: 3, problem: gap });
    core.tick(core.deadline!);
    expect(strokesIn(core.effects())).toEqual([[2, 1]]);
  });

  it("LM23: what waits is sent after a reconnection, and outlives the page", () => {
    const all = full();
    const { core, reconnect } = all;
    drain(all);
    core.submit(20, { kind: "stop" });
    core.closed(21, 1006);
    core.effects();
    const again = setUp({ record: JSON.parse(JSON.stringify(core.record())) });
    expect(reconnect(2)).toEqual([3, 4, 5, 6, 7]);
    expect(again.core.record().pending.map(({ command }) => command.kind)).toEqual([
      "stroke_end",
      "stroke_end",
      "stop",
      "stroke_end",
      "stroke_end",
      "stroke_end",
      "stop",
    ]);
  });
});

describe("frames", () => {
  it("FL1: answers each frame with its sequence", () => {
    const { core, connect } = setUp();
    connect();
    const frame = { epoch: 7, sequence: 12, catchUp: true };
    expect(core.admits(frame)).toBe(true);
    core.applied(frame);
    expect(core.effects()).toEqual([{ kind: "send", message: { type: "received", sequence: 12 } }]);
  });

  it("FR4: admits the next sequence or a catch-up, nothing else", () => {
    const { core, connect } = setUp();
    connect();
    core.applied({ epoch: 7, sequence: 12, catchUp: true });
    const admits = (sequence: number, catchUp: boolean, epoch = 7) => core.admits({ epoch, sequence, catchUp });
    expect([admits(13, false), admits(14, false), admits(12, false)]).toEqual([true, false, false]);
    expect([admits(40, true), admits(40, true, 8)]).toEqual([true, false]);
  });

  it("frames that stay unreadable are asked for ever less often", () => {
    const { core, connect, welcome } = setUp();
    connect();
    let now = 0;
    const waits = [];
    for (let i = 0; i < 7; i++) {
      // Something may well be read before it fails again.
      core.applied({ epoch: 7, sequence: 1, catchUp: true });
      core.invalid(now);
      waits.push((core.deadline ?? 0) - now);
      now = core.deadline ?? 0;
      core.tick(now);
      core.opened(now);
      welcome(now, 0);
      core.effects();
    }
    expect(waits).toEqual([250, 1000, 4000, 16_000, 60_000, 60_000, 60_000]);
    expect(core.garbled).toBe(7);
    core.invalid(now + 200_000);
    expect(core.garbled, "after a long good time it is as the first").toBe(1);
    expect((core.deadline ?? 0) - now - 200_000).toBe(250);
  });

  it("FR1: an invalid frame connects again without resume", () => {
    const { core, connect } = setUp({ resume: () => ({ epoch: 7, generations: [1], rows: 3 }) });
    connect();
    core.invalid(1);
    expect(kinds(core.effects())).toEqual(["close"]);
    core.tick(core.deadline ?? 0);
    core.opened(1000);
    const hello = core.effects().find((effect) => effect.kind === "send");
    expect(hello).toMatchObject({ message: { type: "hello" } });
    expect(hello).not.toHaveProperty("message.resume");
  });
});

describe("checks", () => {
  const checks = (effects: readonly Effect[]) =>
    effects.filter((effect) => effect.kind === "send" && effect.message.type === "check").length;

  it("CK1: asks after a resume, and after rows were loaded whole only when they change", () => {
    const { core, connect, welcome } = setUp();
    connect();
    core.closed(10, 1006);
    core.tick(core.deadline ?? 0);
    core.opened(core.deadline ?? 0);
    core.effects();
    welcome(1000, 0, { resumed: true });
    expect(checks(core.effects())).toBe(1);
  });

  it("CK1: asks in quiet moments, each minute in which frames came", () => {
    const { core, connect } = setUp();
    connect();
    const quiet = (at: number) => {
      core.tick(at);
      const count = checks(core.effects());
      core.message(at + 1, { type: "pong", nonce: 1, at: 0 });
      core.effects();
      return count;
    };
    expect(quiet(CHECK_EVERY + 1), "no frame came").toBe(0);
    core.applied({ epoch: 7, sequence: 1, catchUp: true });
    expect(quiet(2 * CHECK_EVERY)).toBe(1);
    expect(quiet(2 * CHECK_EVERY + PING_AFTER + 2), "nothing has come since").toBe(0);
    core.applied({ epoch: 7, sequence: 2, catchUp: false });
    expect(quiet(2 * CHECK_EVERY + 3 * PING_AFTER), "that was less than a minute ago").toBe(0);
    expect(quiet(3 * CHECK_EVERY + PING_AFTER)).toBe(1);
  });
});

describe("liveness", () => {
  it("doubles its patience up to 8 s, less when chance says so", () => {
    const { core } = setUp({ random: 1 });
    core.start(0);
    const waits: number[] = [];
    let now = 0;
    for (let i = 0; i < 8; i++) {
      core.closed(now, 1006);
      waits.push((core.deadline ?? 0) - now);
      now = core.deadline ?? 0;
      core.tick(now);
    }
    expect(waits).toEqual([250, 500, 1000, 2000, 4000, 8000, 8000, 8000]);
    const hasty = setUp({ random: 0 }).core;
    hasty.start(0);
    hasty.closed(0, 1006);
    expect(hasty.deadline).toBe(125);
  });

  it("starts over with a short wait after a welcome", () => {
    const { core, reconnect } = setUp();
    core.start(0);
    for (let i = 0; i < 5; i++) {
      core.closed(0, 1006);
      core.tick(core.deadline ?? 0);
    }
    core.closed(0, 1006);
    reconnect(0);
    expect(core.attempts).toBe(0);
  });

  it("asks after silence and gives up without an answer", () => {
    const { core, connect } = setUp();
    connect(0);
    core.tick(PING_AFTER);
    expect(core.effects()).toMatchObject([{ kind: "send", message: { type: "ping" } }]);
    core.tick(PING_AFTER + PONG_WITHIN);
    expect(kinds(core.effects())).toEqual(["close"]);
    expect(core.phase).toBe("waiting");
  });

  it("PS3: while others are shown, notices within four seconds that the server is out of reach", () => {
    const { core, connect } = setUp();
    core.watchful = true;
    connect(0);
    core.tick(WATCHFUL);
    expect(core.effects()).toMatchObject([{ kind: "send", message: { type: "ping" } }]);
    core.tick(2 * WATCHFUL);
    expect([2 * WATCHFUL, core.phase]).toEqual([4000, "waiting"]);
  });

  it("any sign of life answers the question", () => {
    const { core, connect } = setUp();
    connect(0);
    core.tick(PING_AFTER);
    core.heard(PING_AFTER + 100);
    core.effects();
    core.tick(PING_AFTER + PONG_WITHIN);
    expect(core.phase).toBe("connected");
  });

  it("a late timer asks first instead of giving up", () => {
    const { core, connect } = setUp();
    connect(0);
    core.tick(60_000);
    expect(core.phase).toBe("connected");
  });

  it("gives up on a socket that never greets", () => {
    const { core } = setUp();
    core.start(0);
    core.opened(10);
    core.effects();
    core.tick(core.deadline ?? 0);
    expect(kinds(core.effects())).toEqual(["close"]);
    expect(core.phase).toBe("waiting");
  });

  it("does not wait out the backoff when it is woken", () => {
    const { core, connect } = setUp();
    connect();
    core.closed(1, 1006);
    core.wake(2);
    expect(kinds(core.effects())).toEqual(["open"]);
  });
});
