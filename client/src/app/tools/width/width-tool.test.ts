import { afterEach, describe, expect, it, vi } from "vitest";
import { frontView, SMALL, tableOf } from "../../../../test/small-tree";
import type { WidthOverlay } from "../../../scene/overlay/width-overlay";
import type { Command, WidthConstraint } from "../../../wire/generated";
import { WidthList } from "./width-list";
import { WidthTool } from "./width-tool";

afterEach(() => vi.useRealTimers());

function setUp() {
  vi.useFakeTimers();
  const table = tableOf(SMALL);
  const view = frontView(table);
  const sent: Command[] = [];
  const world = { unsettled: 0 };
  const widths = new WidthList();
  const tool = new WidthTool({
    widths,
    table,
    view,
    submit: (command) => void sent.push(command),
    newGesture: () => 100 + sent.length,
    unsettled: () => world.unsettled,
    girth: () => ({ exponent: 2.5, twigDiameter: 0.07 }),
    scaleAt: () => 100,
    placeOnGlass: (row) => view.glass(view.placeOf(row)),
  });
  const [x, y] = view.glass(view.placeOf(7));
  const receive = (set: WidthConstraint[]) => {
    widths.all.value = set;
  };
  return { table, view, tool, sent, world, receive, x, y };
}

const diameters = (sent: Command[]) => sent.map((command) => (command.kind === "set_width" ? command.diameter : null));
const drawn = (overlays: Set<unknown>) => [...overlays].map((overlay) => (overlay as WidthOverlay).diameter);

describe("widening", () => {
  it("two fingers pinch around a limb and scale it", () => {
    const { tool, sent, view, x, y } = setUp();
    const before = tool.diameterOf(7);
    tool.gripBegin(1, x - 40, y, 9);
    expect(tool.takes(x + 40, y)).toBe("take");
    tool.gripBegin(2, x + 40, y, 9);
    expect([tool.chosen.value, sent]).toEqual([7, []]);
    tool.gripMove(1, x - 60, y);
    tool.gripMove(2, x + 60, y);
    expect(drawn(view.overlays)).toEqual([Number((1.5 * before).toPrecision(3))]);
    tool.tick();
    tool.gripMove(2, x + 100, y);
    tool.gripEnd(2);
    tool.gripEnd(1);
    expect(sent).toMatchObject([
      { kind: "set_width", row: 7, gesture: 100 },
      { kind: "set_width", row: 7, gesture: 100 },
    ]);
    expect(diameters(sent)).toEqual([1.5 * before, 2 * before].map((d) => Number(d.toPrecision(3))));
  });

  it("two fingers around nothing, or far apart, move the view", () => {
    const { tool, x, y } = setUp();
    tool.gripBegin(1, x - 40, y, 9);
    expect([tool.takes(x - 40, y - 200), tool.takes(x + 300, y)]).toEqual(["leave", "leave"]);
    tool.gripBegin(2, x + 40, y, 9);
    expect(tool.takes(x, y), "a third one rests").toBe("ignore");
  });

  it("a tap puts the ring around a limb, and beside it takes it away", () => {
    const { tool, sent, x, y } = setUp();
    tool.gripBegin(1, x, y, 5);
    tool.gripEnd(1);
    expect(tool.chosen.value).toBe(7);
    tool.gripBegin(1, 900, 100, 5);
    tool.gripEnd(1);
    expect([tool.chosen.value, sent]).toEqual([null, []]);
  });

  it("the ring is pulled away from the limb's middle", () => {
    const { tool, sent, x, y } = setUp();
    const before = tool.diameterOf(7);
    tool.take(7, 50);
    tool.pull(x, y + 70);
    tool.letGo();
    expect(diameters(sent)[0]).toBeCloseTo(before + 0.4, 2);
    tool.take(7, 50);
    tool.pull(x, y);
    tool.pull(x, y + 10);
    tool.letGo();
    expect(diameters(sent)[1], "from where it was left").toBeCloseTo(before + 0.4 - 0.8, 2);
  });

  it("no limb is made thinner or thicker than can be", () => {
    const { tool, sent } = setUp();
    tool.choose(7);
    for (const typed of [-3, 0, 1e9, Number.NaN, 2.34567]) tool.type(typed);
    expect(diameters(sent)).toEqual([0.01, 0.01, 100, 2.35]);
  });

  it("a server that is behind gets the newest only", () => {
    const { tool, sent, world, x, y } = setUp();
    world.unsettled = 4;
    tool.take(7, 0);
    for (const away of [50, 60, 70]) {
      tool.pull(x, y + away);
      tool.tick();
    }
    expect(sent).toEqual([]);
    tool.letGo();
    expect(diameters(sent)).toEqual([Number((tool.diameterOf(7) + 1.4).toPrecision(3))]);
  });
});

