import { expect, it } from "vitest";
import { daysLeft, timeBetween } from "./time-between";

it("a time is told in its largest unit", () => {
  const at = "2026-01-01T10:00:00.000Z";
  expect(timeBetween(at, "2026-01-01T10:00:00.300Z")).toBe("0 seconds");
  expect(timeBetween("2026-01-01T10:01:30Z", at)).toBe("2 minutes");
  expect(timeBetween(at, "2026-01-01T11:10:00Z")).toBe("1 hour");
  expect(timeBetween(at, "2026-01-04T11:00:00Z")).toBe("3 days");
});

it("a deleted tree has its days counted down", () => {
  const deleted = "2026-01-01T10:00:00Z";
  const after = (days: number) => daysLeft(deleted, Date.parse(deleted) + days * 86_400_000);
  expect([after(0), after(0.5), after(1), after(29.5), after(40)]).toEqual([30, 30, 29, 1, 0]);
});
