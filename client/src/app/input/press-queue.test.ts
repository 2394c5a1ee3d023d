import { describe, expect, it } from "vitest";
import { PressQueue } from "./press-queue";

function setUp() {
  const queue = new PressQueue();
  const log: string[] = [];
  const happen = (what: string) => () => void log.push(what);
  let arrive = (_came: boolean) => {};
  const loading = new Promise<boolean>((resolve) => {
    arrive = resolve;
  });
  return { queue, log, happen, loading, arrive: (came: boolean) => arrive(came) };
}

describe("presses", () => {
  it("happen at once where nothing is loaded", () => {
    const { queue, log, happen } = setUp();
    queue.press(happen("down"), null);
    queue.follow(happen("up"));
    expect(log).toEqual(["down", "up"]);
  });

  it("wait with what follows them, and then happen in order", async () => {
    const { queue, log, happen, loading, arrive } = setUp();
    queue.press(happen("down"), loading);
    queue.follow(happen("move"));
    queue.press(happen("second"), null);
    queue.follow(happen("up"));
    expect(log).toEqual([]);
    arrive(true);
    await loading;
    queue.follow(happen("later"));
    expect(log).toEqual(["down", "move", "second", "up", "later"]);
  });

  it("are forgotten where what they are for does not come", async () => {
    const { queue, log, happen, loading, arrive } = setUp();
    queue.press(happen("down"), loading);
    arrive(false);
    await loading;
    queue.press(happen("next"), null);
    expect(log).toEqual(["next"]);
  });
});
