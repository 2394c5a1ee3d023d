import { expect, test } from "vitest";
import { SMALL } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import { press } from "./visits";
import type { Point } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();
const SCREEN = { ...SMALL, watched: true };
const STORM = { speed: 16, direction: 0, turbulence: 1, suppleness: 1.5 };
const CALM = { speed: 0, turbulence: 0 };

/** Saves the tree and says something of one of its rows: its pin goes with the tree in the wind, and tells how that stands. */
async function pinned(tablet: Tablet, row: number): Promise<void> {
  await tablet.page.evaluate(async (row) => {
    const session = location.pathname.slice(location.pathname.lastIndexOf("/") + 1);
    const headers = { "content-type": "application/json" };
    const post = async (path: string, body: object) => {
      const answer = await fetch(path, { method: "POST", headers, body: JSON.stringify(body) });
      if (!answer.ok) throw new Error(await answer.text());
      return answer.json();
    };
    const { id } = await post("/api/v1/trees", { session, name: "Oak" });
    const pin = { session, at: { row, along: 1, offset: [0, 0, 0], place: [0, 0, 0] } };
    await post(`/api/v1/trees/${id}/threads`, { pin, comment: { text: "Here" } });
  }, row);
  await tablet.page.locator('.comment-pin[data-stands="true"]').first().waitFor({ state: "attached" });
}

/** Where the pin is in each of the page's next frames. */
async function followed(tablet: Tablet, frames: number): Promise<readonly Point[]> {
  return tablet.page.evaluate(
    (frames) =>
      new Promise<Point[]>((resolve) => {
        const seen: Point[] = [];
        const look = () => {
          const button = document.querySelector<HTMLElement>(".comment-pin button");
          const [, x, y] = /^(-?[\d.]+)px (-?[\d.]+)px$/.exec(button?.style.translate ?? "") ?? [];
          if (x !== undefined && y !== undefined) seen.push({ x: Number(x), y: Number(y) });
          if (seen.length < frames) requestAnimationFrame(look);
          else resolve(seen);
        };
        look();
      }),
    frames,
  );
}

/** Where the pin stands while the page's clock does: a frame that was begun before may have shown it elsewhere. */
const halted = async (tablet: Tablet) => (await followed(tablet, 4)).at(-1)!;
const apart = (a: Point, b: Point) => Math.hypot(a.x - b.x, a.y - b.y);
const reach = (seen: readonly Point[]) => Math.max(...seen.map((place) => apart(place, seen[0]!)));
const sways = (tablet: Tablet, when = "") =>
  until(`the tree sways${when}`, async () => reach(await followed(tablet, 10)) > 1);

/** Waits until the tree stands still, where it grew. */
async function rests(tablet: Tablet, rest: Point): Promise<void> {
  await until("the tree stands still", async () => reach(await followed(tablet, 10)) === 0);
  expect(apart((await followed(tablet, 1))[0]!, rest), "where it grew").toBeLessThan(0.5);
}

const blow = (address: string, wind: object) =>
  workshop.act(address, [{ kind: "set_appearance", appearance: { wind } }]);

test("a design stands still under a finger that shapes it, and sways on", async () => {
  const { tablet, address } = await workshop.fresh(SCREEN);
  await tablet.tap("Structure");
  await tablet.press(tablet.page.getByRole("button", { name: /^chokkan/ }));
  await tablet.until("the bonsai stands", ({ metamers }) => metamers > 100);
  await tablet.untilQuiet();
  await pinned(tablet, 60);
  const [rest] = await followed(tablet, 1);
  await blow(address, STORM);
  await sways(tablet);
  const tip = tablet.page
    .locator('[data-handle="stem-tip"][data-shown="true"], [data-handle="tip"][data-shown="true"]')
    .first();
  await tip.waitFor();
  const box = (await tip.boundingBox())!;
  await tablet.touch("touchStart", [{ x: box.x + box.width / 2, y: box.y + box.height / 2 }]);
  await rests(tablet, rest!);
  await tablet.touch("touchEnd", []);
  await sways(tablet);
  // What a finger draws beside handles is meant for the tree as it grew too.
  await tablet.press(tablet.page.getByRole("button", { name: "Draw", exact: true }));
  await tablet.touch("touchStart", [{ x: 300, y: 300 }]);
  await rests(tablet, rest!);
  await tablet.touch("touchEnd", []);
  await sways(tablet);
  await blow(address, CALM);
});

test("what a finger is on stands still with every tool, and sways on", async () => {
  const { tablet, address, metamers } = await workshop.stem(SCREEN);
  await pinned(tablet, metamers - 2);
  // The pin lies on the wood, and would take the finger that is meant for that.
  await tablet.page.addStyleTag({ content: ".comment-pin button { pointer-events: none !important; }" });
  await blow(address, STORM);
  for (const tool of [null, "Lasso", "Plant a seed", "Bend", "Width", "Branch", "Prune"] as const) {
    if (tool !== null) await tablet.take(tool);
    const { done } = await tablet.untilQuiet();
    await sways(tablet, ` before “${tool ?? "Draw"}”`);
    await tablet.inNoTime(async () => {
      const seen = await halted(tablet);
      await tablet.touch("touchStart", [seen]);
      await tablet.touch("touchMove", [{ x: seen.x + 12, y: seen.y }]);
      await tablet.touch("touchMove", [{ x: seen.x + 16, y: seen.y }]);
    });
    const still = async () => reach(await followed(tablet, 10)) === 0;
    await until(`it stands still under “${tool ?? "Draw"}”`, still);
    await tablet.touch("touchEnd", []);
    // Each tool finds the same tree: one that has become wide would hardly sway.
    const after = await tablet.untilQuiet();
    for (let deeds = after.done; deeds > done; deeds -= 1) await workshop.act(address, [{ kind: "undo" }]);
    await tablet.until("it is as it was", (facts) => facts.done === done);
  }
  await sways(tablet);
  await blow(address, CALM);
});

test("a comment is pinned where a finger comes down on a tree that sways, which stands still below what is drawn", async () => {
  const { tablet, address, metamers } = await workshop.stem(SCREEN);
  await pinned(tablet, metamers - 2);
  await press(tablet, "Comments");
  await tablet.press(tablet.page.getByRole("button", { name: "Comment on a place" }));
  await tablet.page.locator(".comment-glass[data-placing]").waitFor();
  await tablet.untilStill();
  const [rest] = await followed(tablet, 1);
  await blow(address, STORM);
  let seen = rest!;
  await until("a finger is on the stem, which leans", async () => {
    await tablet.inNoTime(async () => {
      seen = await halted(tablet);
      if (apart(seen, rest!) > 40) await tablet.touch("touchStart", [seen]);
    });
    return apart(seen, rest!) > 40;
  });
  await rests(tablet, rest!);
  expect(apart(seen, rest!), "far from where it was touched").toBeGreaterThan(24);
  await tablet.touch("touchEnd", []);
  await tablet.page.getByLabel("What you want to say").waitFor();
  await sways(tablet);
  await tablet.press(tablet.page.getByRole("button", { name: "Draw on the view" }));
  await rests(tablet, rest!);
  await tablet.press(tablet.page.getByRole("button", { name: "Done drawing" }));
  await sways(tablet);
  await blow(address, CALM);
});
