import { expect, it } from "vitest";
import { Damper } from "./damper";

it("covers half the way in its half-life", () => {
  expect(new Damper(0.2).step(0, 1, 0.2, 1)).toBeCloseTo(0.5, 2);
});

it("goes the same way at any frame rate", () => {
  const coarse = new Damper(0.1);
  const fine = new Damper(0.1);
  let a = 0;
  let b = 0;
  for (let i = 0; i < 4; i += 1) a = coarse.step(a, 1, 0.05, 1);
  for (let i = 0; i < 40; i += 1) b = fine.step(b, 1, 0.005, 1);
  expect(a).toBeCloseTo(b, 6);
});

it("never overshoots and arrives exactly", () => {
  const damper = new Damper(0.06);
  let value = 0;
  for (let i = 0; i < 200; i += 1) {
    const next = damper.step(value, 10, 1 / 60, 10);
    expect(next).toBeGreaterThanOrEqual(value);
    expect(next).toBeLessThanOrEqual(10);
    value = next;
  }
  expect(value).toBe(10);
});
