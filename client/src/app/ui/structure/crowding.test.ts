import { describe, expect, it } from "vitest";
import type { Handle } from "../../document/design/branch-handles";
import type { BranchShape } from "../../document/design/branch-shape";
import { shownHandles } from "./crowding";

const SHAPE = {} as BranchShape;
const project = ([x, y]: readonly [number, number, number]) => [x, y] as const;

function handle(id: string, x: number, rest: Partial<Handle> = {}): Handle {
  return { id, group: "axis", place: () => [x, 0, 0], drag: () => null, ...rest };
}

describe("handles that a finger can hit", () => {
  it("are those that lie apart; one that is there comes before one that is not yet", () => {
    const handles = [handle("new-0", 0, { isNew: true }), handle("point-1", 10), handle("new-1", 40, { isNew: true })];
    const { ids, hidden } = shownHandles(handles, SHAPE, project, undefined);
    expect([[...ids].sort(), hidden]).toEqual([["new-1", "point-1"], { near: 1, along: 0 }]);
  });

  it("stay while they are held", () => {
    const handles = [handle("point-1", 10), handle("point-2", 12, { hides: () => true })];
    expect([...shownHandles(handles, SHAPE, project, "point-2").ids]).toEqual(["point-2"]);
  });

  it("are told from those that one looks along", () => {
    const sides = [0, 1].map((at) => handle(`side-${at}`, 60 * at, { hides: () => at === 1 }));
    expect(shownHandles(sides, SHAPE, project, undefined).hidden).toEqual({ near: 0, along: 1 });
    const none = sides.map((side) => ({ ...side, hides: () => true }));
    expect(shownHandles(none, SHAPE, project, undefined).hidden).toEqual({ near: 2, along: 0 });
  });
});
