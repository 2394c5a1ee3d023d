import { describe, expect, it } from "vitest";
import type { Box } from "../../scene/camera/camera-view";
import { GrowthFollower } from "./growth-follower";

/** A tree of a height, in a view that shows up to some height. */
function setUp(shown = 40) {
  const world = { opened: true, height: 0, shown, moves: 0, growing: false, held: false, enabled: true, widened: 0 };
  const follower = new GrowthFollower({
    view: () => ({
      frames: (box) => box.max[1] <= world.shown,
      widen: (box) => {
        world.widened += 1;
        world.shown = 1.2 * box.max[1];
      },
      moves: world.moves,
    }),
    box: (): Box | null => (world.opened ? { min: [0, 0, 0], max: [5, world.height, 5] } : null),
    growing: () => world.growing,
    held: () => world.held,
    enabled: () => world.enabled,
  });
  const to = (change: Partial<typeof world>) => {
    Object.assign(world, change);
    follower.follow();
    return world.widened;
  };
  to({});
  return { world, follower, to };
}

describe("following growth", () => {
  it("moves the camera back when growth leaves the picture", () => {
    const { to } = setUp();
    expect(to({ growing: true, height: 30 })).toBe(0);
    expect(to({ height: 45 })).toBe(1);
    expect(to({ height: 50 }), "there is room now").toBe(1);
    expect(to({ height: 80 })).toBe(2);
    to({ growing: false });
    expect(to({ growing: true, height: 200 }), "and so does the next growth").toBe(3);
  });

  it("takes a tree that is opened for what was there before", () => {
    const { to, follower } = setUp();
    follower.forget();
    to({ opened: false });
    expect(to({ opened: true, height: 90 })).toBe(0);
    expect(to({ growing: true, height: 100 }), "the picture showed a part of it").toBe(0);
  });

  it("waits until no finger is down", () => {
    const { to } = setUp();
    expect(to({ held: true, growing: true, height: 90 })).toBe(0);
    expect(to({ growing: false })).toBe(0);
    expect(to({ held: false })).toBe(1);
  });

  it("leaves the camera to the user who has moved it within this growth, until the next one", () => {
    const { to } = setUp();
    to({ growing: true, height: 30 });
    expect(to({ moves: 1, height: 90 })).toBe(0);
    expect(to({ growing: false, height: 95 })).toBe(0);
    expect(to({ shown: 100 })).toBe(0);
    expect(to({ growing: true, height: 120 })).toBe(1);
  });

  it("stays with a detail, and with what was there before", () => {
    const { to, follower, world } = setUp();
    to({ height: 30 });
    to({ shown: 10, moves: 1 });
    expect(to({ growing: true, height: 60 }), "the user looks at a detail").toBe(0);
    to({ growing: false });
    follower.forget();
    expect(to({ height: 500, shown: 40 }), "another tree is opened").toBe(0);
    expect(to({ height: 400 }), "undo").toBe(0);
    world.enabled = false;
    to({ height: 10 });
    expect(to({ growing: true, height: 90 }), "it is turned off").toBe(0);
  });
});
