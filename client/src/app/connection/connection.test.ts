import { describe, expect, it } from "vitest";
import { FakeSocket } from "../../../test/fake-socket";
import type { Clock } from "../page/clock";
import { type AsideFrame, Connection } from "./connection";
import type { FrameHead } from "./connection-core";

function setUp() {
  const sockets: FakeSocket[] = [];
  const timers: { at: number; run: () => void }[] = [];
  let time = 0;
  const clock: Clock = {
    now: () => time,
    after: (delay, run) => {
      const timer = { at: time + delay, run };
      timers.push(timer);
      return () => timers.splice(timers.indexOf(timer), 1);
    },
  };
  const applied: number[] = [];
  let cleared = 0;
  let reloads = 0;
  const nothing = () => {};
  const asides: [number, number][] = [];
  const heldUp: boolean[] = [];
  const connection = new Connection<FrameHead, AsideFrame>({
    openSocket: () => {
      const socket = new FakeSocket();
      sockets.push(socket);
      return socket;
    },
    clock,
    random: () => 1,
    newKey: () => "a-key-of-the-test",
    rows: {
      held: () => undefined,
      apply: (frame) => {
        if (frame.sequence === 66) {
          throw new Error("does not fit");
        }
        applied.push(frame.sequence);
      },
      clear: () => {
        cleared += 1;
      },
      sum: async () => ({ rows: applied.length, crc32: 7 }),
    },
    decode: async (bytes) => {
      const [sequence = 0, turns = 0, kind = 1, epoch = 1] = new Uint8Array(bytes);
      for (let i = 0; i < turns; i++) await Promise.resolve();
      const frame = { epoch, sequence, catchUp: sequence > 50 };
      return kind === 1 ? { kind, frame } : { kind, frame };
    },
    events: {
      phase: nothing,
      commands: nothing,
      heldUp: (isHeldUp) => {
        if (isHeldUp !== heldUp.at(-1)) heldUp.push(isHeldUp);
      },
      message: nothing,
      aside: ({ kind, frame }) => asides.push([kind, frame.sequence]),
      cannotOpen: nothing,
      refused: nothing,
      rows: nothing,
      rekeyed: nothing,
      renumbered: nothing,
      reload: () => {
        reloads += 1;
      },
    },
  });
  const settle = () => new Promise((resolve) => setTimeout(resolve, 5));
  const pass = (to: number) => {
    time = to;
    for (const timer of timers.filter(({ at }) => at <= to)) {
      timers.splice(timers.indexOf(timer), 1);
      timer.run();
    }
  };
  const socket = (index: number) => sockets[index] as FakeSocket;
  const counts = { cleared: () => cleared, reloads: () => reloads };
  return { connection, socket, sockets, applied, asides, heldUp, ...counts, settle, pass };
}

