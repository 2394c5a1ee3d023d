import { signal } from "@preact/signals";
import { describe, expect, it } from "vitest";
import type { Envelope } from "../../../scene/structure/envelope-surface";
import type { Command, DesignInForce, DocumentState, LimbOutline } from "../../../wire/generated";
import type { Gesture } from "../../input/gesture";
import { handlesOf } from "./branch-handles";
import { DesignSignal } from "./design-signal";
import { LimbShaping } from "./limb-shaping";

const OVOID: Envelope = {
  top: [0, 1, 0],
  bottom: [0, 0, 0],
  radii: [0.4, 0.4, 0.4, 0.4],
  heights: [0.5, 0.5, 0.5, 0.5],
  upper: 2,
  lower: 2,
  tip: [0, 1, 0],
};

function limb(row: number, rest: Partial<LimbOutline> = {}): LimbOutline {
  return {
    row,
    bearer: 1,
    base: [0, 10, 0],
    frame: [0, 0, 0, 1],
    length: 10,
    radius: 0.2,
    heading: [0, 1, 0],
    envelope: OVOID,
    bears: 3,
    ...rest,
  };
}

/** A pixel is a tenth of an internode, y up, seen from the front; wood stands where x is not below 0. */
function setUp() {
  const sent: Command[] = [];
  const looked: number[] = [];
  const world = { missed: 0, holds: 0 };
  const design = new DesignSignal();
  const state = (step: number, pending = 0) => ({ step, pending_steps: pending }) as DocumentState;
  const document = signal<DocumentState | null>(state(5));
  const [finished, mayChange, isDesigning] = [signal(0), signal(true), signal(false)];
  const limbs = new LimbShaping({
    design,
    isDesigning,
    document,
    finished,
    mayChange,
    view: () => ({
      pointOnPlane: (x, y, through) => [x / 10, -y / 10, through[2]],
      projector:
        () =>
        ([x, y]) => [10 * x, -10 * y],
    }),
    pick: (x) => (x < 0 ? null : x),
    shells: () => null,
    look: (row) => {
      looked.push(row);
      return true;
    },
    submit: (command) => sent.push(command),
    hold: () => {
      world.holds += 1;
      return () => {
        world.holds -= 1;
      };
    },
    missed: () => {
      world.missed += 1;
    },
  });
  limbs.wanted.value = true;
  const told = (of: number, answer: LimbOutline | null) => {
    design.limb.value = { of, limb: answer };
  };
  const drag = (id: string, x: number, y: number) => {
    const shape = limbs.chosen.peek();
    const handle = shape && handlesOf(shape).find((one) => one.id === id);
    if (!handle) {
      throw new Error(`There is no handle ${id}.`);
    }
    limbs.grip(handle);
    limbs.drag(x, y);
  };
  const shown = () => limbs.chosen.value?.envelope.radii;
  return { limbs, design, document, finished, mayChange, isDesigning, sent, looked, world, state, told, drag, shown };
}

function refills(sent: readonly Command[]) {
  return sent.filter((command) => command.kind === "refill");
}

