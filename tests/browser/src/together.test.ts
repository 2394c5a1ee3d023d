import { expect, test } from "vitest";
import { misses } from "./hits";
import { LANDSCAPE, PHONE, type Screen } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import { loop, type Point, way } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer();

/** Small glass: the camera of one page follows that of the other. */
const SEEN: Screen = { width: 900, height: 640, detail: 0.2 };
const WITH_MOUSE: Screen = { ...SEEN, mouse: true };
/** As near as two pages of the same size show the same place, in pixels. */
const NEAR = 4;

/** Two pages of one session; the second has a mouse. */
async function two(first: Screen = SEEN, second: Screen = WITH_MOUSE) {
  const { tablet, address } = await workshop.fresh(first);
  const other = await workshop.open(address, second);
  await together(tablet, other);
  return { tablet, other, address };
}

/** Each shows that somebody else is there. */
async function together(...tablets: readonly Tablet[]): Promise<void> {
  for (const tablet of tablets) {
    await until("others are shown", async () => (await tablet.page.locator(".people-chip").count()) === 1);
  }
}

/** Where a page shows the pointer of the other one; null where it shows none. */
async function pointerOn(tablet: Tablet): Promise<Point | null> {
  return tablet.page.evaluate(() => {
    const shown = document.querySelector('.companion[data-shown="true"] .companion-mark');
    const place = /^(-?[\d.]+)px (-?[\d.]+)px$/.exec(shown instanceof HTMLElement ? shown.style.translate : "");
    return place ? { x: Number(place[1]), y: Number(place[2]) } : null;
  });
}

async function untilPointer(tablet: Tablet, what: string, check: (place: Point) => boolean): Promise<Point> {
  let place: Point | null = null;
  const holds = async () => {
    place = await pointerOn(tablet);
    return place !== null && check(place);
  };
  await until(what, holds).catch((error) => {
    throw new Error(`${error}; it is at ${JSON.stringify(place)}`);
  });
  return place!;
}

function isAt({ x, y }: Point): (place: Point) => boolean {
  return (place) => Math.hypot(place.x - x, place.y - y) <= NEAR;
}

/** How far the tree is turned on a page, in degrees. */
async function turned(tablet: Tablet): Promise<number> {
  return Number(await tablet.page.getByRole("slider", { name: "Turn the tree" }).getAttribute("aria-valuenow"));
}

async function untilTurned(tablet: Tablet, degrees: number): Promise<void> {
  await until(`the tree is turned by ${degrees}°`, async () => Math.abs((await turned(tablet)) - degrees) <= 1);
}

/** Turns the tree by the keyboard. */
async function turn(tablet: Tablet, key: "PageUp" | "PageDown"): Promise<number> {
  const before = await turned(tablet);
  await tablet.page.getByRole("slider", { name: "Turn the tree" }).focus();
  await tablet.page.keyboard.press(key);
  await until("the tree turns", async () => Math.abs((await turned(tablet)) - before) > 5);
  // Until it has come where it goes.
  let last = Number.NaN;
  await until("it stops", async () => {
    const before = last;
    last = await turned(tablet);
    return last === before;
  });
  return last;
}

async function openPeople(tablet: Tablet): Promise<void> {
  await tablet.press(tablet.page.locator(".people-chip"));
  await tablet.page.locator(".people > li").first().waitFor();
}

/** Has a page follow the only other one. */
async function follow(tablet: Tablet): Promise<void> {
  await openPeople(tablet);
  await tablet.press(tablet.page.locator(".people").getByRole("button", { name: "Follow" }));
  await tablet.page.locator("[data-following]").waitFor();
}

