import { describe, expect, it } from "vitest";
import { ServerTime } from "./server-time";

/** A page whose clock is off by so much, and a way to the server that takes its time. */
function page({ off, started = 0 }: { off: number; started?: number }) {
  let [now, restarted] = [0, started];
  const asked: number[] = [];
  let connected = true;
  const time = new ServerTime(
    (nonce) => {
      if (connected) asked.push(nonce);
      return connected;
    },
    { now: () => now + off },
  );
  /** One question, which takes so long there and back. */
  const exchange = (there: number, back: number) => {
    now += 20_000;
    time.read();
    now += there;
    const at = now - restarted;
    now += back;
    time.heard(asked.at(-1)!, at);
  };
  return {
    time,
    asked,
    exchange,
    truth: () => now - restarted,
    restart: () => {
      restarted = now;
    },
    cut: () => {
      connected = false;
    },
    pass: (by: number) => {
      now += by;
    },
  };
}

describe("the server’s time", () => {
  it("WD2: is the same on pages whose clocks differ, whenever they came and however slow their ways are", () => {
    const pages = [page({ off: 0 }), page({ off: 3_600_000 }), page({ off: -77_777, started: -9000 })];
    pages.forEach((one, i) => {
      one.exchange(5 + i, 5 + i);
      for (const [there, back] of [
        [40, 300],
        [12, 10],
        [500, 20],
      ] as const) {
        one.exchange(there, back);
      }
      expect(Math.abs(one.time.read() - one.truth())).toBeLessThanOrEqual(2);
    });
  });

  it("goes on from a server that began anew", () => {
    const one = page({ off: 123 });
    for (let i = 0; i < 10; i += 1) one.exchange(5, 5);
    one.restart();
    one.exchange(80, 60);
    expect(Math.abs(one.time.read() - one.truth())).toBeLessThanOrEqual(10);
  });

  it("is the page’s own until the server answers, and asks no more often than it must", () => {
    const one = page({ off: 0 });
    for (let i = 0; i < 60; i += 1) {
      expect(one.time.read()).toBe(one.truth());
      one.pass(16);
    }
    expect(one.asked.length).toBe(1);
    one.time.heard(1, 99_999);
    one.time.heard(one.asked[0]!, Number.NaN);
    expect(one.time.read(), "what nobody asked for, and what is no number, does not count").toBe(one.truth());
    one.cut();
    one.pass(60_000);
    expect(one.time.read()).toBe(one.truth());
  });
});
