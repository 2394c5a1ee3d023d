import { afterEach, expect } from "vitest";
import { takeDrawingFaults } from "./drawing-faults";

// Vitest's set-up of each file.
afterEach(() => {
  expect(takeDrawingFaults(), "nothing that is drawn is at fault").toEqual([]);
});
