import { perform } from "../gallery/performance";
import { launchBrowser } from "../src/browser";
import type { Facts } from "../src/facts";
import { Darkroom } from "../src/picture";
import { SMALL } from "../src/screens";
import { Server } from "../src/server";
import { Tablet } from "../src/tablet";
import { middle, way } from "../src/ways";

/** Steps that the tree has grown before: it has some 240 metamers then. */
const GROWN = 5;
/** So long the lever is held at its end, in milliseconds. */
const HELD = 5000;
/** How often, each time with a tree of its own. */
const ROUNDS = 5;

/** Holds the Grow lever at its end, lets go of it, and prints what has grown by then and once the tree is at rest. */
export async function measureLever(): Promise<void> {
  const server = new Server();
  const browser = await launchBrowser({ asOnTablets: true });
  try {
    await server.start();
    const darkroom = await Darkroom.open(browser);
    const blank = await browser.newPage();
    await blank.goto(`${server.address}/health`);
    console.log("| seed | metamers before | at release | at rest | steps held | steps after release |");
    console.log("|---|---|---|---|---|---|");
    for (let seed = 1; seed <= ROUNDS; seed += 1) {
      const address = await server.newSession(seed);
      await perform(blank, address.slice(address.lastIndexOf("/") + 1), [`{"kind":"grow","steps":${GROWN}}`]);
      const tablet = await Tablet.open(browser, darkroom, address, SMALL);
      const before = await tablet.untilQuiet();
      const { released, rested } = await held(tablet);
      const figures = [
        seed,
        before.metamers,
        released.metamers,
        rested.metamers,
        released.step - before.step,
        rested.step - released.step,
      ];
      console.log(`| ${figures.join(" | ")} |`);
      await tablet.close();
    }
  } finally {
    await browser.close();
    await server.stop();
  }
}

/** How large a tree is. */
type Size = Pick<Facts, "metamers" | "step">;

/** What the page says of the tree as the finger lifts, and once nothing grows any more. */
async function held(tablet: Tablet): Promise<{ released: Size; rested: Size }> {
  const lever = await tablet.boxOf(tablet.page.getByLabel("Grow", { exact: true }));
  // The page notes it itself: until somebody who asked has the answer, and the finger is up, a busy page has grown further.
  const noted = await tablet.page.evaluateHandle(() => ({
    size: new Promise<Size>((resolve) => {
      const note = () => {
        const { metamers, step } = document.documentElement.dataset;
        resolve({ metamers: Number(metamers), step: Number(step) });
      };
      addEventListener("pointerup", note, { capture: true, once: true });
    }),
  }));
  await tablet.lead([way(middle(lever), { x: middle(lever).x, y: lever.y + 4 }, 4)]);
  await tablet.page.waitForTimeout(HELD);
  await tablet.touch("touchEnd", []);
  const rested = await tablet.untilQuiet();
  return { released: await noted.evaluate(({ size }) => size), rested };
}
