import type { CDPSession, Page } from "playwright-core";
import { atMost } from "./at-most";
import type { Point } from "./ways";

/**
 * So long the browser may take to answer a touch, in milliseconds. It now and then leaves one unanswered that another
 * follows at once; what has come of it, the page tells.
 */
const TOUCHED = 10_000;
/** A finger that has gone so far, in pixels, is no longer where it came down. */
const LEAVES = 12;

/** The glass of a tablet: real fingers and pens on it. */
export class Glass {
  readonly page: Page;
  readonly #touch: CDPSession;
  /** Whether fingers touch it; else a mouse stands in for the only one. */
  readonly touches: boolean;

  protected constructor(page: Page, touch: CDPSession, touches: boolean) {
    this.page = page;
    this.#touch = touch;
    this.touches = touches;
  }

  /** Moves as many fingers as there are paths, from each path's begin to its end; all touch down and lift together. */
  async swipe(paths: readonly (readonly Point[])[], pause = 16): Promise<void> {
    await this.lead(paths, pause);
    await this.page.waitForTimeout(pause);
    await this.touch("touchEnd", []);
  }

  /** The same, but they stay down. */
  async lead(paths: readonly (readonly Point[])[], pause = 16): Promise<void> {
    const steps = Math.max(...paths.map((path) => path.length));
    const fingers = (step: number) => paths.map((path) => path[Math.min(step, path.length - 1)]!);
    const away = Array.from({ length: steps }, (_, step) => step).find((step) =>
      fingers(step).some(({ x, y }, i) => Math.hypot(x - paths[i]![0]!.x, y - paths[i]![0]!.y) > LEAVES),
    );
    const leaving = away ?? steps - 1;
    // A finger that the machine keeps waiting where it came down would not draw but hold what is there.
    await this.inNoTime(async () => {
      await this.touch("touchStart", fingers(0));
      for (let step = 1; step <= leaving; step++) await this.touch("touchMove", fingers(step));
    });
    for (let step = leaving + 1; step < steps; step++) {
      await this.page.waitForTimeout(pause);
      await this.touch("touchMove", fingers(step));
    }
  }

  /** One finger that taps on a place, however long the page takes to answer. */
  async tapAt(place: Point): Promise<void> {
    await this.inNoTime(() => this.#tapped(place));
  }

  /** One finger that taps on a place twice. */
  async doubleTap({ x, y }: Point): Promise<void> {
    await this.inNoTime(async () => {
      await this.#tapped({ x, y });
      await this.#tapped({ x: x + 3, y: y - 2 });
    });
  }

  /** Does something while the page's clock stands, which tells taps from holds: no machine is too slow for a tap then. */
  async inNoTime(act: () => Promise<void>): Promise<void> {
    await this.page.evaluate(() => {
      const now = performance.now();
      performance.now = () => now;
    });
    try {
      await act();
    } finally {
      await this.page.evaluate(() => Reflect.deleteProperty(performance, "now"));
    }
  }

  /** One real touch event with all fingers that are down, or what the mouse does in their place. */
  async touch(type: "touchStart" | "touchMove" | "touchEnd", fingers: readonly Point[]): Promise<void> {
    if (!this.touches) {
      const { mouse } = this.page;
      for (const { x, y } of fingers.slice(0, 1)) await mouse.move(x, y);
      if (type !== "touchMove") await (type === "touchStart" ? mouse.down() : mouse.up());
      return;
    }
    const touchPoints = fingers.map(({ x, y }, id) => ({ x, y, id, radiusX: 8, radiusY: 8, force: 0.5 }));
    const answer = this.#touch.send("Input.dispatchTouchEvent", { type, touchPoints });
    await atMost(TOUCHED, answer);
  }

  /** One event of a pen on the glass. */
  async pen(type: "mousePressed" | "mouseMoved" | "mouseReleased", { x, y }: Point): Promise<void> {
    const down = type === "mouseReleased" ? 0 : 1;
    await this.#touch.send("Input.dispatchMouseEvent", {
      type,
      x,
      y,
      button: "left",
      buttons: down,
      clickCount: 1,
      force: 0.5 * down,
      pointerType: "pen",
    });
  }

  /** A pen drawn along a way. */
  async draw(path: readonly Point[], pause = 16): Promise<void> {
    for (const [i, point] of path.entries()) {
      await this.pen(i === 0 ? "mousePressed" : "mouseMoved", point);
      await this.page.waitForTimeout(pause);
    }
    await this.pen("mouseReleased", path[path.length - 1]!);
  }

  async #tapped(place: Point): Promise<void> {
    await this.touch("touchStart", [place]);
    await this.touch("touchEnd", []);
  }
}
