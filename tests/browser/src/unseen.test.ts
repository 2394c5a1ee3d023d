import { expect, test } from "vitest";
import { becameTree } from "./picture";
import { SMALL } from "./screens";
import type { Tablet } from "./tablet";
import { way } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** Counts what is drawn from now on; this asks how much that was. */
async function countDraws({ page }: Tablet): Promise<() => Promise<number>> {
  await page.evaluate(() => {
    Object.assign(globalThis, { draws: 0 });
    const context = WebGL2RenderingContext.prototype;
    for (const name of ["drawArrays", "drawElements", "drawArraysInstanced", "drawElementsInstanced"] as const) {
      const draw = context[name] as (...args: unknown[]) => void;
      Object.assign(context, {
        [name](this: WebGL2RenderingContext, ...args: unknown[]) {
          (globalThis as unknown as { draws: number }).draws += 1;
          draw.apply(this, args);
        },
      });
    }
  });
  return () => page.evaluate(() => (globalThis as unknown as { draws: number }).draws);
}

test("a canvas that nobody looks at is left alone, and drawn as soon as somebody does", async () => {
  const { tablet } = await workshop.fresh(SMALL);
  const before = await tablet.photograph("unseen-seed");
  const draws = await countDraws(tablet);
  await tablet.swipe([way({ x: 450, y: 575 }, { x: 450, y: 250 })]);
  expect((await tablet.untilQuiet()).metamers).toBeGreaterThan(20);
  await tablet.untilStill();
  expect(await draws(), "nobody looked").toBe(0);
  const tree = await tablet.photograph("unseen-tree");
  expect(await draws()).toBeGreaterThan(0);
  expect(becameTree(before, tree, { x: 410, y: 270, width: 80, height: 290 }), "all that has grown").toBeGreaterThan(
    0.1,
  );
});