test("PS1: a pointer is seen at its place in the tree, with its brush, and rides with a branch that is bent", async () => {
  const { tablet, address, at } = await workshop.stem(SEEN);
  const other = await workshop.open(address, WITH_MOUSE);
  await together(tablet, other);
  // What is seen at the same place of both is at the same place of the tree.
  await follow(other);
  // A mouse that rests points where it did, while a camera still comes to where it follows.
  await other.untilStill();
  const above = at(130, 200);
  await other.page.mouse.move(above.x, above.y);
  await untilPointer(tablet, "the pointer is where the mouse is", isAt(above));
  const edge = { x: SEEN.width - 8, y: above.y };
  await other.page.mouse.move(edge.x, edge.y);
  await untilPointer(tablet, "it is at the edge", isAt(edge));
  const { x, width } = await tablet.boxOf(tablet.page.locator('.companion[data-shown="true"] .companion-mark span'));
  expect(x + width, "its name is whole").toBeLessThanOrEqual(SEEN.width);
  // With a tool that has no ball it lies on the wood.
  await other.take("Bend");
  await tablet.take("Bend");
  const stem = at(0, 220);
  await other.page.mouse.move(stem.x, stem.y);
  const before = await untilPointer(tablet, "it is on the stem", isAt(stem));
  const [base, end]: [Point, Point] = [at(0, 100), stem];
  await tablet.touch("touchStart", [base]);
  await tablet.touch("touchStart", [base, end]);
  const { sent } = await tablet.facts();
  for (const to of way(end, { x: end.x + 70, y: end.y + 20 })) {
    await tablet.touch("touchMove", [base, to]);
    await tablet.page.waitForTimeout(16);
  }
  await tablet.until("it is sent", (facts) => facts.sent > sent + 2);
  const bent = await untilPointer(tablet, "it rides with the branch", ({ x }) => x > before.x + 25);
  await tablet.touch("touchEnd", []);
  await tablet.untilQuiet();
  const kept = await untilPointer(tablet, "it stays on the wood", ({ x }) => x > before.x + 25);
  expect(Math.hypot(kept.x - bent.x, kept.y - bent.y)).toBeLessThan(40);
});

test("PS1: an outline is seen on another page where it is, while it is drawn and no longer", async () => {
  const { tablet, address, at } = await workshop.stem(SEEN);
  const other = await workshop.open(address, WITH_MOUSE);
  await together(tablet, other);
  // Both see the same place at the same place of the glass.
  await follow(other);
  await other.untilStill();
  await tablet.take("Lasso");
  const [middle, radii] = [at(0, 230), { x: 90, y: 60 }];
  const outline = loop(middle, radii);
  /** The box around the line of somebody else that a page shows; null where it shows none. */
  const lineOn = ({ page }: Tablet) =>
    page.evaluate(() => {
      const line = document.querySelector('.companion[data-shown="true"] .companion-line');
      const places = [...(line?.getAttribute("d") ?? "").matchAll(/(-?[\d.]+) (-?[\d.]+)/g)];
      const [xs, ys] = [places.map(([, x]) => Number(x)), places.map(([, , y]) => Number(y))];
      return places.length < 3
        ? null
        : { left: Math.min(...xs), right: Math.max(...xs), top: Math.min(...ys), bottom: Math.max(...ys) };
    });
  const wanted = {
    left: middle.x - radii.x,
    right: middle.x + radii.x,
    top: middle.y - radii.y,
    bottom: middle.y + radii.y,
  };
  await tablet.lead([outline]);
  let seen: typeof wanted | null = null;
  await until("all of it is seen there", async () => {
    seen = await lineOn(other);
    return (
      seen !== null &&
      (Object.keys(wanted) as (keyof typeof wanted)[]).every((side) => Math.abs(seen![side] - wanted[side]) <= NEAR)
    );
  }).catch((error) => {
    throw new Error(`${error}; it is ${JSON.stringify(seen)}, and not ${JSON.stringify(wanted)}`);
  });
  await other.showNow("78-outline-of-another");
  await tablet.touch("touchEnd", []);
  await until("it is seen no longer", async () => (await lineOn(other)) === null);
  expect((await tablet.facts()).tool).toBe("lasso");
});

test("PS4: following a camera ends with the first touch of one's own", async () => {
  const { tablet, other } = await two();
  const start = await turned(tablet);
  await openPeople(tablet);
  await tablet.press(tablet.page.locator(".people").getByRole("button", { name: "Follow" }));
  await tablet.page.locator("[data-following]").waitFor();
  const first = await turn(other, "PageUp");
  expect(Math.abs(first - start)).toBeGreaterThan(5);
  await untilTurned(tablet, first);
  // The other page says who follows it.
  await openPeople(other);
  await until("who is followed knows it", async () => {
    return (await other.page.locator(".people").textContent())?.includes("Follows") === true;
  });
  await other.page.keyboard.press("Escape");
  await tablet.tapAt({ x: 450, y: 330 });
  await until("it ends", async () => (await tablet.page.locator("[data-following]").count()) === 0);
  const second = await turn(other, "PageUp");
  expect(Math.abs(second - first)).toBeGreaterThan(5);
  await untilTurned(tablet, first);
});

