import { describe, expect, it } from "vitest";
import { DEFAULT_APPEARANCE } from "../../../wire/generated";
import { clockText, daylight, LOWEST, sunAt, timeAt, typedHours } from "./day";

const EQUINOX = 0;
const MIDSUMMER = 23.44;

describe("time of day", () => {
  it("the sun rises in the east, sets in the west", () => {
    const [morning, noon, evening] = [6, 12, 18].map((hours) => sunAt({ hours, declination: EQUINOX }));
    expect(morning!.elevation).toBeCloseTo(0);
    expect(morning!.azimuth).toBeCloseTo(90);
    expect(noon!.elevation).toBeCloseTo(42);
    expect(noon!.azimuth % 360).toBeCloseTo(0);
    expect(evening!.azimuth).toBeCloseTo(270);
  });

  it("summer days are long and high, winter days are not", () => {
    const [summer, winter] = [MIDSUMMER, -MIDSUMMER].map((declination) => {
      const [dawn, dusk] = daylight(declination);
      return { length: dusk - dawn, noon: sunAt({ hours: 12, declination }).elevation };
    });
    expect(summer!.noon).toBeCloseTo(65.44);
    expect(winter!.noon).toBeCloseTo(18.56);
    expect(summer!.length - winter!.length).toBeGreaterThan(7);
  });

  it("moving the time back and forth leads back", () => {
    for (const declination of [-23, -8, 0, 15, 23]) {
      const [dawn, dusk] = daylight(declination);
      for (let hours = dawn + 0.01; hours < dusk; hours += 0.5) {
        const back = timeAt(sunAt({ hours, declination }));
        expect(back.hours).toBeCloseTo(hours, 6);
        expect(back.declination).toBeCloseTo(declination, 6);
      }
    }
  });

  it("the sun goes on from where it is", () => {
    const { sun_azimuth: azimuth, sun_elevation: elevation } = DEFAULT_APPEARANCE.background;
    const back = sunAt(timeAt({ azimuth, elevation }));
    expect(back.azimuth).toBeCloseTo(azimuth, 6);
    expect(back.elevation).toBeCloseTo(elevation, 6);
  });

  it("from where no sun stands the nearest day is taken", () => {
    const { declination } = timeAt({ azimuth: 180, elevation: 60 });
    expect(declination).toBe(MIDSUMMER);
  });

  it("at dawn and dusk the sun is where it is followed to", () => {
    for (const declination of [-20, 0, 20]) {
      for (const hours of daylight(declination)) {
        expect(sunAt({ hours, declination }).elevation).toBeCloseTo(LOWEST, 6);
      }
    }
    expect(sunAt({ hours: 0, declination: 0 }).elevation).toBe(LOWEST);
  });

  it("every place is one the wire takes", () => {
    for (let hours = 0; hours <= 24; hours += 0.25) {
      const { azimuth, elevation } = sunAt({ hours, declination: 12 });
      expect(azimuth).toBeGreaterThanOrEqual(0);
      expect(azimuth).toBeLessThanOrEqual(360);
      expect(elevation).toBeGreaterThanOrEqual(-10);
      expect(elevation).toBeLessThanOrEqual(90);
    }
  });

  it("is written and read as on a clock", () => {
    expect(clockText(14.5)).toBe("14:30");
    expect(clockText(5.9999)).toBe("6:00");
    expect(typedHours("14:30")).toBe(14.5);
    expect(typedHours("7")).toBe(7);
    expect(typedHours("7,5")).toBe(7.5);
    expect(typedHours("noon")).toBeNull();
    expect(typedHours("")).toBeNull();
  });
});
