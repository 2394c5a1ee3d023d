import type { Locator } from "playwright-core";
import { expect, test } from "vitest";
import { axisOf } from "./design-axis";
import { LANDSCAPE, type Screen } from "./screens";
import type { Tablet } from "./tablet";
import type { Point } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();
const UPRIGHT: Screen = { ...LANDSCAPE, width: 834, height: 1194 };
/** A style is reached from the plain tree by so many gestures at most. */
const MOST_GESTURES = 60;
/** So many gestures one after the other take a slow machine this long, in milliseconds. */
const PATIENCE = 600_000;

/** Somebody with one finger, whose gestures are counted. */
class Hand {
  gestures = 0;

  constructor(
    readonly tablet: Tablet,
    readonly name: string,
  ) {}

  async tap(control: Locator): Promise<void> {
    await this.#reach(control);
    await this.tablet.press(control);
    this.gestures += 1;
  }

  /** Drags a slider until it says this number, watching it as a person does. */
  async slide(label: string, wanted: number): Promise<void> {
    const slider = this.tablet.page.getByRole("slider", { name: label, exact: true });
    await this.#reach(slider);
    const box = await this.tablet.boxOf(slider);
    const at = (x: number): Point => ({ x, y: box.y + box.height / 2 });
    const place = Number.parseFloat(
      await slider.evaluate((input) => (input as HTMLElement).style.getPropertyValue("--place")),
    );
    const said = async () => {
      await this.tablet.frames();
      return Number.parseFloat(((await slider.getAttribute("aria-valuetext")) ?? "").replace("−", "-"));
    };
    await this.tablet.touch("touchStart", [at(box.x + 12 + place * (box.width - 24))]);
    let [left, right] = [box.x, box.x + box.width];
    for (let step = 0; step < 14; step += 1) {
      const middle = (left + right) / 2;
      await this.tablet.touch("touchMove", [at(middle)]);
      const value = await said();
      if (value === wanted) break;
      if (value < wanted) left = middle;
      else right = middle;
    }
    await this.tablet.touch("touchEnd", []);
    this.gestures += 1;
    await this.tablet.untilQuiet();
  }

  /** Drags a point of a function to a value. */
  async point(label: RegExp, index: number, value: number): Promise<void> {
    const drawing = this.tablet.page.getByRole("group", { name: label });
    await this.#reach(drawing);
    const frame = await this.tablet.boxOf(drawing.locator("rect"));
    // The axis has its unit beside each number.
    const numbers = await drawing.locator("text:not(.structure-said)").allTextContents();
    const marks = numbers.map((text) => Number.parseFloat(text.replace("−", "-")));
    const [top, bottom] = [Math.max(...marks), Math.min(...marks)];
    const circle = drawing.locator("circle").nth(index < 0 ? (await drawing.locator("circle").count()) - 1 : index);
    const from = await this.tablet.boxOf(circle);
    const begin = { x: from.x + from.width / 2, y: from.y + from.height / 2 };
    const end = { x: begin.x, y: frame.y + ((top - value) / (top - bottom)) * frame.height };
    await this.drag([begin, end]);
  }

  /** Drags one of the ends of the outline in its drawing, in units of the branch. */
  async widen(across: number): Promise<void> {
    const drawing = this.tablet.page.getByRole("application", { name: "Outline: drag its ends" });
    await this.#reach(drawing);
    const box = await this.tablet.boxOf(drawing);
    const grip = await this.tablet.boxOf(drawing.locator("circle").nth(2));
    const begin = { x: grip.x + grip.width / 2, y: grip.y + grip.height / 2 };
    await this.drag([begin, { x: box.x + (0.5 + across * (90 / 240)) * box.width, y: begin.y }]);
  }

  /** One finger along a way. */
  async drag(corners: readonly Point[]): Promise<void> {
    const path = corners.slice(1).flatMap((to, at) => {
      const from = corners[at] ?? to;
      return Array.from({ length: 8 }, (_, step) => ({
        x: from.x + ((to.x - from.x) * (step + 1)) / 8,
        y: from.y + ((to.y - from.y) * (step + 1)) / 8,
      }));
    });
    await this.tablet.swipe([[corners[0] ?? { x: 0, y: 0 }, ...path]]);
    this.gestures += 1;
    await this.tablet.untilQuiet();
  }

