import { describe, expect, it } from "vitest";
import { DEFAULTS, NUMBERS } from "../../../document/growth/growth-parameters";
import { branchingAt, deflectionAt, lateralEnd, mainEnd } from "./fork";
import { angleAt, depthAt, Rings, zoneAt } from "./perception";
import { angleOnRight, away } from "./place";
import { distanceAt, type Ellipse, favoured, movedBy, pulledTo, reachOf, widenedTo } from "./sides";
import { type Corners, pointOf, weightsAt } from "./triangle";
import { setpointAt } from "./tropism";

const MIDDLE = { x: 100, y: 90 };

describe("places", () => {
  it("an angle is that of the way, up being 0", () => {
    for (const angle of [0, 30, 90, 150, 180]) {
      expect(angleOnRight(MIDDLE, away(MIDDLE, angle, 50), [0, 180])).toBeCloseTo(angle, 6);
    }
  });

  it("a pointer that slips to the other side stays at the end", () => {
    expect(angleOnRight(MIDDLE, away(MIDDLE, -20, 50), [0, 180])).toBe(0);
    expect(angleOnRight(MIDDLE, away(MIDDLE, -160, 50), [0, 180])).toBe(180);
    expect(angleOnRight(MIDDLE, away(MIDDLE, -160, 50), [10, 120])).toBe(120);
  });
});

describe("arrow of tropism", () => {
  it.each([0, 1, 45, 90, 133, 180])("points where %d° is, and means it there", (theta) => {
    expect(setpointAt(MIDDLE, away(MIDDLE, theta, 80))).toEqual({ setpoint_angle: theta });
  });
});

describe("fork", () => {
  it.each([0, 17, 50, 120])("the side shoot's end means ψ = %d°", (psi) => {
    expect(branchingAt(MIDDLE, lateralEnd(MIDDLE, psi))).toEqual({ branching_angle: psi });
  });

  it.each([0, 0.5, 12, 45])("the axis' end means δ = %d°, away from the shoot", (delta) => {
    expect(mainEnd(MIDDLE, delta).x).toBeLessThanOrEqual(MIDDLE.x);
    expect(deflectionAt(MIDDLE, mainEnd(MIDDLE, delta))).toEqual({ deflection_angle: delta });
  });

  it("bends no farther than it can", () => {
    expect(branchingAt(MIDDLE, away(MIDDLE, 170, 40))).toEqual({ branching_angle: 120 });
    expect(deflectionAt(MIDDLE, away(MIDDLE, -100, 40))).toEqual({ deflection_angle: 45 });
    expect(deflectionAt(MIDDLE, away(MIDDLE, 30, 40))).toEqual({ deflection_angle: 0 });
  });

  it("both ends can be held where both angles are 0", () => {
    const [lateral, main] = [lateralEnd(MIDDLE, 0), mainEnd(MIDDLE, 0)];
    expect(Math.hypot(lateral.x - main.x, lateral.y - main.y)).toBeGreaterThanOrEqual(40);
  });
});

describe("triangle of weights", () => {
  const corners: Corners = [
    { x: 98, y: 28 },
    { x: 22, y: 158 },
    { x: 174, y: 158 },
  ];
  const sum = ({ heading_weight: h = 0, tropism_weight: t = 0, space_weight: e = 0 }) =>
    Math.round(1000 * h) + Math.round(1000 * t) + Math.round(1000 * e);

  it.each([
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
    [0.5, 0.25, 0.25],
    [0.333, 0.333, 0.334],
    [0.017, 0.9, 0.083],
  ])("the point of %d, %d, %d means them", (heading_weight, tropism_weight, space_weight) => {
    const weights = { heading_weight, tropism_weight, space_weight };
    expect(weightsAt(pointOf(weights, corners), corners)).toEqual(weights);
  });

  it("weights are 1 together and none below 0, wherever the user goes", () => {
    for (let x = -60; x <= 260; x += 7) {
      for (let y = -60; y <= 260; y += 7) {
        const weights = weightsAt({ x, y }, corners);
        expect(sum(weights)).toBe(1000);
        expect(Object.values(weights).every((weight) => weight >= 0 && weight <= 1)).toBe(true);
      }
    }
  });

  it("a point beside it means the nearest one in it", () => {
    expect(weightsAt({ x: 98, y: -40 }, corners)).toMatchObject({ heading_weight: 1 });
    const foot = weightsAt({ x: 98, y: 250 }, corners);
    expect(foot).toEqual({ heading_weight: 0, tropism_weight: 0.5, space_weight: 0.5 });
  });
});