describe("shaping limbs that grew", () => {
  it("DS13: a tap asks for the limb at a place, and shows the outline that it has", () => {
    const { limbs, design, looked, told } = setUp();
    const tap = (x: number, y: number) => {
      const gestures: Gesture[] = [{ kind: "stroke-begin", point: { x, y, pressure: null } }, { kind: "stroke-end" }];
      return gestures.map((gesture) => design.hands?.(gesture));
    };
    expect(tap(42, 7)).toEqual([null, null]);
    expect(looked).toEqual([42]);
    told(42, limb(40));
    expect(limbs.limb.value?.told.row).toBe(40);
    expect(limbs.shown.value.map(({ emphasis, scale }) => [emphasis, scale])).toEqual([["chosen", 10]]);
    expect(limbs.handles.value.map(({ id }) => id)).toContain("side-0");
    limbs.group.value = "way";
    expect(limbs.handles.value.map(({ id }) => id)).toEqual(["tip"]);
    limbs.up();
    expect(looked).toEqual([42, 1]);
    tap(-1, 7);
    expect(limbs.limb.value).toBeNull();
  });

  it("a tap where no limb grows any more is said, and shows none", () => {
    const { limbs, told, world } = setUp();
    limbs.tap(42, 0);
    told(42, null);
    expect([limbs.limb.value, world.missed]).toEqual([null, 1]);
  });

  it("a finger that moves turns the picture", () => {
    const { design, looked } = setUp();
    const hands = (gesture: Gesture) => design.hands?.(gesture);
    hands({ kind: "stroke-begin", point: { x: 5, y: 5, pressure: null } });
    const moved = hands({ kind: "stroke-move", points: [{ x: 35, y: 5, pressure: null }] });
    hands({ kind: "stroke-end" });
    expect([moved, looked]).toEqual([{ kind: "orbit", dx: 30, dy: 0 }, []]);
  });

  it("DS12: a handle that is let go is one refill, and the outline is what the finger made of it", () => {
    const { limbs, document, finished, sent, told, drag, shown, state, world } = setUp();
    limbs.tap(42, 0);
    told(42, limb(40));
    drag("side-0", 60, -150);
    expect([sent.length, world.holds]).toEqual([0, 1]);
    limbs.release();
    expect(world.holds).toBe(0);
    expect(refills(sent)).toEqual([
      {
        kind: "refill",
        row: 40,
        envelope: { ...OVOID, radii: [0.6, 0.4, 0.6, 0.4] },
        rotation: [0, 0, 0, 1],
        length: 10,
      },
    ]);
    expect([limbs.isFilling.value, limbs.handles.value]).toEqual([true, []]);
    document.value = state(7, 1);
    document.value = state(9);
    finished.value = 1;
    expect(limbs.isFilling.value).toBe(false);
    expect(shown()).toEqual([0.6, 0.4, 0.6, 0.4]);
    expect(limbs.handles.value.length).toBeGreaterThan(3);
  });

  it("DS12: its tip turns and stretches the outline, and the switch lets it grow anew", () => {
    const { limbs, sent, told, drag } = setUp();
    limbs.tap(42, 0);
    told(42, limb(40));
    limbs.anew.value = true;
    drag("tip", 200, -100);
    limbs.release();
    const [refill] = refills(sent);
    expect(refill).toMatchObject({ length: 20, anew: true, envelope: OVOID });
    const [, , z, w] = refill?.rotation ?? [];
    expect(z).toBeCloseTo(-Math.SQRT1_2);
    expect(w).toBeCloseTo(Math.SQRT1_2);
  });

  it("what was undone has the outline that it had, and other states are asked for", () => {
    const { limbs, document, finished, looked, told, drag, shown, state } = setUp();
    limbs.tap(42, 0);
    told(42, limb(40));
    drag("side-0", 60, -150);
    limbs.release();
    document.value = state(9);
    finished.value = 1;
    document.value = state(5);
    expect(shown()).toEqual(OVOID.radii);
    document.value = state(9);
    expect(shown()).toEqual([0.6, 0.4, 0.6, 0.4]);
    document.value = state(4, 2);
    expect(looked).toEqual([42]);
    document.value = state(4);
    expect(looked).toEqual([42, 40]);
    told(40, limb(40, { envelope: { ...OVOID, radii: [0.3, 0.3, 0.3, 0.3] } }));
    expect(shown()).toEqual([0.3, 0.3, 0.3, 0.3]);
    document.value = state(2);
    told(40, null);
    expect(limbs.limb.value).toBeNull();
  });

  it("a refill that was refused leaves the outline as it was", () => {
    const { limbs, finished, told, drag, shown } = setUp();
    limbs.tap(42, 0);
    told(42, limb(40));
    drag("side-0", 60, -150);
    limbs.release();
    finished.value = 1;
    expect([limbs.isFilling.value, shown()]).toEqual([false, OVOID.radii]);
  });

  it("a second finger lets the outline be as it was", () => {
    const { limbs, sent, told, drag, shown, world } = setUp();
    limbs.tap(42, 0);
    told(42, limb(40));
    drag("side-0", 60, -150);
    expect(shown()).toEqual([0.6, 0.4, 0.6, 0.4]);
    expect(limbs.cancel()).toBe(true);
    limbs.release();
    expect([sent, shown(), world.holds]).toEqual([[], OVOID.radii, 0]);
  });

  it("it rests while a design can be changed, or where one may only look", () => {
    const { limbs, design, mayChange, isDesigning, told } = setUp();
    limbs.tap(42, 0);
    told(42, limb(40));
    const inForce = (steps: number) => ({ steps_on_top: steps }) as DesignInForce;
    design.receive(inForce(0));
    expect([limbs.isOn.value, design.hands, limbs.limb.value]).toEqual([false, null, null]);
    design.receive(inForce(3));
    expect(limbs.isOn.value).toBe(true);
    isDesigning.value = true;
    expect(limbs.isOn.value).toBe(false);
    isDesigning.value = false;
    mayChange.value = false;
    expect(limbs.isOn.value).toBe(false);
  });

  it("hands of a design that takes its place stay", () => {
    const { design } = setUp();
    const others = () => null;
    design.hands = others;
    design.receive({ steps_on_top: 0 } as DesignInForce);
    expect(design.hands).toBe(others);
  });
});
