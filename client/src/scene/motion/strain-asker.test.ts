import { describe, expect, it } from "vitest";
import { SWAYING_TREES, tableOfSwaying } from "../../../test/swaying-trees";
import type { DrawnObstacle } from "../obstacle-meshes";
import { CALM } from "./air-settings";
import { motionRows } from "./motion-rows";
import { type StrainTask, StrainWork } from "./strain";
import { StrainAsker, type StrainOrder, type StrainWorker } from "./strain-asker";

const tree = SWAYING_TREES[0]!;
const order = (snow: number): StrainOrder => ({
  rows: motionRows(tableOfSwaying(tree)),
  scale: tree,
  air: { ...CALM, snow },
  obstacles: [],
});
const brokenBy = (order: StrainOrder) => new StrainWork().broken({ ...order, obstacles: { standing: [], meshes: [] } });

function setUp(start?: () => StrainWorker) {
  const answers: Int32Array[] = [];
  const sent: StrainTask[] = [];
  const work = new StrainWork();
  const worker: StrainWorker & { ended: boolean } = {
    onmessage: null,
    onerror: null,
    postMessage: (task) => void sent.push(structuredClone(task)),
    terminate: () => {
      worker.ended = true;
    },
    ended: false,
  };
  const asker = new StrainAsker((rows) => answers.push(rows), start ?? (() => worker));
  const answer = () => worker.onmessage?.({ data: work.broken(sent.at(-1)!) });
  return { asker, worker, sent, answers, answer };
}

describe("what would break", () => {
  it("is asked beside the page, and of several questions only the last is answered", () => {
    const { asker, sent, answers, answer } = setUp();
    for (const snow of [0.1, 0.2, 0.5]) asker.ask(order(snow));
    expect([sent.length, answers.length]).toEqual([1, 0]);
    answer();
    expect([sent.length, answers.length], "the first is of no use any more").toEqual([2, 0]);
    expect(sent[1]!.air.snow).toBe(0.5);
    answer();
    expect(answers).toEqual([brokenBy(order(0.5))]);
    expect(answers[0]!.length).toBeGreaterThan(0);
  });

  it("is found on the page where there is no worker, or where it ends", () => {
    const without = setUp(() => {
      throw new Error("no workers here");
    });
    without.asker.ask(order(0.5));
    expect(without.answers).toEqual([brokenBy(order(0.5))]);
    const { asker, worker, answers } = setUp();
    asker.ask(order(0.5));
    worker.onerror?.();
    expect([answers.length, worker.ended]).toEqual([1, true]);
    asker.ask(order(0.5));
    expect(answers.length, "from then on as well").toBe(2);
  });

  it("is less behind a wall, be it a mesh that is sent but once", () => {
    const storm = { ...order(0), air: { ...CALM, speed: 25, turbulence: 1 } };
    const sheet = {
      positions: new Float32Array([0, -100, -1000, 0, 100, -1000, 0, 100, 1000, 0, -100, 1000]),
      triangles: new Uint32Array([0, 1, 2, 0, 2, 3]),
    };
    const wall = (x: number): DrawnObstacle => ({
      id: 2,
      shape: { kind: "mesh", vertices: 4, triangles: 2, scale: 1 },
      pose: { position: [x, 100, 0] },
      mesh: sheet,
    });
    const ways = [
      setUp(),
      setUp(() => {
        throw new Error("no workers here");
      }),
    ];
    for (const { asker, sent, answers, answer } of ways) {
      for (const obstacles of [[], [wall(-30)], [wall(30)], [wall(-30)]]) {
        asker.ask({ ...storm, obstacles });
        answer();
      }
      const [open, behind, beyond, again] = answers.map(({ length }) => length) as [number, number, number, number];
      expect(open).toBeGreaterThan(0);
      expect(behind, "behind it").toBeLessThan(0.5 * open);
      expect([beyond, again], "downwind of the tree it shelters nothing").toEqual([open, behind]);
      expect(sent.map(({ obstacles }) => obstacles.meshes.length)).toEqual(sent.length > 0 ? [0, 1, 0, 0] : []);
    }
  });

  it("is told to nobody once nobody asks any more", () => {
    const { asker, worker, answers, answer, sent } = setUp();
    asker.ask(order(0.5));
    asker.forget();
    expect(worker.ended).toBe(true);
    asker.ask(order(0.1));
    expect([sent.length, answers.length]).toEqual([2, 0]);
    answer();
    expect(answers.length).toBe(1);
  });
});