describe("ellipse of sides", () => {
  const plain: Ellipse = DEFAULTS;
  const withPatch = (patch: object): Ellipse => ({ ...plain, ...patch });

  it("pulled at one end, the other stays", () => {
    const pulled = withPatch(pulledTo("above", 2, plain));
    expect(reachOf(pulled).above).toBeCloseTo(2, 1);
    expect(reachOf(pulled).below).toBeCloseTo(1, 1);
    expect(favoured(pulled)).toBe("epitony");
    const under = withPatch(pulledTo("below", 2.4, plain));
    expect(reachOf(under).below).toBeCloseTo(2.4, 1);
    expect(reachOf(under).above).toBeCloseTo(1, 1);
    expect(favoured(under)).toBe("hypotony");
  });

  it.each(["above", "below"] as const)("pulled %s, it stays in range however far the user goes", (end) => {
    const { gravimorphism_vertical: v, gravimorphism_shift: s } = NUMBERS;
    for (const from of [plain, withPatch({ gravimorphism_shift: 0.99 }), withPatch({ gravimorphism_vertical: 0.05 })]) {
      for (const distance of [-50, 0, 0.01, 1, 7, 400]) {
        const { gravimorphism_vertical, gravimorphism_shift } = withPatch(pulledTo(end, distance, from));
        expect(gravimorphism_vertical).toBeGreaterThanOrEqual(v.least);
        expect(gravimorphism_vertical).toBeLessThanOrEqual(v.most);
        expect(gravimorphism_shift).toBeGreaterThanOrEqual(s.least);
        expect(gravimorphism_shift).toBeLessThanOrEqual(s.most);
      }
    }
  });

  it("is widened at the flanks, within its range", () => {
    expect(widenedTo(1.75)).toEqual({ gravimorphism_horizontal: 1.75 });
    expect(widenedTo(-3)).toEqual({ gravimorphism_horizontal: 0.05 });
    expect(widenedTo(30)).toEqual({ gravimorphism_horizontal: 3 });
    expect(favoured(withPatch(widenedTo(2)))).toBe("amphitony");
  });

  it("moved as a whole it keeps the branch inside", () => {
    expect(movedBy(0.5, plain)).toEqual({ gravimorphism_shift: 0.5 });
    expect(movedBy(-0.5, withPatch({ gravimorphism_vertical: 2 }))).toEqual({ gravimorphism_shift: -0.25 });
    expect(movedBy(9, plain)).toEqual({ gravimorphism_shift: 0.99 });
  });

  it("reaches as far as the server's own reckoning says", () => {
    // The same examples as in the server's tests of gravimorphism.
    expect(distanceAt(0, withPatch({ gravimorphism_shift: 0.5 }))).toBeCloseTo(1.5, 6);
    expect(distanceAt(180, withPatch({ gravimorphism_shift: 0.5 }))).toBeCloseTo(0.5, 6);
    const flat = withPatch({ gravimorphism_vertical: 0.5, gravimorphism_horizontal: 1.5 });
    expect(distanceAt(90, flat)).toBeCloseTo(1.5, 6);
    expect(favoured(plain)).toBe("even");
    expect(favoured(withPatch({ gravimorphism_horizontal: 0.5 }))).toBe("vertical");
  });
});

describe("cone of perception", () => {
  const rings = new Rings(84);
  const { occupancy_radius: r, perception_depth: d } = NUMBERS;

  it("pixels and internodes are two ways of saying the same", () => {
    for (const distance of [0, 0.5, 1.5, 4.5, 16]) {
      expect(rings.internodes(rings.pixels(distance))).toBeCloseTo(distance, 6);
    }
    expect(rings.pixels(r.most + d.most)).toBeCloseTo(84, 6);
    expect(rings.pixels(r.least), "the least zone can be seen").toBeGreaterThan(12);
  });

  it.each([0.5, 1.5, 3.2, 6])("the zone's rim means r = %d", (radius) => {
    expect(zoneAt(rings.internodes(rings.pixels(radius)))).toEqual({ occupancy_radius: radius });
  });

  it.each([0.5, 3, 7.7, 10])("the outer rim means d = %d beyond the zone", (depth) => {
    const now = { ...DEFAULTS, occupancy_radius: 2 };
    expect(depthAt(rings.internodes(rings.pixels(2 + depth)), now)).toEqual({ perception_depth: depth });
  });

  it.each([20, 90, 181, 360])("the edge means ζ = %d°, both sides together", (zeta) => {
    expect(angleAt(MIDDLE, away(MIDDLE, zeta / 2, 88))).toEqual({ perception_angle: zeta });
  });

  it("stays in range at every end", () => {
    expect(zoneAt(0)).toEqual({ occupancy_radius: 0.5 });
    expect(zoneAt(90)).toEqual({ occupancy_radius: 6 });
    expect(depthAt(0, DEFAULTS)).toEqual({ perception_depth: 0.5 });
    expect(depthAt(90, DEFAULTS)).toEqual({ perception_depth: 10 });
    expect(angleAt(MIDDLE, away(MIDDLE, 2, 40))).toEqual({ perception_angle: 20 });
    expect(angleAt(MIDDLE, away(MIDDLE, -170, 40))).toEqual({ perception_angle: 360 });
  });
});
