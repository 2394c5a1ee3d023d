import { describe, expect, it } from "vitest";
import { RAMP_COLOURS, RAMPS, type Ramp } from "./ramps";

type Colour = Ramp[number];

const linear = (value: number) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);

/** Perceived lightness, 0 to 100 (CIE 1976). */
function lightness([r, g, b]: Colour): number {
  const y = 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
  return y > 0.008856 ? 116 * Math.cbrt(y) - 16 : 903.3 * y;
}

/** As eyes without red or without green cones see it (Viénot et al. 1999). */
const EYES: Record<string, readonly (readonly [number, number, number])[]> = {
  protanope: [
    [0.11238, 0.88762, 0],
    [0.11238, 0.88762, 0],
    [0.00401, -0.00401, 1],
  ],
  deuteranope: [
    [0.29275, 0.70725, 0],
    [0.29275, 0.70725, 0],
    [-0.02234, 0.02234, 1],
  ],
};

function seen(colour: Colour, eye: string): Colour {
  const [r, g, b] = colour.map(linear) as [number, number, number];
  const back = (value: number) =>
    value <= 0.0031308 ? 12.92 * Math.max(0, value) : 1.055 * Math.min(1, value) ** (1 / 2.4) - 0.055;
  return EYES[eye]!.map(([x, y, z]) => back(x * r + y * g + z * b)) as unknown as Colour;
}

describe.each(Object.entries<Ramp>(RAMPS))("the ramp %s", (_, ramp) => {
  it("gets lighter by even steps", () => {
    expect(ramp).toHaveLength(RAMP_COLOURS);
    const steps = ramp.slice(1).map((colour, i) => lightness(colour) - lightness(ramp[i]!));
    const mean = steps.reduce((sum, step) => sum + step, 0) / steps.length;
    expect(mean).toBeGreaterThan(6);
    for (const step of steps) expect(Math.abs(step - mean)).toBeLessThan(0.45 * mean);
  });

  it.each(Object.keys(EYES))("reads the same to a %s", (eye) => {
    const lights = ramp.map((colour) => lightness(seen(colour, eye)));
    for (const [i, light] of lights.slice(1).entries()) expect(light).toBeGreaterThan(lights[i]! + 2);
  });
});
