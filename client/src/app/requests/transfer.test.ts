import { describe, expect, it, vi } from "vitest";
import { Exports } from "../library/exports";
import { bytesOf } from "./bytes-of";
import { type Progress, Transfer } from "./transfer";

/** Work that goes on until it is aborted. */
function endless() {
  let [finish, stopped] = [(_: string) => {}, false];
  const work = (signal: AbortSignal) =>
    new Promise<string>((resolve, reject) => {
      finish = resolve;
      signal.addEventListener("abort", () => {
        stopped = true;
        reject(signal.reason);
      });
    });
  return { work, finish: (text: string) => finish(text), stopped: () => stopped };
}

function answer(parts: readonly string[], headers: Record<string, string>): Response {
  const body = new ReadableStream({
    start(controller) {
      for (const part of parts) controller.enqueue(new TextEncoder().encode(part));
      controller.close();
    },
  });
  return new Response(body, { headers });
}

describe("transfer", () => {
  it("shows how far it is while it lasts, and no longer", async () => {
    const transfer = new Transfer();
    const seen: (Progress | null)[] = [];
    const done = transfer.run(async (_, tell) => {
      tell({ bytes: 3, total: 4 });
      seen.push(transfer.progress.peek());
      return "all";
    });
    expect(transfer.progress.peek()).not.toBeNull();
    expect([await done, seen, transfer.progress.peek()]).toEqual(["all", [{ bytes: 3, total: 4 }], null]);
  });

  it("one that is given up ends, and is no failure", async () => {
    const transfer = new Transfer();
    const { work, stopped } = endless();
    const done = transfer.run(work);
    transfer.cancel();
    expect([await done, stopped(), transfer.progress.peek()]).toEqual([null, true, null]);
  });

  it("a second does not begin beside the first", async () => {
    const transfer = new Transfer();
    const { work, finish } = endless();
    const first = transfer.run(work);
    expect(await transfer.run(async () => "second")).toBeNull();
    finish("first");
    expect(await first).toBe("first");
  });

  it("what fails by itself says why", async () => {
    const transfer = new Transfer();
    await expect(transfer.run(() => Promise.reject(new Error("torn")))).rejects.toThrow("torn");
    expect(transfer.progress.peek()).toBeNull();
  });

  it("an answer is read part by part", async () => {
    const reports: Progress[] = [];
    const blob = await bytesOf(answer(["oak", "beech"], { "content-length": "8" }), (now) => void reports.push(now));
    expect(await blob.text()).toBe("oakbeech");
    expect(reports).toEqual([
      { bytes: 3, total: 8 },
      { bytes: 8, total: 8 },
    ]);
  });

  it("a large answer is handed on while it comes, and is whole in the end", async () => {
    const made: number[] = [];
    class Counted extends Blob {
      constructor(parts: BlobPart[], options?: BlobPropertyBag) {
        super(parts, options);
        made.push(parts.filter((part) => part instanceof Uint8Array).length);
      }
    }
    vi.stubGlobal("Blob", Counted);
    const words = ["oak", "beech", "elm", "ash", "larch", "yew"];
    const blob = await bytesOf(answer(words, {}), () => {}, 8);
    vi.unstubAllGlobals();
    expect(await blob.text()).toBe(words.join(""));
    expect(made, "pieces of eight letters or more, and the rest").toEqual([2, 3, 1]);
  });

  it("of a compressed answer nobody knows the length", async () => {
    const reports: Progress[] = [];
    const headers = { "content-length": "2", "content-encoding": "gzip" };
    await bytesOf(answer(["oak"], headers), (now) => void reports.push(now));
    expect(reports).toEqual([{ bytes: 3, total: null }]);
  });
});

describe("exports", () => {
  it("nothing is made without a session", async () => {
    const failures: unknown[] = [];
    const given: string[] = [];
    const exports = new Exports({
      session: () => null,
      photograph: async () => new Blob(),
      give: (_, name) => void given.push(name),
      failed: (error) => void failures.push(error),
    });
    await exports.file("glb", "oak");
    expect([given, failures, exports.transfer.progress.peek()]).toEqual([[], [], null]);
  });

  it("what is asked for while one is made comes after it, in order", async () => {
    const given: string[] = [];
    const open: (() => void)[] = [];
    const exports = new Exports({
      session: () => "s",
      photograph: () => new Promise((done) => open.push(() => done(new Blob()))),
      give: (_, name) => void given.push(name),
      failed: (error) => expect.unreachable(String(error)),
    });
    const all = ["oak", "beech"].map((name) => exports.png(name, { width: 4, height: 3 }));
    await expect.poll(() => open.length).toBe(1);
    open[0]!();
    await expect.poll(() => [open.length, given]).toEqual([2, ["oak.png"]]);
    open[1]!();
    await Promise.all(all);
    expect(given).toEqual(["oak.png", "beech.png"]);
  });

  it("a picture is named after the tree, tells how far it is, and can be given up", async () => {
    const notified: (Progress | null)[] = [];
    const given: string[] = [];
    const failures: unknown[] = [];
    const exports: Exports = new Exports({
      session: () => "s",
      photograph: async ({ width }, stop, tell) => {
        tell(0.5);
        notified.push(exports.picture.progress.peek());
        if (width === 1) exports.picture.cancel();
        if (width === 2) throw new Error("no memory");
        stop.throwIfAborted();
        return new Blob();
      },
      give: (_, name) => void given.push(name),
      failed: (error) => void failures.push(error),
    });
    await exports.png("Old oak", { width: 640, height: 480 });
    await exports.png("given up", { width: 1, height: 1 });
    await exports.png("too large", { width: 2, height: 1 });
    expect(notified[0]).toEqual({ bytes: 50, total: 100 });
    expect(given).toEqual(["Old oak.png"]);
    expect(failures.map(String)).toEqual(["Error: This device could not make the picture. Try a smaller one."]);
  });
});
