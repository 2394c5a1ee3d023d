import { describe, expect, it } from "vitest";
import { mayReload } from "./reload-guard";

describe("reload guard", () => {
  it("HS1: answers a version mismatch by one reload, not by a loop", () => {
    const items = new Map<string, string>();
    const store = {
      getItem: (key: string) => items.get(key) ?? null,
      setItem: (key: string, value: string) => void items.set(key, value),
    } as Storage;
    expect(mayReload(store, 1_000_000)).toBe(true);
    expect(mayReload(store, 1_005_000)).toBe(false);
    expect(mayReload(store, 1_050_000)).toBe(false);
    expect(mayReload(store, 1_100_000)).toBe(true);
  });

  it("HS1: leaves it to the person where nothing can be remembered", () => {
    const store = {
      getItem: () => null,
      setItem: () => {
        throw new DOMException("full", "QuotaExceededError");
      },
    } as unknown as Storage;
    expect(mayReload(store, 1_000_000)).toBe(false);
  });
});
