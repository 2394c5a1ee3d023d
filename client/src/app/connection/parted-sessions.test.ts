import { describe, expect, it } from "vitest";
import { PartedSessions } from "./parted-sessions";

function storage(): Storage {
  const items = new Map<string, string>();
  return {
    getItem: (key: string) => items.get(key) ?? null,
    setItem: (key: string, value: string) => void items.set(key, value),
    removeItem: (key: string) => void items.delete(key),
    get length() {
      return items.size;
    },
  } as unknown as Storage;
}

const record = {
  key: "k".repeat(22),
  next: 4,
  acknowledged: 2,
  pending: [{ id: 3, command: { kind: "undo" } as const }],
};

describe("sessions that were left", () => {
  it("CM1: what was unsent is there on the way back", () => {
    const parted = new PartedSessions();
    parted.keep("oak", record);
    parted.keep("elm", { ...record, next: 9 });
    expect(parted.take("ash")).toBeUndefined();
    expect(parted.take("oak")).toEqual(record);
    expect(parted.take("oak"), "and is the connection's then").toBeUndefined();
    expect(parted.take("elm")?.next).toBe(9);
  });

  it("go on in the next page of the tab", () => {
    const [store, before, after] = [storage(), new PartedSessions(), new PartedSessions()];
    before.keep("oak", record);
    before.leave(store);
    after.come(store);
    expect(after.take("oak")).toEqual(record);
    expect(store.length, "nothing is stored while a page lives").toBe(0);
  });

  it("survive whatever stands in the storage", () => {
    for (const text of ["", "{", "3", "null", '[["oak"]]', '[["oak",{"key":3}]]']) {
      const [store, parted] = [storage(), new PartedSessions()];
      store.setItem("espalier.parted", text);
      parted.come(store);
      expect(parted.take("oak")).toBeUndefined();
    }
  });
});