describe("connection", () => {
  it("FL1: applies frames in order however long each decodes", async () => {
    const { socket, applied, settle } = setUp();
    socket(0).welcome();
    [30, 0, 12, 1].forEach((turns, index) => {
      socket(0).frame(index + 1, turns);
    });
    await settle();
    expect(applied).toEqual([1, 2, 3, 4]);
    expect(socket(0).received).toEqual([1, 2, 3, 4]);
  });

  it("FL1: answers a frame beside the rows with its own number and kind", async () => {
    const { socket, applied, asides, settle } = setUp();
    socket(0).welcome();
    socket(0).frame(1, 20);
    socket(0).frame(9, 0, 3);
    socket(0).frame(2, 0);
    await settle();
    expect(applied).toEqual([1, 2]);
    expect(asides).toEqual([[3, 9]]);
    expect(socket(0).sent.filter(({ kind }) => kind === 3)).toEqual([{ type: "received", sequence: 9, kind: 3 }]);
  });

  it("takes nothing from a frame of another epoch beside the rows", async () => {
    const { socket, sockets, asides, settle } = setUp();
    socket(0).welcome();
    socket(0).frame(1, 0, 2, 7);
    await settle();
    expect([asides, sockets.length]).toEqual([[], 1]);
  });

  it("asks for a ghost only while there is a server", () => {
    const { connection, socket } = setUp();
    expect(connection.tell({ type: "predict", rows: [4], steps: 10 })).toBe(false);
    socket(0).welcome();
    expect(connection.tell({ type: "predict", rows: [4], steps: 10 })).toBe(true);
    expect(socket(0).sent.filter(({ type }) => type === "predict")).toEqual([
      { type: "predict", rows: [4], steps: 10 },
    ]);
  });

  it("FR4: a missing frame opens a new socket", async () => {
    const { socket, sockets, applied, settle, pass } = setUp();
    socket(0).welcome();
    socket(0).frame(1, 0);
    socket(0).frame(3, 0);
    socket(0).frame(4, 0);
    await settle();
    expect([applied, socket(0).closed]).toEqual([[1], true]);
    pass(300);
    expect(sockets.length).toBe(2);
  });

  it("FR1: a frame that does not fit opens a new socket", async () => {
    const { socket, settle } = setUp();
    socket(0).welcome();
    socket(0).frame(66, 0);
    await settle();
    expect(socket(0).closed).toBe(true);
  });

  it("CK1: compares its rows once all frames before the sum are applied", async () => {
    const { socket, settle } = setUp();
    socket(0).welcome();
    socket(0).frame(1, 30);
    socket(0).frame(2, 10);
    socket(0).say({ type: "checksum", sequence: 2, rows: 2, crc32: 7, plant: "0" });
    await settle();
    expect(socket(0).closed, "they are the server's").toBe(false);
    socket(0).say({ type: "checksum", sequence: 1, rows: 9, crc32: 9, plant: "0" });
    await settle();
    expect(socket(0).closed, "a sum of other rows says nothing").toBe(false);
    socket(0).say({ type: "checksum", sequence: 2, rows: 2, crc32: 8, plant: "0" });
    await settle();
    expect(socket(0).closed, "and these are not").toBe(true);
  });

  it("drops frames of a socket that is gone", async () => {
    const { socket, applied, settle, pass } = setUp();
    socket(0).welcome();
    socket(0).frame(1, 20);
    socket(0).end(1006);
    pass(300);
    socket(1).welcome();
    socket(1).frame(60, 0);
    await settle();
    expect(applied).toEqual([60]);
  });

  it("CM1: loses no command when the socket dies", () => {
    const { connection, socket, pass } = setUp();
    socket(0).welcome();
    connection.submit({ kind: "undo" });
    connection.submit({ kind: "undo" });
    socket(0).say({ type: "acknowledged", id: 1 });
    socket(0).end(1006);
    connection.submit({ kind: "redo" });
    pass(300);
    socket(1).welcome(1);
    expect(socket(1).commands).toEqual([2, 3]);
  });

  it("LM23: says that what was done waits once that has taken long, until it is taken", () => {
    const { connection, socket, heldUp, pass } = setUp();
    const behind = { code: "too_many", reason: "behind", message: "Wait." } as const;
    socket(0).welcome();
    connection.submit({ kind: "undo" });
    for (const tried of [250, 750, 1750, 3750]) {
      socket(0).say({ type: "refused", id: 1, problem: behind });
      expect(heldUp).toEqual([false]);
      pass(tried);
    }
    expect([socket(0).commands, heldUp]).toEqual([
      [1, 1, 1, 1, 1],
      [false, true],
    ]);
    socket(0).say({ type: "acknowledged", id: 1 });
    expect(heldUp).toEqual([false, true, false]);
  });

  it("ignores whatever a left session still says", () => {
    const { connection, socket, cleared } = setUp();
    const { onmessage } = socket(0);
    connection.close();
    onmessage?.({ data: JSON.stringify({ type: "pong", nonce: 1 }) } as MessageEvent);
    expect([socket(0).closed, cleared()]).toEqual([true, 0]);
  });

  it("HS1: asks for one reload when the versions differ", () => {
    const { socket, sockets, reloads, pass } = setUp();
    socket(0).begin();
    socket(0).end(4000);
    pass(100_000);
    expect([reloads(), sockets.length]).toEqual([1, 1]);
  });
});
