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

/** Takes the thinnest brush there is. */
async function slender({ page }: Tablet): Promise<void> {
  await page.getByLabel("Brush radius", { exact: true }).focus();
  await page.keyboard.press("Home");
}

/** A tablet whose way to the server can be made slow. */
async function far(): Promise<{ readonly tablet: Tablet; readonly link: SlowLink; readonly seed: Point }> {
  const link = await SlowLink.to(workshop.server.address);
  links.push(link);
  const tablet = await workshop.open(link.address(await workshop.server.newSession(5)), LANDSCAPE);
  const seed = await seedling(tablet);
  return { tablet, link, seed };
}

/** How the ghost of a stroke kept up with the finger, in pixels and frames of the page. */
interface Kept {
  /** Frames in which there was a ghost. */
  frames: number;
  /** How many frames after the finger first moved there was one. */
  after: number;
  /** How far its tip was at most from where the finger was in that frame, */
  far: number;
  /** and from where it was in that frame or one of the two before. */
  farthest: number;
  /** The radius of the brush. */
  radius: number;
  /** How long it was at most: so far the wood was behind the finger. */
  longest: number;
  /** How far wood was from the ghost that was there in the frame before it came, each time that some came. */
  jumps: number[];
}

/** Watches it from now on, frame by frame, as the page itself knows the finger: no machine is too slow for that. */
async function watchTip({ page }: Tablet): Promise<() => Promise<Kept>> {
  const kept = await page.evaluateHandle(() => {
    type At = readonly [x: number, y: number];
    const kept: Kept = { frames: 0, after: 0, far: 0, farthest: 0, radius: 0, longest: 0, jumps: [] };
    const apart = ([x, y]: At, [u, v]: At) => Math.hypot(x - u, y - v);
    const fromLine = (at: At, line: readonly At[]) =>
      Math.min(
        ...line.map((to, i) => {
          const from = line[i - 1] ?? to;
          const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
          const along = ((at[0] - from[0]) * dx + (at[1] - from[1]) * dy) / (dx * dx + dy * dy || 1);
          const t = Math.min(1, Math.max(0, along));
          return apart(at, [from[0] + t * dx, from[1] + t * dy]);
        }),
      );
    let finger: At | null = null;
    let isDown = true;
    let before: At[] = [];
    let ghost: At[] = [];
    const capture = { capture: true };
    window.addEventListener("pointermove", ({ clientX, clientY }) => (finger = [clientX, clientY]), capture);
    window.addEventListener("pointerup", () => (isDown = false), capture);
    const look = () => {
      requestAnimationFrame(look);
      if (finger === null) return;
      before = [finger, ...before].slice(0, 3);
      // Its places are the middles of discs, from the wood that has come to the brush.
      const path = document.querySelector(".stroke-ghost-limb")?.getAttribute("d") ?? "";
      const discs = [...path.matchAll(/M(-?[\d.]+) (-?[\d.]+)a([\d.]+)/g)];
      const places = discs.map(([, x, y, radius]): At => [Number(x) + Number(radius), Number(y)]);
      const [foot, tip] = [places[0], places.at(-1)];
      if (kept.frames === 0 && !tip) kept.after += 1;
      if (foot && ghost.length > 0 && ghost.every((place) => apart(place, foot) > 0.5)) {
        kept.jumps.push(fromLine(foot, ghost));
      }
      ghost = places;
      if (!tip) return;
      kept.frames += 1;
      const breadth = /a([\d.]+)/.exec(document.querySelector(".stroke-ghost-breadth")?.getAttribute("d") ?? "");
      kept.radius = Number(breadth?.[1]);
      if (!isDown) return;
      kept.far = Math.max(kept.far, apart(tip, finger));
      kept.farthest = Math.max(kept.farthest, Math.min(...before.map((at) => apart(at, tip))));
      kept.longest = Math.max(kept.longest, apart(places[0]!, tip));
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

/** The ways of the table in docs/performance.md. */
const WAYS = [
  ["as fast as the machine", null],
  ["1 Mbit/s, 150 ms", MOBILE],
] as const;
const BRUSHES = ["as it is", "thinnest"] as const;

test.each(WAYS.flatMap(([name, slowness]) => BRUSHES.map((brush) => [name, brush, slowness] as const)))(
  "CM11: over a link %s, the brush %s, wood takes the place of the ghost, which stays at the finger",
  async (name, brush, slowness) => {
    const { tablet, link, seed } = await far();
    if (brush === "thinnest") await slender(tablet);
    link.slow(slowness);
    const { metamers } = await tablet.facts();
    const kept = await watchTip(tablet);
    const path = way(seed, { x: seed.x + 60, y: seed.y - 420 }, 60);
    await tablet.lead([path.slice(0, 6)]);
    for (const finger of path.slice(6)) {
      await tablet.touch("touchMove", [finger]);
      await tablet.page.waitForTimeout(16);
    }
    await tablet.touch("touchEnd", []);
    await tablet.until("it grows", (facts) => facts.metamers > metamers + 8);
    await until("no ghost is left", async () => (await ghosts(tablet)) === 0);
    const { after, radius, far: behind, farthest, longest, jumps } = await kept();
    const jump = [...jumps].sort((a, b) => a - b);
    const figures = [radius, behind, farthest, longest, jump[jump.length >> 1], jump.at(-1)];
    console.log(`| ${[name, brush, after, ...figures.map((figure) => figure?.toFixed(1))].join(" | ")} |`);
    expect(farthest, "its tip is where the brush is").toBeLessThan(8);
    expect(jumps.length, "wood has come while it was drawn").toBeGreaterThan(0);
  },
);

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
  await slender(tablet);
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
