import { expect, test } from "vitest";
import { SMALL } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import type { Point } from "./ways";
import { way } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();
const SCREEN = { ...SMALL, watched: true };
const STORM = { speed: 14, direction: 0, turbulence: 1, suppleness: 1.5 };

/** Where one of the marks of a kind is on the glass, once for each of the page's next frames. */
async function followed(tablet: Tablet, kind: string, frames: number, which = 0): Promise<readonly Point[]> {
  return tablet.page.evaluate(
    ([kind, frames, which]) =>
      new Promise<Point[]>((resolve) => {
        const seen: Point[] = [];
        const look = () => {
          const at = document.querySelectorAll(`.bend-${kind}`)[which]?.getAttribute("transform");
          const [, x, y] = /translate\((\S+) (\S+)\)/.exec(at ?? "") ?? [];
          if (x !== undefined && y !== undefined) seen.push({ x: Number(x), y: Number(y) });
          if (seen.length < frames) requestAnimationFrame(look);
          else resolve(seen);
        };
        look();
      }),
    [kind, frames, which] as const,
  );
}

const reach = (seen: readonly Point[]) =>
  Math.max(...seen.map(({ x, y }) => Math.hypot(x - seen[0]!.x, y - seen[0]!.y)));

/** Has the base of a bend marked near the top of a stem: the mark goes with it. */
async function mark(tablet: Tablet, place: Point) {
  await tablet.take("Bend");
  await tablet.tapAt(place);
  await tablet.page.locator(".bend-base").waitFor();
}

const sways = (tablet: Tablet) => until("the stem sways", async () => reach(await followed(tablet, "base", 10)) > 1);

test("what a finger is on comes to rest where it grew, while others see it sway, and sways again once it has gone", async () => {
  const { tablet, address, at, metamers } = await workshop.stem(SCREEN);
  const other = await workshop.open(address, SCREEN);
  for (const each of [tablet, other]) await mark(each, at(0, 250));
  await tablet.untilStill();
  const [rest] = await followed(tablet, "base", 1);
  await workshop.act(address, [{ kind: "set_appearance", appearance: { wind: STORM } }]);
  for (const each of [tablet, other]) await sways(each);

  // While the page's clock stands, for a frame later the stem is elsewhere.
  await tablet.inNoTime(async () => {
    const seen = await followed(tablet, "base", 4);
    await tablet.touch("touchStart", [seen.at(-1)!]);
  });
  await until("it rests under the finger", async () => reach(await followed(tablet, "base", 10)) === 0);
  const atRest = async () => {
    const [held] = await followed(tablet, "base", 1);
    return Math.hypot(held!.x - rest!.x, held!.y - rest!.y);
  };
  expect(await atRest(), "it is where it grew").toBeLessThan(0.5);
  await sways(other);
  await workshop.act(address, [{ kind: "grow", steps: 2 }]);
  await tablet.until("growth goes on meanwhile", (facts) => facts.metamers > metamers);
  expect(await atRest(), "under the finger as before").toBeLessThan(0.5);
  await tablet.touch("touchEnd", []);
  await sways(other);
  expect(tablet.errors).toEqual([]);
});

/** Marks the base of a bend near the ground and a place near the top, between which the way is drawn; a storm comes. */
async function traced(places: readonly number[]) {
  const { tablet, address, at } = await workshop.stem(SCREEN);
  await mark(tablet, at(0, 30));
  for (const up of places) await tablet.tapAt(at(0, up));
  await tablet.untilStill();
  await workshop.act(address, [{ kind: "set_appearance", appearance: { wind: STORM } }]);
  await until("the stem sways", async () => reach(await followed(tablet, "pin", 10)) > 1);
  return { tablet, pins: () => tablet.page.locator(".bend-pin").count() };
}

/** Where rows are seen from the base of a bend to its top. */
const wayUp = (tablet: Tablet): Promise<readonly Point[]> =>
  tablet.page.locator(".bend-trace").evaluate((trace) =>
    (trace.getAttribute("d") ?? "")
      .slice(1)
      .split("L")
      .map((each) => each.split(" ").map(Number))
      .map(([x, y]) => ({ x: x!, y: y! })),
  );

test("what was bent swings out from where it was let go", async () => {
  const { tablet } = await traced([320, 200]);
  await tablet.inNoTime(async () => {
    const from = (await wayUp(tablet)).at(-3)!;
    await tablet.lead([way(from, { x: from.x + 60, y: from.y + 10 })]);
  });
  // While it bends, a place that stays put is held, after the one under the finger.
  await until("it is held", async () => reach(await followed(tablet, "grip", 10, 1)) === 0);
  const [held] = await followed(tablet, "grip", 1, 1);
  const seen = followed(tablet, "pin", 150);
  await tablet.touch("touchEnd", []);
  const swung = await seen;
  expect(Math.hypot(swung[0]!.x - held!.x, swung[0]!.y - held!.y), "it starts where it is").toBeLessThan(1);
  expect(reach(swung), "and swings").toBeGreaterThan(3);
});

test("a twig that moves in the wind is met where it is seen, twenty times of twenty", async () => {
  const { tablet, pins } = await traced([320]);
  for (let time = 0; time < 20; time += 1) {
    await tablet.inNoTime(async () => {
      const seen = (await wayUp(tablet)).at(-4)!;
      await tablet.touch("touchStart", [seen]);
      await tablet.touch("touchEnd", []);
    });
    // What meets nothing lets go of all, and what meets another place adds one more.
    await expect.poll(pins, { message: `time ${time}` }).toBe(time % 2 === 0 ? 2 : 1);
    await until("the stem sways", async () => reach(await followed(tablet, "pin", 10)) > 1);
  }
});
