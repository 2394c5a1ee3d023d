import { unzipSync } from "fflate";
import { describe, expect, it } from "vitest";
import { frameArchive } from "./frame-archive";
import { RATE, type RecordingOptions, record } from "./recording";

/** A design of ten steps whose pictures are the numbers of its steps. */
function design(options: Partial<RecordingOptions> = {}) {
  const shown: number[] = [];
  const told: [number, number][] = [];
  const whole: RecordingOptions = {
    seconds: 1,
    stepAt: (share) => Math.round(10 * share),
    show: async (step) => {
      shown.push(step);
    },
    photograph: async () => new Blob([String(shown.at(-1))]),
    sink: frameArchive(),
    stop: new AbortController().signal,
    tell: (made, all) => told.push([made, all]),
    ...options,
  };
  return { shown, told, whole };
}

describe("a recording", () => {
  it("has a picture for each moment, and shows each step once", async () => {
    const { shown, told, whole } = design();
    const file = await record(whole);
    expect(shown).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10]);
    const files = unzipSync(new Uint8Array(await file.arrayBuffer()));
    const names = Object.keys(files);
    expect(names).toHaveLength(RATE + 1.5 * RATE);
    expect(names[0]).toBe("frame-00001.png");
    expect(names).toEqual([...names].sort());
    const steps = names.map((name) => Number(new TextDecoder().decode(files[name])));
    expect([steps[0], steps.at(-1)]).toEqual([0, 10]);
    expect(steps.every((step, i) => step >= (steps[i - 1] ?? 0))).toBe(true);
    expect(told.at(-1)).toEqual([names.length, names.length]);
  });

  it("is given up at once, and leaves nothing behind", async () => {
    const stop = new AbortController();
    let cancelled = 0;
    const archive = frameArchive();
    const { whole } = design({
      stop: stop.signal,
      sink: {
        ...archive,
        cancel: async () => {
          cancelled += 1;
        },
      },
      tell: (made) => made === 3 && stop.abort(),
    });
    await expect(record(whole)).rejects.toThrow();
    expect(cancelled).toBe(1);
  });
});