describe("what is shown", () => {
  it("stays as wanted until the rows have it", () => {
    const { table, tool, view, world } = setUp();
    tool.choose(7);
    tool.type(1);
    world.unsettled = 1;
    tool.changed();
    vi.advanceTimersByTime(9000);
    expect([tool.wanted.value, drawn(view.overlays)]).toEqual([1, [1]]);
    world.unsettled = 0;
    tableOf(
      SMALL.map((twig, row) => (row === 7 ? { ...twig, radius: 0.5 } : twig)),
      table,
    );
    tool.changed();
    expect([tool.wanted.value, view.overlays.size]).toEqual([null, 0]);
  });

  it("gives way where the server made something else of it", () => {
    const { tool, view } = setUp();
    tool.choose(7);
    tool.type(50);
    expect(view.overlays.size).toBe(1);
    vi.advanceTimersByTime(9000);
    expect([tool.wanted.value, view.overlays.size]).toEqual([null, 0]);
  });

  it("a limb gets no slimmer than what it bears is held to be", () => {
    const { tool, view, receive } = setUp();
    receive([{ row: 8, diameter: 1.2, effective: 1.2 }]);
    tool.choose(7);
    tool.type(0.2);
    expect(drawn(view.overlays)).toEqual([1.2]);
  });

  it("a width is removed, and one that was never set sends nothing", () => {
    const { tool, sent, receive } = setUp();
    tool.choose(7);
    tool.remove();
    expect([tool.chosen.value, sent]).toEqual([null, []]);
    receive([{ row: 7, diameter: 1, effective: 1 }]);
    tool.choose(7);
    tool.remove();
    expect(sent).toEqual([{ kind: "set_width", row: 7, diameter: null }]);
  });

  it("a width moves along the limb", () => {
    const { tool, sent, receive } = setUp();
    receive([{ row: 7, diameter: 1.5, effective: 1.5 }]);
    tool.choose(7);
    tool.shift(8);
    expect(sent).toMatchObject([
      { row: 7, diameter: null },
      { row: 8, diameter: 1.5 },
    ]);
    expect(tool.chosen.value).toBe(8);
    const gestures = sent.map((command) => (command.kind === "set_width" ? command.gesture : null));
    expect(gestures[0]).toBe(gestures[1]);
  });

  it("keys move a width along its own limb only", () => {
    const { tool, sent, world, receive } = setUp();
    receive([{ row: 7, diameter: 1.5, effective: 1.5 }]);
    tool.choose(7);
    expect(tool.place()).toEqual({ along: 2, of: 4 });
    tool.step(1);
    tool.step(1);
    expect([tool.chosen.value, tool.widths.value]).toEqual([9, [{ row: 9, diameter: 1.5, effective: 1.5 }]]);
    tool.step(1);
    expect(sent, "no further than its tip").toHaveLength(4);
    world.unsettled = 1;
    tool.step(-1);
    expect(tool.chosen.value, "the move before is not answered").toBe(9);
    world.unsettled = 0;
    tool.step(-9);
    expect([tool.chosen.value, tool.place()]).toEqual([6, { along: 1, of: 4 }]);
  });

  it("a width that is given up is what it was before, in the same gesture", () => {
    const { tool, sent, receive } = setUp();
    tool.take(7, 10);
    tool.pull(900, 400);
    tool.cancel();
    expect(sent).toEqual([]);
    receive([{ row: 7, diameter: 1.5, effective: 1.5 }]);
    tool.take(7, 10);
    tool.pull(900, 400);
    tool.tick();
    tool.cancel();
    expect(sent).toMatchObject([{ row: 7 }, { row: 7, diameter: 1.5 }]);
    expect(sent[0]).toHaveProperty("gesture", sent[1]?.kind === "set_width" ? sent[1].gesture : null);
    expect(tool.wanted.value).toBeNull();
  });

  it("Escape first gives up how far the ring was pulled, then the ring", () => {
    const { tool, sent, view, x, y } = setUp();
    tool.take(7, 50);
    tool.pull(x + 90, y);
    tool.tick();
    expect(tool.release()).toBe(true);
    expect(diameters(sent).at(-1), "it was not set before").toBe(null);
    expect([tool.chosen.value, view.overlays.size]).toEqual([7, 0]);
    tool.pull(x + 120, y);
    tool.letGo();
    expect(sent, "the user that still pulls does nothing more").toHaveLength(2);
    expect([tool.release(), tool.chosen.value]).toEqual([true, null]);
  });

  it("a limb that is gone takes its ring along", () => {
    const { table, tool, view } = setUp();
    tool.choose(7);
    tool.type(1);
    tableOf(
      SMALL.map((twig, row) => (row >= 6 && row <= 11 ? { ...twig, dead: true } : twig)),
      table,
    );
    tool.changed();
    expect([tool.chosen.value, tool.wanted.value, view.overlays.size]).toEqual([null, null, 0]);
  });
});
