import { describe, expect, it, vi } from "vitest";
import { Part } from "./part";

const words = async () => {};
const page = (replaced: boolean, answers = true) => ({
  isReplaced: async () => replaced,
  serverAnswers: async () => answers,
  reload: vi.fn(),
  reloadOnce: vi.fn(),
});

describe("a part of the page", () => {
  it("is loaded once, however often it is asked for", async () => {
    const fetch = vi.fn(async () => "panel");
    const part = new Part(fetch, words, page(false));
    await Promise.all([part.load(), part.open()]);
    await part.open();
    expect([part.content.value, fetch.mock.calls.length]).toEqual(["panel", 1]);
  });

  it("is there only with its texts", async () => {
    let learnt = () => {};
    const part = new Part(
      async () => "panel",
      () => new Promise<void>((resolve) => (learnt = resolve)),
      page(false),
    );
    const loading = part.load();
    await Promise.resolve();
    expect(part.content.value).toBeNull();
    learnt();
    await loading;
    expect(part.content.value).toBe("panel");
  });

  it("says that it did not come, and comes when it is asked for again", async () => {
    vi.spyOn(console, "warn").mockImplementation(() => {});
    let online = false;
    const own = page(false);
    const part = new Part(async () => (online ? "panel" : Promise.reject(new Error("offline"))), words, own);
    await part.open();
    expect([part.content.value, part.failure.value]).toEqual([null, "lost"]);
    online = true;
    await part.open();
    expect([part.content.value, part.failure.value]).toEqual(["panel", null]);
    expect(own.reload).not.toHaveBeenCalled();
  });

  it("has the page reloaded where the server has another build, but not before it is needed", async () => {
    vi.spyOn(console, "warn").mockImplementation(() => {});
    const own = page(true);
    const part = new Part(() => Promise.reject(new Error("404")), words, own);
    await part.load();
    expect([part.failure.value, own.reloadOnce.mock.calls.length]).toEqual(["lost", 0]);
    await part.open();
    expect([part.failure.value, own.reloadOnce.mock.calls.length]).toEqual(["replaced", 1]);
  });

  it("is brought by a new page where the browser remembers that it did not come", async () => {
    vi.spyOn(console, "warn").mockImplementation(() => {});
    const [online, offline] = [page(false), page(false, false)];
    for (const own of [online, offline]) {
      await new Part(() => Promise.reject(new Error("remembered")), words, own).again();
    }
    expect([online.reload.mock.calls.length, offline.reload.mock.calls.length]).toEqual([1, 0]);
  });
});
