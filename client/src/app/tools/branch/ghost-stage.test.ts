import { describe, expect, it } from "vitest";
import { PlainTable } from "../../../../test/plain-table";
import { sampleTree } from "../../../../test/sample-tree";
import type { BendOverlay } from "../../../scene/overlay/bend-overlay";
import type { GhostPlacement } from "../../../scene/overlay/ghost";
import type { Overlay } from "../../../scene/overlay/overlays";
import type { TreeTable } from "../../../scene/table/tree-table";
import type { Viewport } from "../../../scene/viewport";
import { about } from "./branch-turn";
import { GhostStage } from "./ghost-stage";

function tree(height: number): TreeTable {
  const table = new PlainTable(() => 0);
  table.apply({ ...sampleTree({ seed: 3, height, orders: 2 }), catchUp: true });
  return table;
}

function setUp(right: readonly [number, number, number] = [1, 0, 0]) {
  const table = tree(10);
  const seen = {
    placement: null as GhostPlacement | null,
    shown: false,
    fitted: 0,
    restored: 0,
    overlays: new Set<Overlay>(),
  };
  const view = {
    drawingPlane: () => ({ origin: [0, 0, 0], right, up: [0, 1, 0] }),
    showGhost: (plants: TreeTable | null) => {
      seen.shown = plants !== null;
    },
    placeGhost: (placement: GhostPlacement) => {
      seen.placement = placement;
    },
    camera: {
      fitTree: () => {
        seen.fitted += 1;
      },
      restore: () => {
        seen.restored += 1;
      },
    },
    addOverlay: (overlay: Overlay) => seen.overlays.add(overlay),
    removeOverlay: (overlay: Overlay) => seen.overlays.delete(overlay),
    overlayChanged: () => {},
  } as unknown as Viewport;
  const stage = new GhostStage(table);
  stage.attach(view);
  return { stage, table, seen };
}

describe("a prediction beside the tree", () => {
  it("stands to the right on the screen, clear of the tree", () => {
    for (const right of [
      [1, 0, 0],
      [0, 0, -1],
      [-0.6, 0, 0.8],
    ] as const) {
      const { stage, table, seen } = setUp(right);
      const plants = tree(14);
      stage.showBeside(plants);
      const [x = 0, y = 0, z = 0] = seen.placement?.to ?? [];
      expect(y).toBe(0);
      const across = (px: number, pz: number) => px * right[0] + pz * right[2];
      const all = (of: TreeTable) =>
        Array.from({ length: of.rows }, (_, row) => across(of.position[3 * row]!, of.position[3 * row + 2]!));
      expect(Math.min(...all(plants)) + across(x, z)).toBeGreaterThan(Math.max(...all(table)));
    }
  });

  it("keeps its place while it looks further ahead, and the camera moves once", () => {
    const { stage, seen } = setUp();
    stage.showBeside(tree(12));
    const first = seen.placement?.to;
    stage.showBeside(tree(16));
    expect([seen.placement?.to, seen.fitted]).toEqual([first, 1]);
    stage.endBeside(null);
    expect([seen.shown, seen.restored, stage.beside.peek()]).toEqual([false, 1, null]);
  });
});

describe("a branch that is turned", () => {
  it("is shown about its base, and removed", () => {
    const { stage, table, seen } = setUp();
    const row = 5;
    const base = [0, 1, 2].map((axis) => table.position[3 * table.parent[row]! + axis]!) as [number, number, number];
    stage.showTurn({ row, rotation: about([0, 0, 1], 1), about: base });
    stage.showTurn({ row, rotation: about([0, 0, 1], 1.2), about: base });
    expect([...seen.overlays].map((overlay) => (overlay as BendOverlay).path)).toEqual([[row]]);
    stage.showTurn(null);
    expect(seen.overlays.size).toBe(0);
  });
});
