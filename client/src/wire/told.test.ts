import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { FrameError } from "./frame-error";
import { byFrames } from "./told";

interface Example {
  readonly parents: number[];
  readonly goes_on: boolean;
  readonly told: number[];
  readonly way: number[];
}

const examples: Example[] = JSON.parse(
  readFileSync(new URL("../../../proto/golden/ways.json", import.meta.url), "utf8"),
);

describe("what frames tell", () => {
  it("FR10: leads where a metamer ends", () => {
    for (const { parents, goes_on, told, way } of examples) {
      const turned = Int32Array.from(parents);
      byFrames.turn(turned, Int32Array.of(7, ...told), 1, goes_on);
      expect([...turned], JSON.stringify({ parents, goes_on, told })).toEqual(way);
    }
    expect(examples.length).toBeGreaterThan(50);
  });

  it("FR11: changes the value that a row has", () => {
    expect([byFrames.radius(400, -400), byFrames.radius(0, 65_535)]).toEqual([0, 65_535]);
    expect(() => byFrames.radius(400, -401)).toThrow(FrameError);
    expect(() => byFrames.radius(400, 65_136)).toThrow(FrameError);
    expect(Uint8Array.of(byFrames.foliage(0xf1, 0x20))).toEqual(Uint8Array.of(0x11));
    expect([byFrames.light(0xff, -31), byFrames.light(0, 31), byFrames.light(0x84, 1)]).toEqual([0, 255, 0x8c]);
    expect(() => byFrames.light(0xff, 1)).toThrow(FrameError);
    expect(() => byFrames.light(7, -1)).toThrow(FrameError);
  });
});
