import { describe, expect, it } from "vitest";
import type { Pose } from "../../../wire/generated";
import { ObstacleTool } from "./obstacle-tool";

/** One box of height 4 at (0, 5, 0), gripped anywhere; a pixel is an internode, y up. */
function setUp() {
  const sent: { readonly id: number; readonly pose: Pose }[] = [];
  const world = { there: true, above: false, preview: null as Pose | null, chosen: 0 };
  const pose: Pose = { position: [0, 5, 0], rotation: [0, 1, 0, 0] };
  const tool = new ObstacleTool({
    view: {
      pointOnPlane: (x, y, through) => [x, -y, through[2]],
      pointOnLevel: (x, y, through) => [x, through[1], y],
      looksDown: () => world.above,
      pickObstacle: (x, y) => (world.there ? { id: 3, point: [x, world.above ? 7 : -y, world.above ? y : 2] } : null),
      depthBelow: () => 2,
    },
    move: (id, pose) => sent.push({ id, pose }),
    poseOf: (id) => (id === 3 ? pose : null),
    choose: (id) => {
      world.chosen = id;
    },
    preview: (moved) => {
      world.preview = moved?.pose ?? null;
    },
  });
  return { tool, sent, world };
}

const at = (x: number, y: number) => ({ x, y, pressure: null });

describe("obstacle tool", () => {
  it("moves a thing with the finger and sends where it ends", () => {
    const { tool, sent, world } = setUp();
    tool.begin(at(10, 10));
    tool.move([at(12, 10)]);
    expect([sent, world.preview?.position, world.chosen]).toEqual([[], [2, 5, 0], 3]);
    tool.move([at(15, 8)]);
    tool.end();
    expect(sent).toEqual([{ id: 3, pose: { position: [5, 7, 0], rotation: [0, 1, 0, 0] } }]);
  });

  it("from above it slides over the ground", () => {
    const { tool, sent, world } = setUp();
    world.above = true;
    tool.begin(at(10, 10));
    tool.move([at(13, 6)]);
    tool.end();
    expect(sent).toMatchObject([{ pose: { position: [3, 5, -4] } }]);
  });

  it("near the ground it stands on it", () => {
    const { tool, sent } = setUp();
    tool.begin(at(0, 0));
    tool.move([at(0, 2.6)]);
    tool.end();
    expect(sent).toMatchObject([{ pose: { position: [0, 2, 0] } }]);
  });

  it("a tap chooses and moves nothing", () => {
    const { tool, sent, world } = setUp();
    tool.begin(at(0, 0));
    tool.end();
    expect([sent, world.chosen]).toEqual([[], 3]);
  });

  it("one that was cancelled stands where it stood", () => {
    const { tool, sent, world } = setUp();
    tool.begin(at(0, 0));
    tool.move([at(9, 0)]);
    tool.abandon();
    tool.end();
    expect([sent, world.preview]).toEqual([[], null]);
  });

  it("beside every obstacle it grips nothing", () => {
    const { tool, sent, world } = setUp();
    world.there = false;
    expect(tool.grips(at(0, 0))).toBe(false);
    tool.begin(at(0, 0));
    tool.move([at(9, 0)]);
    tool.end();
    expect([sent, world.preview]).toEqual([[], null]);
  });
});
