import { afterEach, expect, test } from "vitest";
import { LANDSCAPE } from "./screens";
import { until } from "./server";
import { MOBILE, SlowLink } from "./slow-link";
import type { Tablet } from "./tablet";
import { type Point, way } from "./ways";
import { seedling, Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer();

const links: SlowLink[] = [];
afterEach(async () => {
  for (const link of links.splice(0)) await link.close();
});

/** A tablet whose way to the server can be made slow. */
async function far(): Promise<{ readonly tablet: Tablet; readonly link: SlowLink; readonly seed: Point }> {
  const link = await SlowLink.to(workshop.server.address);
  links.push(link);
  const tablet = await workshop.open(link.address(await workshop.server.newSession(5)), LANDSCAPE);
  const seed = await seedling(tablet);
  return { tablet, link, seed };
}

/** How the ghost of a stroke that is drawn upwards kept up with the finger. */
interface Kept {
  /** Frames in which there was a ghost. */
  frames: number;
  /** How far its tip was at most from where the finger was in that frame or one of the two before, in pixels. */
  farthest: number;
}

/** Watches it from now on, frame by frame, as the page itself knows the finger: no machine is too slow for that. */
async function watchTip({ page }: Tablet): Promise<() => Promise<Kept>> {
  const kept = await page.evaluateHandle(() => {
    const kept = { frames: 0, farthest: 0 };
    let finger: number | null = null;
    let before: number[] = [];
    window.addEventListener("pointermove", ({ clientY }) => (finger = clientY), { capture: true });
    const look = () => {
      requestAnimationFrame(look);
      if (finger === null) return;
      before = [finger, ...before].slice(0, 3);
      const box = document.querySelector<SVGPathElement>(".stroke-ghost-limb")?.getBBox();
      if (!box || box.height === 0) return;
      kept.frames += 1;
      kept.farthest = Math.max(kept.farthest, Math.min(...before.map((y) => Math.abs(box.y - y))));
    };
    look();
    return kept;
  });
  return () => kept.evaluate((kept) => kept);
}

const ghosts = ({ page }: Tablet) => page.locator(".stroke-ghosts > g").count();

test("CM11: on 1 Mbit/s and 150 ms a stroke is under the finger at once, and gone when its wood is there", async () => {
  const { tablet, link, seed } = await far();
  link.slow(MOBILE);
  // However slow the machine is: nothing comes back before half of it is drawn.
  link.stall();
  const path = way(seed, { x: seed.x + 30, y: seed.y - 380 });
  const { metamers } = await tablet.facts();
  const kept = await watchTip(tablet);
  await tablet.lead([path.slice(0, 15)]);
  await until("its ghost is seen", async () => (await kept()).frames > 0);
  expect(await tablet.facts(), "nothing has come of it").toMatchObject({ metamers });
  await tablet.showNow("ghost-of-a-stroke");
  link.flow();
  for (const finger of path.slice(15)) {
    await tablet.touch("touchMove", [finger]);
    await tablet.page.waitForTimeout(16);
  }
  expect((await kept()).farthest, "its tip is where the brush is").toBeLessThan(8);
  await tablet.touch("touchEnd", []);
  await tablet.until("it grows", (facts) => facts.metamers > metamers + 8);
  await until("no ghost is left", async () => (await ghosts(tablet)) === 0);
  await tablet.untilQuiet();
  expect(await ghosts(tablet)).toBe(0);
});

test("CM1: a stroke that is drawn without a network is shown until it has grown", async () => {
  const { tablet, link, seed } = await far();
  link.cut();
  await tablet.until("it is without a network", ({ connection }) => connection !== "connected");
  await tablet.swipe([way(seed, { x: seed.x, y: seed.y - 300 })]);
  await until("its ghost waits", async () => (await ghosts(tablet)) === 1);
  // What nobody has acknowledged is spoken of.
  await tablet.page.getByText("your strokes are kept").waitFor();
  const { metamers, sent, acknowledged } = await tablet.facts();
  expect(sent).toBeGreaterThan(acknowledged);
  link.mend();
  await tablet.until("it has grown", (facts) => facts.connection === "connected" && facts.metamers > metamers + 5);
  await until("no ghost is left", async () => (await ghosts(tablet)) === 0);
  expect(await tablet.untilQuiet()).toMatchObject({ sent, acknowledged: sent, operations: "stroke" });
});

test("SG2: what is drawn where nothing can grow leaves no ghost", async () => {
  const { tablet, link, seed } = await far();
  link.slow(MOBILE);
  await tablet.page.getByLabel("Brush radius", { exact: true }).focus();
  await tablet.page.keyboard.press("Home");
  for (let pinch = 0; pinch < 3; pinch++) {
    await tablet.swipe([way({ x: 350, y: 420 }, { x: 510, y: 420 }), way({ x: 850, y: 420 }, { x: 690, y: 420 })]);
  }
  // It goes by itself.
  const vain = await tablet.watchFor('.vain[data-reason="out_of_reach"]');
  // Below the card of recent trees, however many of them there are.
  await tablet.swipe([way({ x: seed.x + 480, y: 430 }, { x: seed.x + 530, y: 370 })]);
  await vain();
  await tablet.showNow("ghost-in-vain");
  await until("no ghost is left", async () => (await ghosts(tablet)) === 0);
});

test("a seed is seen where it was planted before the server knows of it", async () => {
  const { tablet, link, seed } = await far();
  await tablet.take("Plant a seed");
  link.cut();
  await tablet.until("it is without a network", ({ connection }) => connection !== "connected");
  await tablet.tapAt({ x: seed.x + 150, y: seed.y });
  await tablet.page.locator('.seedling[data-coming="true"]').waitFor();
  link.mend();
  await until("it lies there", async () => {
    const coming = await tablet.page.locator('.seedling[data-coming="true"]').count();
    return coming === 0 && (await tablet.page.locator('.seedling[data-coming="false"]').count()) === 2;
  });
});
