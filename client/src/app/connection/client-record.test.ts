import { describe, expect, it } from "vitest";
import { leaveRecord, newClientKey, takeRecord } from "./client-record";

class FakeStorage implements Storage {
  #items = new Map<string, string>();
  get length() {
    return this.#items.size;
  }
  clear = () => this.#items.clear();
  getItem = (key: string) => this.#items.get(key) ?? null;
  key = () => null;
  removeItem = (key: string) => void this.#items.delete(key);
  setItem = (key: string, value: string) => void this.#items.set(key, value);
}

const record = {
  key: "k".repeat(22),
  next: 4,
  acknowledged: 2,
  pending: [{ id: 3, command: { kind: "undo" } as const }],
};

describe("client record", () => {
  it("HS1: a key has 8 to 64 of the allowed characters", () => {
    for (let i = 0; i < 100; i++) {
      expect(newClientKey()).toMatch(/^[A-Za-z0-9_-]{22}$/);
    }
    expect(newClientKey()).not.toBe(newClientKey());
  });

  it("gives the next page what the last one left", () => {
    const store = new FakeStorage();
    leaveRecord(store, "oak", record);
    expect(takeRecord(store, "oak")).toEqual(record);
  });

  it("is gone once taken, so a duplicated tab finds none", () => {
    const store = new FakeStorage();
    leaveRecord(store, "oak", record);
    takeRecord(store, "oak");
    expect(takeRecord(store, "oak")).toBeUndefined();
  });

  it("is not taken for another session", () => {
    const store = new FakeStorage();
    leaveRecord(store, "oak", record);
    expect(takeRecord(store, "elm")).toBeUndefined();
  });

  it("survives whatever stands in the storage", () => {
    for (const text of ["", "{", "3", "null", '{"session":"oak"}', '{"session":"oak","key":3}']) {
      const store = new FakeStorage();
      store.setItem("espalier.client", text);
      expect(takeRecord(store, "oak")).toBeUndefined();
    }
  });
});
