import { describe, expect, it } from "vitest";
import { unmownAt } from "./meadow";

describe("a meadow", () => {
  const places = Array.from(
    { length: 4000 },
    (_, n) => [7.31 * (n % 64) - 200, 11.7 * Math.floor(n / 64) - 300] as const,
  );

  it("is mown here, and there it is not", () => {
    const all = places.map(([x, z]) => unmownAt(x, z));
    const tall = all.filter((share) => share > 0.9).length / all.length;
    const short = all.filter((share) => share < 0.1).length / all.length;
    expect(tall).toBeGreaterThan(0.1);
    expect(short).toBeGreaterThan(0.3);
    for (const share of all) {
      expect(share).toBeGreaterThanOrEqual(0);
      expect(share).toBeLessThanOrEqual(1);
    }
  });

  it("has no edges", () => {
    for (const [x, z] of places) expect(Math.abs(unmownAt(x + 0.05, z) - unmownAt(x, z))).toBeLessThan(0.06);
  });
});
