import { describe, expect, it } from "vitest";
import { type Box, changed } from "./picture";
import { COARSE, PHONE, type Screen, SMALL } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import { middle, way } from "./ways";
import { seedling, Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

const UPRIGHT: Screen = { width: 834, height: 1194, detail: 0.4 };

const labelled = (tablet: Tablet, label: string) => tablet.page.getByLabel(label, { exact: true });

const apart = (a: Box, b: Box) =>
  a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y;

/** The canvas, once it has taken its place beside a panel or alone. */
async function canvas(tablet: Tablet, wanted: (box: Box) => boolean): Promise<Box> {
  let box = await tablet.boxOf(tablet.page.locator("#workspace"));
  await until("the workspace takes its place", async () => {
    box = await tablet.boxOf(tablet.page.locator("#workspace"));
    return wanted(box);
  });
  return box;
}

/** Commands the page sends from its next loading on. */
function overheard(tablet: Tablet): Record<string, unknown>[] {
  const sent: Record<string, unknown>[] = [];
  tablet.page.on("websocket", (socket) =>
    socket.on("framesent", ({ payload }) => {
      const message = JSON.parse(String(payload));
      sent.push(message.command ?? message);
    }),
  );
  return sent;
}

/** Taps one of a sheet's choices. */
async function choose(tablet: Tablet, text: string): Promise<void> {
  const choice = tablet.page.locator("dialog label").filter({ hasText: text });
  await choice.tap();
  await until(`${text} is chosen`, () => choice.locator("input").isChecked());
}

it("draws what is behind a menu that scrolls on the smallest glass", async () => {
  const { tablet } = await workshop.fresh({ ...PHONE, width: 320, height: 568, detail: 1 });
  const closed = await tablet.photograph("81-menu-closed-smallest");
  await tablet.press(tablet.page.getByRole("button", { name: "More", exact: true }));
  const menu = tablet.page.locator(".more > .menu");
  await menu.waitFor();
  const open = await tablet.photograph("81-menu-smallest");
  const { x, y, width, height } = await tablet.boxOf(menu);
  expect(height).toBeLessThan(await menu.evaluate(({ scrollHeight }) => scrollHeight));
  // Between it and the bar is the sky, in the shadow of both.
  const bar = await tablet.boxOf(tablet.page.locator(".tool-bar"));
  const foot = Math.ceil(bar.y + bar.height) + 1;
  const strip = { x: Math.round(x) + 12, y: foot, width: Math.round(width) - 24, height: Math.floor(y) - foot - 1 };
  expect(strip.height).toBeGreaterThan(1);
  expect(changed(closed, open, strip)).toBeLessThan(0.05);
});

describe("panels", () => {
  it("shrink the workspace, which stays in use", async () => {
    const { tablet } = await workshop.fresh();
    for (const name of ["Architecture", "Brush", "Leaves", "Branches", "Background", "Scene"]) {
      await tablet.tap(name);
      const panel = tablet.page.getByRole("region", { name, exact: true });
      await panel.waitFor();
      const shrunk = await canvas(tablet, ({ width }) => width < 900);
      expect(apart(shrunk, await tablet.boxOf(panel)), name).toBe(true);
      expect(shrunk.height).toBe(COARSE.height);
    }
    const { x, y, width } = await canvas(tablet, ({ width }) => width < 900);
    const before = await tablet.facts();
    await tablet.swipe([way({ x: x + width / 2, y: y + 600 }, { x: x + width / 2, y: y + 330 })]);
    expect((await tablet.untilQuiet()).metamers).toBeGreaterThan(before.metamers);
    await tablet.tap("Scene");
    await canvas(tablet, ({ width }) => width === COARSE.width);
  });

  it("lie at the foot where the tablet stands upright", async () => {
    const { tablet } = await workshop.fresh(UPRIGHT);
    await tablet.tap("Leaves");
    const panel = tablet.page.getByRole("region", { name: "Leaves", exact: true });
    await panel.waitFor();
    const shrunk = await canvas(tablet, ({ height }) => height < 900);
    expect(shrunk.width).toBe(UPRIGHT.width);
    expect((await tablet.boxOf(panel)).y).toBeGreaterThanOrEqual(shrunk.y + shrunk.height - 1);
  });

  it("hide with everything else, and come back", async () => {
    const { tablet } = await workshop.fresh();
    await tablet.tap("Brush");
    await canvas(tablet, ({ width }) => width < 900);
    await tablet.tap("Hide everything");
    await canvas(tablet, ({ width }) => width === COARSE.width);
    await expect.poll(() => tablet.page.locator(".tool-bar, .side-bar, .foot, .drawer").count()).toBe(0);
    await tablet.tap("Show everything");
    await labelled(tablet, "Undo").waitFor();
    await tablet.page.keyboard.press("h");
    await labelled(tablet, "Show everything").waitFor();
    await tablet.page.keyboard.press("Escape");
    await labelled(tablet, "Undo").waitFor();
  });
});

describe("a bar that comes", () => {
  it("rises in its place, and does not slide in from beside", async () => {
    const { tablet } = await workshop.fresh(SMALL);
    await tablet.take("Bend");
    const bar = tablet.page.locator(".tool-options");
    await bar.waitFor();
    await tablet.untilSettled();
    const { stands, begins, comes } = await bar.evaluate((bar: HTMLElement) => {
      const place = () => {
        const { left, width, top } = bar.getBoundingClientRect();
        return { middle: left + width / 2, top };
      };
      const stands = place();
      // It comes once more, and is looked at as it begins to.
      bar.style.animation = "none";
      void bar.offsetWidth;
      bar.style.animation = "";
      const animations = bar.getAnimations();
      for (const animation of animations) {
        animation.pause();
        animation.currentTime = 0;
      }
      return { stands, begins: place(), comes: animations.length };
    });
    expect(comes, "it is animated").toBeGreaterThan(0);
    expect(begins.top, "from below").toBeGreaterThan(stands.top + 2);
    expect(begins.middle).toBeCloseTo(stands.middle, 0);
  });
});

describe("the strip that turns", () => {
  const turned = async (tablet: Tablet) =>
    Number(await labelled(tablet, "Turn the tree").getAttribute("aria-valuenow"));

  it("turns by a finger, and by keys", async () => {
    const { tablet } = await workshop.fresh();
    await tablet.untilStill();
    const strip = await tablet.boxOf(labelled(tablet, "Turn the tree"));
    const { x, y } = middle(strip);
    await tablet.swipe([way({ x, y }, { x: x + strip.width / 4, y })]);
    await until("a quarter of the strip is a quarter turn", async () => Math.abs((await turned(tablet)) - 90) <= 3);
    await labelled(tablet, "Turn the tree").focus();
    await tablet.page.keyboard.press("Home");
    await until("home is the front", async () => (await turned(tablet)) === 0);
    await tablet.page.keyboard.press("ArrowLeft");
    await until("an arrow is five degrees", async () => (await turned(tablet)) === -5);
  });

  it("says where the view came to rest, however slow the frames are", async () => {
    const { tablet } = await workshop.fresh();
    await tablet.untilStill();
    await tablet.page.evaluate(() => {
      const soon = window.requestAnimationFrame.bind(window);
      window.requestAnimationFrame = (draw) => Number(setTimeout(() => soon(draw), 1000));
      window.cancelAnimationFrame = (handle) => clearTimeout(handle);
    });
    await labelled(tablet, "Turn the tree").focus();
    await tablet.page.keyboard.press("PageUp");
    await until("a page key turns by an eighth", async () => (await turned(tablet)) === 45);
    await tablet.page.keyboard.press("Home");
    await until("home is the front", async () => (await turned(tablet)) === 0);
  });

  it("lets a stroke wind around the tree", async () => {
    const { tablet } = await workshop.fresh();
    const sent = overheard(tablet);
    await tablet.page.reload();
    await tablet.untilReady();
    await tablet.untilStill();
    const strip = await tablet.boxOf(labelled(tablet, "Turn the tree"));
    const [left, y] = [strip.x + 12, strip.y + strip.height / 2];
    const seed = await seedling(tablet);
    const drawing = { x: seed.x + 60, y: seed.y - 40 };
    const steps = 48;
    for (let i = 0; i < steps; i++) {
      // The drawing finger only rises; the other hand turns the tree by nearly a whole turn.
      const fingers = [
        { x: drawing.x, y: drawing.y - 5 * i },
        { x: left + ((strip.width - 24) * Math.max(0, i - 4)) / (steps - 5), y },
      ];
      await tablet.touch(i === 0 ? "touchStart" : "touchMove", i === 0 ? fingers.slice(0, 1) : fingers);
      if (i === 3) await tablet.touch("touchStart", fingers);
      await tablet.frames();
    }
    await tablet.touch("touchEnd", []);
    await tablet.untilQuiet();
    const samples = sent.flatMap(({ kind, samples }) =>
      kind === "stroke_move" ? (samples as { position: [number, number, number] }[]) : [],
    );
    const places = samples.map(({ position }) => position);
    expect(places.length).toBeGreaterThan(20);
    // Around the seed at the origin: in all four quarters, at one distance, and rising.
    const quarters = new Set(places.map(([x, , z]) => `${x < 0} ${z < 0}`));
    expect(quarters.size).toBe(4);
    const radii = places.map(([x, , z]) => Math.hypot(x, z));
    expect(Math.max(...radii) / Math.min(...radii)).toBeLessThan(1.5);
    expect(places.at(-1)![1] - places[0]![1]).toBeGreaterThan(5);
    await tablet.until("it is one stroke", ({ operations }) => operations === "stroke");
    await tablet.show("helix");
  });
});

describe("settings", () => {
  it("a language is spoken at once, and remembered", async () => {
    const { tablet } = await workshop.fresh();
    await tablet.tap("Settings");
    await choose(tablet, "Deutsch");
    await labelled(tablet, "Einstellungen").first().waitFor();
    await tablet.page.keyboard.press("Escape");
    await tablet.page.reload();
    await tablet.untilReady();
    await labelled(tablet, "Rückgängig").waitFor();
    await expect.poll(() => tablet.page.evaluate(() => document.documentElement.lang)).toBe("de");
    await tablet.page.keyboard.press("Shift+?");
    await tablet.page.getByRole("dialog", { name: "So zeichnet man einen Baum" }).waitFor();
  });

  it("a theme is worn at once, and remembered", async () => {
    const { tablet } = await workshop.fresh();
    const ink = () => tablet.page.evaluate(() => getComputedStyle(document.documentElement).color);
    const light = await ink();
    await tablet.tap("Settings");
    await choose(tablet, "Dark");
    await until("the ink is another", async () => (await ink()) !== light);
    const dark = await ink();
    await tablet.page.reload();
    await tablet.untilReady();
    await expect.poll(ink).toBe(dark);
  });

  it("tools stand at the side that was chosen", async () => {
    const { tablet } = await workshop.fresh();
    await tablet.tap("Settings");
    await choose(tablet, "right");
    await tablet.page.keyboard.press("Escape");
    await tablet.page.getByRole("dialog").waitFor({ state: "detached" });
    expect((await tablet.boxOf(tablet.page.getByRole("navigation"))).x).toBeGreaterThan(COARSE.width / 2);
    await tablet.tap("Leaves");
    expect((await canvas(tablet, ({ width }) => width < 900)).x).toBeGreaterThan(200);
  });
});

describe("a phone", () => {
  it("has all bars on its glass, none over another", async () => {
    const { tablet } = await workshop.fresh(PHONE);
    const bars = await Promise.all(
      [".tool-bar", ".side-bar", ".rotation"].map((bar) => tablet.boxOf(tablet.page.locator(bar))),
    );
    for (const [i, bar] of bars.entries()) {
      expect(bar.x).toBeGreaterThanOrEqual(0);
      expect(bar.y).toBeGreaterThanOrEqual(0);
      expect(bar.x + bar.width).toBeLessThanOrEqual(PHONE.width);
      expect(bar.y + bar.height).toBeLessThanOrEqual(PHONE.height);
      for (const other of bars.slice(i + 1)) expect(apart(bar, other)).toBe(true);
    }
    // What stands at the edges takes less than a third of the glass.
    const covered = bars.reduce((sum, { width, height }) => sum + width * height, 0);
    expect(covered).toBeLessThan((PHONE.width * PHONE.height) / 3);
    await tablet.tap("All tools: Brush");
    await tablet.take("Lasso");
    await tablet.tap("More");
    await tablet.page.getByRole("button", { name: "Save", exact: true }).tap();
    await tablet.page.getByRole("dialog", { name: "Save this tree" }).waitFor();
  });

  it("draws beside a panel", async () => {
    const { tablet } = await workshop.fresh(PHONE);
    await tablet.tap("Scene");
    const { width, height } = await canvas(tablet, ({ height }) => height < 600);
    expect(height).toBeGreaterThan(380);
    await tablet.swipe([way({ x: width / 2 + 60, y: height * 0.7 }, { x: width / 2 + 60, y: height * 0.35 })]);
    expect((await tablet.untilQuiet()).metamers).toBeGreaterThan(0);
  });
});