  async show(what: string): Promise<void> {
    await this.tablet.show(`99-chokkan-${this.name.replaceAll(" ", "-")}-${what}`);
  }

  /** What is out of sight is scrolled to, which is a gesture as well. */
  async #reach(control: Locator): Promise<void> {
    await control.waitFor();
    const isSeen = await control.evaluate((element) => {
      const { left, top, right, bottom } = element.getBoundingClientRect();
      const found = document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
      return (
        found !== null && (element.contains(found) || found.contains(element)) && top >= 0 && bottom <= innerHeight
      );
    });
    if (!isSeen) {
      await control.evaluate((element) => element.scrollIntoView({ block: "center" }));
      this.gestures += 1;
    }
    await this.tablet.untilSettled();
  }
}

test.each<[string, Screen]>([
  ["on its side", LANDSCAPE],
  ["upright", UPRIGHT],
])(
  "one finger makes a formal upright bonsai from a plain tree on a tablet %s",
  async (name, screen) => {
    const { tablet } = await workshop.fresh(screen);
    const hand = new Hand(tablet, name);
    const { page } = tablet;
    const button = (text: string | RegExp) => page.getByRole("button", { name: text, exact: true });
    await tablet.tap("Structure");
    hand.gestures += 1;
    await hand.tap(page.getByRole("button", { name: /^Plain/ }));
    await tablet.until("the plain tree stands", ({ metamers }) => metamers > 50);
    await tablet.untilQuiet();
    await hand.show("1-plain");

    // A cone, drawn around the stem.
    await hand.tap(button("Draw"));
    await tablet.untilStill();
    const stem = await axisOf(tablet);
    const [base, tip] = [stem[0] as Point, stem.at(-1) as Point];
    const at = (across: number, up: number): Point => ({
      x: base.x + across * (base.y - tip.y),
      y: base.y + up * (tip.y - base.y),
    });
    await hand.drag([
      at(0.46, 0.27),
      at(0, 1.02),
      at(-0.46, 0.27),
      at(-0.3, 0.19),
      at(0, 0.16),
      at(0.3, 0.19),
      at(0.46, 0.27),
    ]);
    await hand.show("2-cone");

    // The stem and how its limbs stand on it.
    await hand.slide("Thickness of the stem", 2.4);
    await hand.point(/^Density/, 0, 14);
    await hand.point(/^Density/, -1, 30);
    await hand.slide("Zone, from", 0.22);
    await hand.point(/^Branching angle/, 0, 97);
    await hand.point(/^Branching angle/, -1, 55);
    await hand.point(/^Taper/, -1, 0.08);
    await hand.show("3-limbs");

    // All limbs alike: flat pads.
    await hand.tap(button("A branch that it bears"));
    await hand.tap(page.locator(".structure-bar-scope"));
    await hand.widen(0.14);
    await hand.tap(page.locator(".structure-outline").getByRole("button", { name: "Side", exact: true }));
    await hand.widen(0.42);
    await hand.slide("Pull, up", -0.1);
    await hand.point(/^Density/, 0, 15);
    await hand.point(/^Density/, -1, 15);
    await hand.slide("Zone, from", 0.22);
    await hand.slide("Turn from place to place", 176);
    await hand.point(/^Branching angle/, 0, 62);
    await hand.point(/^Branching angle/, -1, 40);
    await hand.slide("Thickness", 0.42);
    await hand.show("4-pads");

    // And all of their branches.
    await hand.tap(button("A branch that it bears"));
    await hand.slide("Pull, up", 0.2);
    await hand.point(/^Density/, 0, 8);
    await hand.point(/^Density/, -1, 8);
    await hand.slide("Turn from place to place", 137);
    await hand.slide("Longest internode", 0.6);
    await hand.show("5-branches");
    await hand.tap(button("Done"));
    await hand.show("6-chokkan");

    const { metamers } = await tablet.untilQuiet();
    expect(metamers).toBeGreaterThan(800);
    expect(hand.gestures).toBeLessThanOrEqual(MOST_GESTURES);
  },
  PATIENCE,
);
