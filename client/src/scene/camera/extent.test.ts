import { describe, expect, it } from "vitest";
import type { Box } from "./camera-view";
import { extent } from "./extent";

const TREE: Box = { min: [-5, 0, -5], max: [5, 30, 5] };

describe("the extent of a scene", () => {
  it("is the tree's where nothing stands around it", () => {
    expect(extent(TREE, null)).toEqual(TREE);
  });

  it("takes in what stands near, on any side", () => {
    const wall: Box = { min: [-20, -1, 8], max: [20, 10, 9] };
    expect(extent(TREE, wall)).toEqual({ min: [-20, -1, -5], max: [20, 30, 9] });
  });

  it("never shrinks to what is within the tree", () => {
    expect(extent(TREE, { min: [0, 1, 0], max: [1, 2, 1] })).toEqual(TREE);
  });

  it("ends 40 internodes and a tree's size beyond the tree", () => {
    const plane: Box = { min: [-1e4, 0, -60], max: [1e4, 0, 60] };
    expect(extent(TREE, plane)).toEqual({ min: [-75, 0, -60], max: [75, 30, 60] });
  });
});
