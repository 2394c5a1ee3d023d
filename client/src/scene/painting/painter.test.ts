import { describe, expect, it, vi } from "vitest";
import type { Levels } from "./leaf-atlas";
import type { Order } from "./paint";
import { Painter, type PaintWorker } from "./painter";

const bark = (kind: "furrowed" | "papery" | "smooth"): Order => ({ sort: "bark", kind, coarse: true });

/** A worker that paints when the test says so. */
class SlowWorker implements PaintWorker {
  onmessage: PaintWorker["onmessage"] = null;
  onerror: PaintWorker["onerror"] = null;
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
    const worker = new SlowWorker();
    const painter = new Painter(undefined, () => worker);
    const done: string[] = [];
    painter.order(bark("furrowed"), () => done.push("furrowed"));
    painter.order(bark("papery"), () => done.push("papery"));
    expect(worker.orders).toEqual([bark("furrowed")]);
    worker.finish();
    expect(worker.orders).toEqual([bark("furrowed"), bark("papery")]);
    worker.finish();
    expect(done).toEqual(["furrowed", "papery"]);
  });

  it("paints coarse pictures before whole ones", () => {
    const worker = new SlowWorker();
    const painter = new Painter(undefined, () => worker);
    const whole = { ...bark("furrowed"), coarse: false } as Order;
    for (const order of [whole, whole, bark("papery"), whole, bark("smooth")]) painter.order(order, () => {});
    for (let i = 0; i < 4; i += 1) worker.finish();
    expect(worker.orders).toEqual([whole, bark("papery"), bark("smooth"), whole, whole]);
  });

  it("never brings what was called off", () => {
    const worker = new SlowWorker();
    const painter = new Painter(undefined, () => worker);
    const done = vi.fn();
    const first = painter.order(bark("furrowed"), done);
    const second = painter.order(bark("papery"), done);
    painter.order(bark("smooth"), () => done("smooth"));
    first();
    second();
    worker.finish();
    worker.finish();
    expect(worker.orders).toEqual([bark("furrowed"), bark("smooth")]);
    expect(done.mock.calls).toEqual([["smooth"]]);
  });

  it("tells of a picture after it was taken", () => {
    const worker = new SlowWorker();
    const heard: string[] = [];
    const painter = new Painter(
      ({ kind }) => heard.push(`${kind} painted`),
      () => worker,
    );
    painter.order(bark("furrowed"), () => heard.push("done"));
    worker.finish();
    expect(heard).toEqual(["done", "furrowed painted"]);
  });

  it("paints on the page where there is no worker", async () => {
    const painter = new Painter(undefined, () => {
      throw new Error("none here");
    });
    const [painted] = await new Promise<Levels[]>((done) => painter.order(bark("papery"), done));
    expect(painted!.colour[0]!.some((texel) => texel > 0)).toBe(true);
  });

  it("does what a broken worker left undone", async () => {
    const worker = new SlowWorker();
    const painter = new Painter(undefined, () => worker);
    const painted = new Promise<Levels[]>((done) => painter.order(bark("papery"), done));
    worker.onerror?.();
    expect(worker.terminated).toBe(true);
    expect((await painted)[0]!.relief).toHaveLength(1);
  });

  it("says once that nothing can be painted, and paints nothing more", async () => {
    const failed = vi.fn();
    const load = vi.fn(() => Promise.reject(new Error("gone")));
    const start = () => {
      throw new Error("none here");
    };
    const painter = new Painter(undefined, start, failed, load);
    const done = vi.fn();
    painter.order(bark("papery"), done);
    painter.order(bark("smooth"), done);
    await vi.waitFor(() => expect(failed).toHaveBeenCalledOnce());
    expect(painter.lost).toBe(true);
    painter.order(bark("furrowed"), done);
    await Promise.resolve();
    expect([load.mock.calls.length, failed.mock.calls.length, done.mock.calls.length]).toEqual([1, 1, 0]);
  });
});
