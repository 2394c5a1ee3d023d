import { signal } from "@preact/signals";
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { loadSettings } from "../page/settings";
import { Tour } from "./tour";

function setUp({ seen = false } = {}) {
  const kept = new Map(seen ? [["espalier.tour", "true"]] : []);
  const store = {
    getItem: (key: string) => kept.get(key) ?? null,
    setItem: (key: string, value: string) => void kept.set(key, value),
  } as unknown as Storage;
  const settings = loadSettings(store);
  const world = { ready: signal(false), drawn: signal(0), turned: 0, growing: signal(false) };
  const tour = new Tour({
    settings,
    ready: () => world.ready.value,
    drawn: () => world.drawn.value,
    turned: () => world.turned,
    growing: () => world.growing.value,
  });
  return { tour, world, settings, kept, stop: tour.follow() };
}

describe("tour", () => {
  beforeEach(() => void vi.useFakeTimers());
  afterEach(() => void vi.useRealTimers());

  it("begins once the workspace can be used", () => {
    const { tour, world } = setUp();
    expect(tour.step.value).toBeNull();
    world.ready.value = true;
    expect(tour.step.value).toBe("draw");
  });

  it("goes on by what the user does, and remembers", () => {
    const { tour, world, settings, kept } = setUp();
    world.ready.value = true;
    world.drawn.value = 40;
    expect([tour.step.value, tour.done.value]).toEqual(["draw", true]);
    vi.runAllTimers();
    expect([tour.step.value, tour.done.value]).toEqual(["turn", false]);
    tour.look();
    expect(tour.done.value).toBe(false);
    world.turned = -1;
    tour.look();
    vi.runAllTimers();
    expect(tour.step.value).toBe("grow");
    world.growing.value = true;
    vi.runAllTimers();
    expect([tour.step.value, settings.tourSeen.value, kept.get("espalier.tour")]).toEqual([null, true, "true"]);
  });

  it("what was done before its turn does not count", () => {
    const { tour, world } = setUp();
    world.ready.value = true;
    world.growing.value = true;
    world.turned = 2;
    tour.look();
    expect([tour.step.value, tour.done.value]).toEqual(["draw", false]);
  });

  it("skipped, it does not come back by itself", () => {
    const { tour, world, settings } = setUp();
    world.ready.value = true;
    tour.skip();
    expect([tour.step.value, settings.tourSeen.value]).toEqual([null, true]);
    world.ready.value = false;
    world.ready.value = true;
    expect(tour.step.value).toBeNull();
  });

  it("seen before, it waits to be asked for", () => {
    const { tour, world } = setUp({ seen: true });
    world.ready.value = true;
    expect(tour.step.value).toBeNull();
    tour.start();
    expect(tour.step.value).toBe("draw");
    tour.next();
    tour.next();
    tour.next();
    expect(tour.step.value).toBeNull();
  });
});
