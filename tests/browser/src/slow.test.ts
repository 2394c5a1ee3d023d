import { expect, test } from "vitest";
import { WATCHED } from "./screens";
import type { Tablet } from "./tablet";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** Turns the tree by its strip for some frames, while the page's clock says that each takes a fifth of a second. */
function turnSlowly(strip: Element, frames: number): Promise<void> {
  let now = performance.now();
  performance.now = () => now;
  return new Promise((resolve) => {
    const turn = (left: number) => {
      now += 200;
      if (left === 0) {
        Reflect.deleteProperty(performance, "now");
        return resolve();
      }
      strip.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true, cancelable: true }));
      requestAnimationFrame(() => turn(left - 1));
    };
    turn(frames);
  });
}

const turnIt = ({ page }: Tablet) => page.getByRole("slider", { name: "Turn the tree" }).evaluate(turnSlowly, 30);

test("a page without a graphics card says why its picture is coarse, once", async () => {
  const { tablet } = await workshop.drawn(WATCHED);
  await tablet.page.evaluate(() => localStorage.setItem("espalier.slowness-read", "false"));
  await tablet.page.reload();
  await tablet.untilReady();
  await tablet.untilStill();
  const line = tablet.page.locator('[data-slowness="cardless"]');
  await turnIt(tablet);
  await line.waitFor();
  await tablet.showNow("slow-line");
  expect(await line.textContent()).toContain("Without a graphics card");
  await line.getByRole("button", { name: "Got it" }).tap();
  await line.waitFor({ state: "detached" });
  await tablet.page.reload();
  await tablet.untilReady();
  await tablet.untilStill();
  await turnIt(tablet);
  await tablet.untilStill();
  expect(await line.count(), "who has read it is not told again").toBe(0);
});

/** What a page draws many things into, its canvas or a picture behind it, and whether it says by then why that is coarse. */
interface Drawing {
  readonly what: "lines" | "picture";
  readonly said: boolean;
}

/** Notes what is drawn; runs in the page before anything else. */
function noteDrawings(): void {
  const drawings: Drawing[] = [];
  const { prototype } = WebGL2RenderingContext;
  const draw = prototype.drawElementsInstanced;
  prototype.drawElementsInstanced = function (mode, count, type, offset, instances) {
    if (instances > 20) {
      const what = this.getParameter(this.FRAMEBUFFER_BINDING) === null ? "lines" : "picture";
      drawings.push({ what, said: document.querySelector('[data-slowness="cardless"]') !== null });
    }
    draw.call(this, mode, count, type, offset, instances);
  };
  Object.assign(globalThis, { drawings });
}

test("a large tree says so as it opens, is seen as lines first, and its picture comes to rest", async () => {
  const { tablet, address } = await workshop.fresh({ ...WATCHED, detail: 0.2 });
  await workshop.act(address, [{ kind: "grow", steps: 30 }]);
  await tablet.until("it is large", ({ metamers }) => metamers > 10_000);
  await tablet.page.evaluate(() => {
    localStorage.setItem("espalier.slowness-read", "false");
    localStorage.setItem("espalier.whole-picture", "false");
  });
  await tablet.page.addInitScript(noteDrawings);
  await tablet.page.reload();
  await tablet.page.locator('[data-slowness="cardless"]').waitFor();
  await tablet.untilStill();
  const drawings = await tablet.page.evaluate(() => (globalThis as unknown as { drawings: Drawing[] }).drawings);
  expect(drawings[0]).toEqual({ what: "lines", said: true });
  expect(drawings.filter(({ what }) => what === "lines")).toHaveLength(1);
  expect(drawings.at(-1)?.what).toBe("picture");
});

/** Asks for the errors of WebGL after every call that may make one from now on. */
async function watchErrors({ page }: Tablet): Promise<() => Promise<string[]>> {
  await page.evaluate(() => {
    const errors: string[] = [];
    const gl = document.querySelector<HTMLCanvasElement>("#workspace")!.getContext("webgl2")!;
    const names = [
      ...["drawArrays", "drawElements", "drawElementsInstanced", "clear", "blitFramebuffer", "readPixels"],
      ...["texStorage2D", "texSubImage2D", "renderbufferStorage", "renderbufferStorageMultisample", "generateMipmap"],
    ] as const;
    for (const name of names) {
      const call = gl[name as "clear"] as (...args: unknown[]) => unknown;
      Object.assign(gl, {
        [name]: (...args: unknown[]) => {
          const answer = call.apply(gl, args);
          const error = gl.getError();
          if (error !== gl.NO_ERROR) errors.push(`${name}: 0x${error.toString(16)}`);
          return answer;
        },
      });
    }
    Object.assign(globalThis, { errorsOfGl: errors });
  });
  return () => page.evaluate(() => (globalThis as unknown as { errorsOfGl: string[] }).errorsOfGl);
}

test("walls, panels, undo and a page of any size make no error of WebGL", async () => {
  const { tablet } = await workshop.drawn({ ...WATCHED, detail: 0.2 });
  await tablet.untilStill();
  const errors = await watchErrors(tablet);
  const { page } = tablet;
  await tablet.tap("Scene");
  await page.getByRole("button", { name: "Wall", exact: true }).tap();
  await tablet.until("the wall stands", ({ obstacles }) => obstacles === 1);
  await tablet.tap("Architecture");
  await tablet.frames();
  await tablet.tap("Undo");
  await tablet.until("the wall is gone", ({ obstacles }) => obstacles === 0);
  for (const [width, height] of [
    [3, 2],
    [900, 1],
    [1, 640],
    [834, 1194],
    [1194, 834],
  ] as const) {
    await page.setViewportSize({ width, height });
    await tablet.frames();
    await tablet.untilStill();
  }
  expect(await errors()).toEqual([]);
});