test("PS5: everyone is brought to a view and may go back, but for a hand that draws", async () => {
  const { tablet, other } = await two();
  const start = await turned(tablet);
  const view = await turn(other, "PageDown");
  const gather = async () => {
    await openPeople(other);
    await other.press(other.page.getByRole("button", { name: "Bring everyone here" }));
    await other.page.locator(".people").waitFor({ state: "detached" });
  };
  await gather();
  await untilTurned(tablet, view);
  await tablet.press(tablet.page.getByRole("button", { name: "Back", exact: true }));
  await untilTurned(tablet, start);
  // Within ten seconds nobody is brought anywhere, and whoever asks is told.
  await gather();
  await until(
    "it is refused",
    async () => (await other.page.locator(".toasts").textContent())?.includes("just now") === true,
  );
  await until("the ten seconds are over", async () => {
    await tablet.page.waitForTimeout(10_000);
    return true;
  });
  await tablet.touch("touchStart", [{ x: 450, y: 300 }]);
  for (const to of way({ x: 450, y: 300 }, { x: 480, y: 260 })) await tablet.touch("touchMove", [to]);
  await gather();
  await other.page.waitForTimeout(1500);
  await untilTurned(tablet, start);
  await tablet.touch("touchEnd", []);
});

test("PS3: who closes the page is there no longer, and who looks elsewhere is away", async () => {
  const { tablet, other, address } = await two();
  await openPeople(tablet);
  const states = () => tablet.page.locator(".person-device").evaluateAll((all) => all.map((one) => one.dataset.state));
  expect(await states()).toEqual(["here", "here"]);
  await other.page.evaluate(() => {
    Object.defineProperty(document, "hidden", { get: () => true });
    document.dispatchEvent(new Event("visibilitychange"));
  });
  await until("the other one is away", async () => (await states()).join() === "here,away");
  await other.page.close();
  await until("it is gone", async () => (await states()).length === 1);
  await tablet.page.keyboard.press("Escape");
  await until("nobody is shown", async () => (await tablet.page.locator(".people-chip").count()) === 0);
  const back = await workshop.open(address, WITH_MOUSE);
  await together(tablet, back);
});

test.each([
  ["tablet", LANDSCAPE],
  ["phone", PHONE],
  ["phone on its side", { width: 740, height: 360, detail: 0.6 }],
] as const)("others are seen on a %s in both themes, and all that is theirs can be pressed", async (name, screen) => {
  const { tablet, other } = await two(screen, { ...LANDSCAPE, mouse: true });
  await tablet.page.evaluate(() => localStorage.setItem("espalier.author", '"Ann"'));
  await other.page.mouse.move(640, 480);
  await untilPointer(tablet, "the pointer comes", () => true);
  for (const lever of ["Brush radius", "Grow"]) {
    await tablet.page.getByRole("slider", { name: lever, exact: true }).waitFor();
  }
  const faults: string[] = [];
  for (const theme of ["light", "dark"] as const) {
    await tablet.page.emulateMedia({ colorScheme: theme });
    await other.page.mouse.move(640 + Math.random() * 8, 470);
    await tablet.showNow(`75-together-${name}-${theme}`);
    faults.push(...(await misses(tablet, `${name}, ${theme}`, ".chips")));
    faults.push(...(await misses(tablet, `${name}, ${theme}`, ".side-bar")));
    await openPeople(tablet);
    await tablet.showNow(`76-people-${name}-${theme}`);
    faults.push(...(await misses(tablet, `${name}, ${theme}, people`, "dialog")));
    await tablet.page.keyboard.press("Escape");
    await tablet.page.getByRole("dialog").waitFor({ state: "detached" });
  }
  const more = tablet.page.getByRole("button", { name: "More", exact: true });
  if ((await more.count()) > 0) {
    await tablet.press(more);
    await tablet.showNow(`77-menu-${name}`);
    faults.push(...(await misses(tablet, `${name}, menu`, ".menu")));
  }
  expect(faults).toEqual([]);
});
