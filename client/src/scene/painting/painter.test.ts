import { describe, expect, it, vi } from "vitest";
import type { Levels } from "./leaf-atlas";
import type { Order } from "./paint";
import { type Hand, Painter } from "./painter";

const bark = (kind: "furrowed" | "papery" | "smooth"): Order => ({ sort: "bark", kind, coarse: true });

/** A hand that paints when it is told to. */
class SlowHand implements Hand {
  onmessage: Hand["onmessage"] = null;
  onerror: Hand["onerror"] = null;
  readonly orders: Order[] = [];
  terminated = false;

  postMessage(order: Order): void {
    this.orders.push(order);
  }

  terminate(): void {
    this.terminated = true;
  }

  finish(painted: Levels[] = []): void {
    this.onmessage?.({ data: painted });
  }
}

describe("a painter", () => {
  it("hands one order over at a time, in turn", () => {
    const hand = new SlowHand();
    const painter = new Painter(undefined, () => hand);
    const done: string[] = [];
    painter.order(bark("furrowed"), () => done.push("furrowed"));
    painter.order(bark("papery"), () => done.push("papery"));
    expect(hand.orders).toEqual([bark("furrowed")]);
    hand.finish();
    expect(hand.orders).toEqual([bark("furrowed"), bark("papery")]);
    hand.finish();
    expect(done).toEqual(["furrowed", "papery"]);
  });

  it("never brings what was called off", () => {
    const hand = new SlowHand();
    const painter = new Painter(undefined, () => hand);
    const done = vi.fn();
    const first = painter.order(bark("furrowed"), done);
    const second = painter.order(bark("papery"), done);
    painter.order(bark("smooth"), () => done("smooth"));
    first();
    second();
    hand.finish();
    hand.finish();
    expect(hand.orders).toEqual([bark("furrowed"), bark("smooth")]);
    expect(done.mock.calls).toEqual([["smooth"]]);
  });

  it("tells of a picture after it was taken", () => {
    const hand = new SlowHand();
    const heard: string[] = [];
    const painter = new Painter(
      () => heard.push("told"),
      () => hand,
    );
    painter.order(bark("furrowed"), () => heard.push("done"));
    hand.finish();
    expect(heard).toEqual(["done", "told"]);
  });

  it("paints on the page where there is no worker", async () => {
    const painter = new Painter(undefined, () => {
      throw new Error("none here");
    });
    const [painted] = await new Promise<Levels[]>((done) => painter.order(bark("papery"), done));
    expect(painted!.colour[0]!.some((texel) => texel > 0)).toBe(true);
  });

  it("does what a broken worker left undone", async () => {
    const hand = new SlowHand();
    const painter = new Painter(undefined, () => hand);
    const painted = new Promise<Levels[]>((done) => painter.order(bark("papery"), done));
    hand.onerror?.();
    expect(hand.terminated).toBe(true);
    expect((await painted)[0]!.relief).toHaveLength(1);
  });
});
