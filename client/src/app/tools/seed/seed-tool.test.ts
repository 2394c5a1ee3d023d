import { describe, expect, it } from "vitest";
import type { Command } from "../../../wire/generated";
import { SeedTool } from "./seed-tool";

/** Ground below pixel 500; a pixel is a tenth of an internode. */
function setUp() {
  const sent: Command[] = [];
  const calls: string[] = [];
  const tool = new SeedTool({
    groundAt: (x, y) => (y > 500 ? [x / 10, 0, y / 10] : null),
    submit: (command) => sent.push(command),
    next: () => sent.length + 1,
    missed: () => calls.push("missed"),
  });
  return { tool, sent, calls, shown: () => tool.coming.value };
}

const at = (x: number, y: number) => ({ x, y, pressure: null });

describe("seed tool", () => {
  it("plants where the finger lifts, once", () => {
    const { tool, sent, calls, shown } = setUp();
    tool.begin(at(100, 600));
    tool.move([at(150, 700), at(200, 800)]);
    expect([sent, shown()]).toEqual([[], [20, 0, 80]]);
    tool.end();
    tool.end();
    expect(sent).toEqual([{ kind: "plant_seed", position: [20, 0, 80] }]);
    expect([calls, shown()]).toEqual([[], null]);
  });

  it("shows what it has planted until it is refused, or given up", () => {
    const { tool, sent } = setUp();
    for (const x of [100, 200]) {
      tool.begin(at(x, 600));
      tool.end();
    }
    expect(tool.planted.value).toEqual([
      { place: [10, 0, 60], command: 1 },
      { place: [20, 0, 60], command: 2 },
    ]);
    tool.refused(sent[0]!);
    expect(tool.planted.value.map(({ command }) => command)).toEqual([2]);
    tool.abandon();
    expect(tool.planted.value).toEqual([]);
  });

  it("plants nothing in the sky", () => {
    const { tool, sent, calls } = setUp();
    tool.begin(at(100, 600));
    tool.move([at(100, 400)]);
    tool.end();
    expect([sent, calls]).toEqual([[], ["missed"]]);
  });

  it("a finger that was cancelled plants nothing", () => {
    const { tool, sent, calls } = setUp();
    tool.begin(at(100, 600));
    tool.abandon();
    tool.move([at(100, 700)]);
    tool.end();
    expect([sent, calls]).toEqual([[], []]);
  });

  it("LM2: stays within reach", () => {
    const { tool, sent } = setUp();
    tool.begin(at(1e7, 600));
    tool.end();
    expect(sent).toEqual([{ kind: "plant_seed", position: [1000, 0, 60] }]);
  });
});
