import { describe, expect, it } from "vitest";
import { randoms } from "../../../test/randoms";
import { CameraRig, fitted } from "./camera-rig";
import { FIELD_OF_VIEW } from "./camera-view";

const tree = { min: [-10, 0, -8], max: [12, 30, 9] } as const;

function settle(rig: CameraRig) {
  for (let i = 0; i < 400 && rig.step(1 / 60); i += 1);
}

describe("the camera", () => {
  it("shows 40 internodes of height at first", () => {
    const { distance } = new CameraRig().view;
    expect(2 * distance * Math.tan(FIELD_OF_VIEW / 2)).toBeCloseTo(40);
  });

  it("never goes under the ground nor loses the tree", () => {
    const random = randoms(4);
    const rig = new CameraRig();
    rig.keep(tree);
    for (let i = 0; i < 2000; i += 1) {
      const a = (random() - 0.5) * 900;
      const b = (random() - 0.5) * 900;
      const what = Math.floor(random() * 3);
      if (what === 0) rig.orbit(a, b);
      if (what === 1) rig.pan(a, b, 800);
      if (what === 2) rig.zoom(0.5 + random(), a / 450, b / 450);
      rig.step(1 / 60);
      expect(rig.eye()[1]).toBeGreaterThan(0);
      expect(Math.abs(rig.view.target[0])).toBeLessThan(60);
      expect(rig.view.distance).toBeLessThan(250);
    }
    settle(rig);
    expect(rig.step(1 / 60)).toBe(false);
  });

  it("goes along with another camera, the shorter way round, and does not take that for the user's hand", () => {
    const rig = new CameraRig();
    rig.keep(tree);
    rig.orbit(-1500, 0);
    settle(rig);
    const [moves, before] = [rig.moves, rig.view.yaw];
    const other = { target: [1, 9, 2] as [number, number, number], yaw: 0.5, pitch: 0.2, distance: 33 };
    rig.accompany(other);
    settle(rig);
    expect(rig.moves).toBe(moves);
    expect(rig.view).toEqual({ ...other, yaw: rig.view.yaw });
    expect(Math.cos(rig.view.yaw - 0.5)).toBeCloseTo(1, 9);
    expect(Math.abs(rig.view.yaw - before)).toBeLessThanOrEqual(Math.PI);
    expect(other.target).toEqual([1, 9, 2]);
  });

  it("comes back from a visit to where it was, unless the user has moved it there", () => {
    const rig = new CameraRig();
    rig.keep(tree);
    settle(rig);
    const before = structuredClone(rig.view);
    const other = { target: [1, 9, 2] as [number, number, number], yaw: 0.5, pitch: 0.2, distance: 33 };
    rig.visit(other);
    settle(rig);
    expect(rig.view.distance).toBe(33);
    rig.restore();
    settle(rig);
    expect(rig.view).toEqual(before);
    rig.visit(other);
    rig.orbit(10, 0);
    rig.restore();
    settle(rig);
    expect(rig.view.distance).toBe(33);
  });

  it("turns to the front the shorter way, also while it is on its way elsewhere", () => {
    for (const [pixels, turns] of [
      [-200, 0],
      [-900, 1],
      [400, 0],
    ] as const) {
      const rig = new CameraRig();
      rig.orbit(pixels, 0);
      rig.step(1 / 60);
      rig.face();
      settle(rig);
      expect(rig.view.yaw / (2 * Math.PI)).toBeCloseTo(turns, 3);
    }
  });

  it("keeps what is under the fingers there while zooming", () => {
    const rig = new CameraRig();
    rig.keep(tree);
    const seen = () => {
      const { target, distance } = rig.view;
      const half = Math.tan(FIELD_OF_VIEW / 2) * distance;
      return [target[0] + 0.3 * half, target[1] + 0.2 * half * Math.cos(rig.view.pitch)];
    };
    const before = seen();
    rig.zoom(2, 0.3, 0.2);
    settle(rig);
    const after = seen();
    expect(rig.view.distance).toBeLessThan(40);
    expect(after[0]).toBeCloseTo(before[0]!, 3);
    expect(after[1]).toBeCloseTo(before[1]!, 3);
  });

  it("drags the picture by as much as the fingers", () => {
    const rig = new CameraRig();
    rig.keep(tree);
    const before = rig.view.target[0];
    rig.pan(100, 0, 800);
    settle(rig);
    expect(before - rig.view.target[0]).toBeCloseTo((100 / 800) * 40, 4);
  });

  it("goes back to where it was before it fitted something", () => {
    const rig = new CameraRig();
    rig.keep(tree);
    rig.zoom(3, 0.2, 0.1);
    settle(rig);
    const before = structuredClone(rig.view);
    rig.fit(tree, 1.4);
    settle(rig);
    expect(rig.view.distance).toBeGreaterThan(before.distance);
    rig.restore();
    settle(rig);
    expect(rig.view).toEqual(before);
  });

  it("stays with what it fitted, though nothing may be there yet", () => {
    const rig = new CameraRig();
    rig.keep({ min: [-1, 0, -1], max: [1, 2, 1] });
    rig.fit({ min: [-40, 0, -40], max: [40, 60, 40] }, 0.45);
    rig.keep({ min: [-1, 0, -1], max: [1, 3, 1] });
    settle(rig);
    expect(2 * rig.view.distance * Math.tan(FIELD_OF_VIEW / 2) * 0.45).toBeGreaterThan(80);
  });

  it("stays where the user has moved it meanwhile", () => {
    const rig = new CameraRig();
    rig.keep(tree);
    rig.fit(tree, 1.4);
    rig.orbit(40, 0);
    settle(rig);
    const moved = structuredClone(rig.view);
    rig.restore();
    settle(rig);
    expect(rig.view).toEqual(moved);
  });

  it("leaves room at the foot of the picture", () => {
    const rig = new CameraRig();
    rig.fit(tree, 1.4, 0.2);
    settle(rig);
    const { target, distance } = rig.view;
    const half = Math.tan(FIELD_OF_VIEW / 2) * distance;
    // The ground lies above the lowest fifth of what is seen, and the crown's top below the upper edge.
    expect(target[1] - half * 0.6).toBeLessThanOrEqual(0);
    expect(target[1] + half).toBeGreaterThan(tree.max[1]);
  });

  it("shows a tree that is high below what covers the head of the picture, and a broad one as before", () => {
    const half = Math.tan(FIELD_OF_VIEW / 2);
    const high = { min: [-4, 0, -4], max: [4, 60, 4] } as const;
    for (const head of [0.05, 0.1, 0.2]) {
      const [rig, free] = [new CameraRig(), new CameraRig()];
      rig.fit(high, 1.4, 0, head);
      free.fit(high, 1.4);
      for (const one of [rig, free]) settle(one);
      const below = ({ view: { target, distance } }: CameraRig) => target[1] / (half * distance);
      expect((60 - rig.view.target[1]) / (half * rig.view.distance)).toBeLessThanOrEqual(1 - 2 * head + 1e-3);
      expect(below(rig), "its foot stays where it is").toBeCloseTo(below(free), 3);
    }
    const broad = { min: [-60, 0, -60], max: [60, 40, 60] } as const;
    const [rig, free] = [new CameraRig(), new CameraRig()];
    rig.fit(broad, 1.4, 0, 0.1);
    free.fit(broad, 1.4);
    for (const one of [rig, free]) settle(one);
    expect(rig.view).toEqual(free.view);
  });

  it("fits a wide tree into a tall picture", () => {
    const wide = { min: [-40, 0, 0], max: [40, 10, 0] } as const;
    const view = fitted(wide, 0.7, 0);
    expect(2 * view.distance * Math.tan(FIELD_OF_VIEW / 2) * 0.7).toBeGreaterThan(80);
  });
});
