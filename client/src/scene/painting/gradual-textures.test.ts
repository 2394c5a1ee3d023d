import type { DataTexture } from "three";
import { beforeEach, describe, expect, it, vi } from "vitest";
import { GradualTextures } from "./gradual-textures";
import type { Levels } from "./leaf-atlas";
import { type Order, paint } from "./paint";
import type { Painter } from "./painter";

describe("textures", () => {
  let orders: { order: Order; done: (painted: Levels[]) => void; off: boolean }[];
  let textures: GradualTextures<"bark">;
  let painter: Pick<Painter, "begun" | "order">;
  const shown = () => textures.drawn[0]!.colour.value as DataTexture;
  const side = () => (shown().image as { width: number }).width;
  const finish = () => orders.at(-1)!.done(paint(orders.at(-1)!.order));
  const ordered = () => orders.map(({ order }) => `${order.kind} ${order.coarse ? "coarse" : "whole"}`);

  beforeEach(() => {
    orders = [];
    painter = {
      begun: true,
      order: (order: Order, done: (painted: Levels[]) => void) => {
        const entry = { order, done, off: false };
        orders.push(entry);
        return () => {
          entry.off = true;
        };
      },
    };
    textures = new GradualTextures("bark", painter as unknown as Painter);
    textures.choose("papery");
  });

  it("are not painted before they are drawn with", () => {
    expect(orders).toEqual([]);
    expect(textures.unfinished).toBe(false);
  });

  it("are blank while nothing is to be seen", () => {
    painter.begun = false;
    expect(side()).toBe(1);
    expect(orders).toEqual([]);
    painter.begun = true;
    expect(side()).toBe(1);
    expect(ordered()).toEqual(["papery coarse"]);
  });

  it("have their coarse picture ready before anything is to be seen, where nearly every tree has them", () => {
    painter.begun = false;
    const bark = new GradualTextures("bark", painter as unknown as Painter, { early: true });
    bark.choose("smooth");
    const width = () => ((bark.drawn[0]!.colour.value as DataTexture).image as { width: number }).width;
    expect(width()).toBe(1);
    finish();
    expect(width()).toBe(64);
    expect(ordered()).toEqual(["smooth coarse"]);
    painter.begun = true;
    expect(width()).toBe(64);
    expect(ordered()).toEqual(["smooth coarse", "smooth whole"]);
  });

  it("have their whole picture painted before they are drawn with, where that is asked for", () => {
    painter.begun = false;
    const bark = new GradualTextures("bark", painter as unknown as Painter, { early: true });
    bark.choose("smooth");
    finish();
    painter.begun = true;
    bark.paint();
    const seldom = new GradualTextures("bark", painter as unknown as Painter);
    seldom.choose("furrowed");
    seldom.paint();
    expect(ordered()).toEqual(["smooth coarse", "smooth whole"]);
  });

  it("are coarse as soon as they are painted and whole when the time is right", () => {
    expect(side()).toBe(1);
    expect(textures.unfinished).toBe(true);
    const blank = vi.fn();
    shown().addEventListener("dispose", blank);
    finish();
    expect(blank).toHaveBeenCalledOnce();
    expect(side()).toBe(64);
    expect(textures.unfinished).toBe(true);
    finish();
    expect(ordered()).toEqual(["papery coarse", "papery whole"]);
    expect(textures.ripe).toBe(true);
    expect(side()).toBe(64);
    const gone = vi.fn();
    shown().addEventListener("dispose", gone);
    textures.ripen();
    expect(side()).toBe(512);
    expect(gone).toHaveBeenCalledOnce();
    expect(textures.unfinished).toBe(false);
  });

  it("call off what is not needed any more", () => {
    shown();
    textures.choose("smooth");
    expect(orders[0]!.off).toBe(true);
    expect(textures.unfinished).toBe(false);
    shown();
    expect(ordered()).toEqual(["papery coarse", "smooth coarse"]);
    textures.choose("smooth");
    expect(orders[1]!.off).toBe(false);
  });

  it("go up again to a restored context", () => {
    const before = shown().version;
    textures.restored();
    expect(shown().version).toBeGreaterThan(before);
  });
});

it("coarse pictures have a small part of the texels", () => {
  // In texels, for a clock would measure what else the machine does: at most a sixteenth of the whole.
  const texels = (order: Order) => paint(order).reduce((sum, { colour }) => sum + colour[0]!.length / 4, 0);
  expect(texels({ sort: "bark", kind: "plated", coarse: true })).toBe(64 * 64);
  expect(texels({ sort: "flower", kind: "panicle", coarse: true })).toBe(128 * 128);
  expect(texels({ sort: "fruit", kind: "cone", coarse: true })).toBe(128 * 128);
  expect(texels({ sort: "leaf", kind: "needle", coarse: true })).toBe(64 * 64 + 128 * 128);
});
