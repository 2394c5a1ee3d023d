import { describe, expect, it } from "vitest";
import { WHOLE } from "../../scene/camera/view";
import { FirstView } from "./first-view";

function setUp(query = "") {
  const done: unknown[] = [];
  const table = { rows: 0, parent: new Int32Array([-1, 0, 1]) };
  const stage = { look: (view: unknown) => done.push(view), fitTree: () => done.push("fit") };
  return { done, table, view: new FirstView({ stage, table, query: () => query }) };
}

describe("first view", () => {
  it("stays as it is for a seed", () => {
    const { done, table, view } = setUp();
    view.follow();
    table.rows = 1;
    view.follow();
    table.rows = 3;
    view.follow();
    expect(done).toEqual([]);
  });

  it("shows a tree that is there already as a whole, once", () => {
    const { done, table, view } = setUp();
    table.rows = 3;
    view.follow();
    view.follow();
    expect(done).toEqual([WHOLE]);
  });

  it("of another session fits the tree, from where the eye is", () => {
    const { done, table, view } = setUp();
    table.rows = 1;
    view.follow();
    view.forget();
    table.rows = 3;
    view.follow();
    expect(done).toEqual(["fit"]);
  });

  it("is what the address asks for", () => {
    const { done, table, view } = setUp("?yaw=30");
    table.rows = 1;
    view.follow();
    expect(done).toEqual([{ ...WHOLE, yaw: 30 }]);
  });
});
