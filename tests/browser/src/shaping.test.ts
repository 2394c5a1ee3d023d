import { expect, test } from "vitest";
import { extentOf } from "./extent";
import { type Box, becameTree, changed } from "./picture";
import { LANDSCAPE, WATCHED } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import { type Point, way } from "./ways";
import { SEED, Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer();

/** A place on the stem that the sketch has drawn. */
const onStem = (y: number): Point => ({ x: SEED.x, y });
/** Right of the stem, where its top goes when it is bent. */
const aside: Box = { x: 640, y: 430, width: 150, height: 100 };

/** Fingers that come down one after the other, as people's do. */
async function fingers(tablet: Tablet, ...places: Point[]): Promise<void> {
  for (let i = 1; i <= places.length; i++) {
    await tablet.touch("touchStart", places.slice(0, i));
    await tablet.page.waitForTimeout(30);
  }
}

/** Moves each finger from its first to its last place; they stay down. */
async function drag(tablet: Tablet, paths: readonly (readonly Point[])[]): Promise<void> {
  for (let i = 1; i < paths[0]!.length; i++) {
    await tablet.touch(
      "touchMove",
      paths.map((path) => path[i]!),
    );
    await tablet.page.waitForTimeout(16);
  }
}

/** A stem with a limb to either side. */
async function limbed() {
  const grown = await workshop.stem(LANDSCAPE);
  for (const [from, to] of [
    [onStem(620), { x: 800, y: 520 }],
    [onStem(540), { x: 420, y: 450 }],
  ] as const) {
    await grown.tablet.swipe([way(from, to)]);
    await grown.tablet.untilQuiet();
  }
  return { ...grown, ...(await grown.tablet.facts()) };
}

test("three fingers bend a branch between its base and its end", async () => {
  const { tablet, address, metamers } = await workshop.stem(WATCHED);
  const straight = await extentOf(address);
  await tablet.take("Bend");
  const before = await tablet.photograph("30-straight");
  const [base, middle, end] = [onStem(600), onStem(520), onStem(440)] as const;
  await fingers(tablet, base, end, middle);
  const { sent } = await tablet.facts();
  await drag(tablet, [way(base, base), way(end, { x: 740, y: 490 }), way(middle, { x: 630, y: 510 })]);
  await tablet.until("it is sent", (facts) => facts.sent > sent + 2);
  await until("the branch follows the fingers", async () => {
    return becameTree(before, await tablet.glimpse("31-bent"), aside) > 0.02;
  });
  expect(await extentOf(address), "nothing is committed while they hold it").toEqual(straight);
  await tablet.touch("touchEnd", []);
  const facts = await tablet.untilQuiet();
  expect(facts.metamers, "bending grows nothing").toBe(metamers);
  const after = await tablet.photograph("32-let-go");
  expect(becameTree(before, after, aside), "it stays where it was left").toBeGreaterThan(0.02);
  const bent = await extentOf(address);
  expect(bent.max[0] - straight.max[0], "its top went to the right").toBeGreaterThan(0.5);
  await tablet.tap("Undo");
  await tablet.untilQuiet();
  expect(await extentOf(address), "to the bit").toEqual(straight);
  await tablet.tap("Redo");
  await tablet.untilQuiet();
  expect(await extentOf(address)).toEqual(bent);
});

test("a mouse bends a branch it has marked the base of, and Escape puts it back", async () => {
  const { tablet, address } = await workshop.stem(LANDSCAPE);
  const { mouse, keyboard } = tablet.page;
  const straight = await extentOf(address);
  await tablet.page.keyboard.press("n");
  await tablet.until("its tool is at hand", ({ tool }) => tool === "bend");
  await mouse.click(SEED.x, 600);
  await tablet.page.locator(".bend-base").waitFor();
  await mouse.click(SEED.x, 530);
  await tablet.page.locator(".bend-pin").waitFor();
  const pull = async () => {
    await mouse.move(SEED.x, 440);
    await mouse.down();
    for (const { x, y } of way(onStem(440), { x: 760, y: 480 })) {
      await mouse.move(x, y);
      await tablet.page.waitForTimeout(16);
    }
  };
  await pull();
  await tablet.showNow("33-mouse-bends");
  await keyboard.press("Escape");
  await mouse.up();
  await tablet.untilQuiet();
  expect(await extentOf(address), "it is as it was").toEqual(straight);
  await pull();
  await mouse.up();
  await tablet.untilQuiet();
  expect((await extentOf(address)).max[0] - straight.max[0]).toBeGreaterThan(0.4);
  await keyboard.press("Escape");
  // And then it lets go of the base.
  await tablet.page.locator(".bend-base").waitFor({ state: "detached" });
});

test("another tablet sees a branch bend while fingers hold it", async () => {
  const { tablet, address } = await workshop.stem(LANDSCAPE);
  const second = await workshop.open(address, LANDSCAPE);
  const before = await second.photograph("34-second-before");
  await tablet.take("Bend");
  await fingers(tablet, onStem(600), onStem(440));
  await drag(tablet, [way(onStem(600), onStem(600)), way(onStem(440), { x: 740, y: 490 })]);
  await tablet.untilQuiet();
  let during = before;
  await until("it bends there too", async () => {
    during = await second.photograph("35-second-during");
    return becameTree(before, during, aside) > 0.02;
  });
  await tablet.touch("touchEnd", []);
  await tablet.untilQuiet();
  const after = await second.photograph("36-second-after");
  expect(changed(during, after), "where it is let go it stays").toBeLessThan(0.03);
});

test("two fingers pinch a limb thicker, and its ring says how thick", async () => {
  const { tablet, address } = await limbed();
  const slim = await extentOf(address);
  await tablet.take("Width");
  const before = await tablet.photograph("40-slim");
  const at = onStem(580);
  await fingers(tablet, { x: at.x - 20, y: at.y }, { x: at.x + 20, y: at.y });
  await drag(tablet, [
    way({ x: at.x - 20, y: at.y }, { x: at.x - 160, y: at.y }),
    way({ x: at.x + 20, y: at.y }, { x: at.x + 160, y: at.y }),
  ]);
  const trunk: Box = { x: SEED.x - 24, y: 560, width: 48, height: 50 };
  await until("thicker under the fingers", async () => {
    return becameTree(before, await tablet.glimpse("41-pinched"), trunk) > 0.1;
  });
  await tablet.touch("touchEnd", []);
  await tablet.untilQuiet();
  const ring = tablet.page.getByLabel("Diameter in internodes");
  const wide = Number(await ring.inputValue());
  expect(wide).toBeGreaterThan(0.3);
  const after = await tablet.photograph("42-thick");
  expect(becameTree(before, after, trunk), "and so it stays").toBeGreaterThan(0.1);
  expect(await extentOf(address)).not.toEqual(slim);

  const second = await workshop.open(address);
  await second.take("Width");
  const theirs = second.page.locator(".width-label");
  await expect.poll(() => theirs.textContent(), { message: "others see its ring" }).toContain(wide.toFixed(2));
  await tablet.tap("Remove this width");
  await tablet.untilQuiet();
  expect(await extentOf(address)).toEqual(slim);
  await theirs.waitFor({ state: "detached" });
});

test("a mouse pulls the ring around a limb, and a width can be typed", async () => {
  const { tablet } = await limbed();
  const { mouse, keyboard } = tablet.page;
  await keyboard.press("w");
  await mouse.click(SEED.x, 580);
  const ring = tablet.page.getByLabel("Diameter in internodes");
  await ring.waitFor();
  const slim = Number(await ring.inputValue());
  const knob = await tablet.boxOf(tablet.page.locator(".width-knob.right"));
  const grip = { x: knob.x + knob.width / 2, y: knob.y + knob.height / 2 };
  await mouse.move(grip.x, grip.y);
  await mouse.down();
  for (const { x, y } of way(grip, { x: grip.x + 30, y: grip.y }, 10)) await mouse.move(x, y);
  await mouse.up();
  await tablet.untilQuiet();
  const width = async () => Number(await ring.inputValue());
  await expect.poll(width).toBeGreaterThan(slim + 0.2);
  await tablet.show("43-ring");
  await ring.fill("0,9");
  await keyboard.press("Enter");
  await tablet.untilQuiet();
  await expect.poll(() => ring.inputValue()).toBe("0.90");
  await tablet.tap("Undo");
  await tablet.untilQuiet();
  await expect.poll(width).not.toBe(0.9);
});

test("a double tap cuts a branch off, and draws nothing", async () => {
  const { tablet, metamers, sent } = await limbed();
  const before = await tablet.photograph("44-limbed");
  await tablet.doubleTap({ x: 950, y: 250 });
  await tablet.doubleTap({ x: 745, y: 542 });
  await tablet.until("the limb is gone", (facts) => facts.metamers < metamers - 3);
  const cut = await tablet.untilQuiet();
  expect(cut.sent, "one command, and no stroke, neither here nor there").toBe(sent + 1);
  const after = await tablet.photograph("45-cut");
  const where: Box = { x: 690, y: 500, width: 110, height: 70 };
  expect(changed(before, after, where)).toBeGreaterThan(0.02);
  await tablet.tap("Undo");
  await tablet.until("it is back", (facts) => facts.metamers === metamers);
});

test("a double click cuts a branch off as well", async () => {
  const { tablet, metamers, sent } = await limbed();
  await tablet.inNoTime(() => tablet.page.mouse.dblclick(745, 542));
  await tablet.until("the limb is gone", (facts) => facts.metamers < metamers - 3);
  const cut = await tablet.untilQuiet();
  expect(cut.sent, "one command, and no stroke").toBe(sent + 1);
});

test("a pen bends, widens and prunes", async () => {
  const { tablet, address, metamers } = await limbed();
  const straight = await extentOf(address);
  await tablet.take("Bend");
  await tablet.draw([onStem(600)]);
  await tablet.page.locator(".bend-base").waitFor();
  await tablet.draw(way(onStem(440), { x: 740, y: 480 }));
  expect((await tablet.untilQuiet()).operations).toMatch(/ bend$/);
  expect(await extentOf(address), "the tree stands otherwise").not.toEqual(straight);
  await tablet.tap("Undo");
  await tablet.untilQuiet();
  expect(await extentOf(address), "one bend, one undo").toEqual(straight);

  await tablet.take("Width");
  await tablet.draw([onStem(580)]);
  const ring = tablet.page.getByLabel("Diameter in internodes");
  const slim = Number(await ring.inputValue());
  const knob = await tablet.boxOf(tablet.page.locator(".width-knob.right"));
  const grip = { x: knob.x + knob.width / 2, y: knob.y + knob.height / 2 };
  await tablet.draw(way(grip, { x: grip.x + 30, y: grip.y }, 10));
  await tablet.untilQuiet();
  await expect.poll(async () => Number(await ring.inputValue())).toBeGreaterThan(slim + 0.2);

  await tablet.take("Prune");
  await tablet.draw(way({ x: 700, y: 440 }, { x: 760, y: 620 }));
  await tablet.until("the limb is gone", (facts) => facts.metamers < metamers - 2);
});

test("a width shows under the fingers before the server answers, and Escape takes it back", async () => {
  const { tablet, address } = await limbed();
  const slim = await extentOf(address);
  await tablet.page.keyboard.press("w");
  const { mouse, keyboard } = tablet.page;
  await mouse.click(SEED.x, 580);
  const knob = await tablet.boxOf(tablet.page.locator(".width-knob.right"));
  const grip = { x: knob.x + knob.width / 2, y: knob.y + knob.height / 2 };
  const before = await tablet.photograph("43-before-the-ring");
  const trunk: Box = { x: SEED.x - 30, y: 556, width: 60, height: 16 };
  const pull = async () => {
    await mouse.move(grip.x, grip.y);
    await mouse.down();
    for (const { x, y } of way(grip, { x: grip.x + 60, y: grip.y }, 10)) await mouse.move(x, y);
  };
  workshop.server.pause();
  await pull();
  await until("it is thick at once", async () => {
    return changed(before, await tablet.glimpse("43-thick-at-once"), trunk) > 0.1;
  });
  workshop.server.resume();
  await tablet.until("it is sent", (facts) => facts.sent === facts.acknowledged);
  await keyboard.press("Escape");
  await mouse.up();
  await tablet.untilQuiet();
  expect(await extentOf(address), "it is as it was").toEqual(slim);
  expect((await tablet.facts()).operations).not.toContain("width");
});

test("what is cut disappears at once, and the trunk is explained", async () => {
  const { tablet, metamers } = await limbed();
  await tablet.take("Prune");
  const before = await tablet.photograph("46-before-cut");
  // The server answers nothing until the picture has been looked at.
  workshop.server.pause();
  await tablet.swipe([way({ x: 700, y: 440 }, { x: 760, y: 620 })]);
  const where: Box = { x: 740, y: 500, width: 80, height: 70 };
  await until("it is hidden under the finger", async () => {
    return changed(before, await tablet.glimpse("47-cut-at-once"), where) > 0.02;
  });
  workshop.server.resume();
  await tablet.until("then it is gone", (facts) => facts.metamers < metamers - 2);
  const { sent } = await tablet.untilQuiet();
  await tablet.swipe([way({ x: SEED.x - 40, y: 618 }, { x: SEED.x + 40, y: 618 })]);
  await tablet.page.getByText("The trunk cannot be cut off").waitFor();
  expect((await tablet.facts()).sent).toBe(sent);
});

test("a line cuts all that it crosses, in one go", async () => {
  const { tablet, metamers } = await limbed();
  await tablet.take("Prune");
  const line = [
    ...way({ x: 480, y: 420 }, { x: 480, y: 560 }),
    ...way({ x: 480, y: 650 }, { x: 720, y: 650 }).slice(0, 6),
  ];
  await tablet.touch("touchStart", [line[0]!]);
  for (const point of [...line, ...way({ x: 560, y: 690 }, { x: 560, y: 690 }, 2)])
    await tablet.touch("touchMove", [point]);
  await tablet.showNow("48-marked");
  expect((await tablet.facts()).metamers, "nothing is cut before the finger lifts").toBe(metamers);
  await tablet.touch("touchEnd", []);
  const one = await tablet.untilQuiet();
  expect(one.metamers).toBeLessThan(metamers);
  await tablet.swipe([way({ x: 700, y: 440 }, { x: 760, y: 620 })]);
  const two = await tablet.untilQuiet();
  expect(two.metamers).toBeLessThan(one.metamers);
  await tablet.tap("Undo");
  await tablet.until("each line is one operation", (facts) => facts.metamers === one.metamers);
});

test("branches in the dark are marked and cut", async () => {
  const { tablet, address } = await workshop.fresh(LANDSCAPE);
  // A crown that shades its own inside.
  await workshop.act(address, [{ kind: "grow", steps: 12 }]);
  await tablet.until("it grows", ({ lastStep }) => lastStep > 0);
  const { metamers } = await tablet.untilQuiet();
  const slider = tablet.page.getByLabel("Darker than", { exact: true });
  await tablet.take("Prune");
  await slider.focus();
  for (let step = 0; step < 45; step++) await tablet.page.keyboard.press("ArrowRight");
  const cut = tablet.page.getByRole("button", { name: /^Cut \d+ branch/ });
  await cut.waitFor();
  await tablet.show("49-dim");
  await cut.tap();
  await tablet.until("they are gone", (facts) => facts.metamers < metamers);
  expect((await tablet.untilQuiet()).metamers, "what has light stays").toBeGreaterThan(0);
});

test("an upright tablet has room for every tool", async () => {
  const address = await workshop.server.newSession(5);
  const tablet = await workshop.open(address, { width: 834, height: 1194, detail: 0.5 });
  await tablet.swipe([way({ x: 417, y: 1000 }, { x: 417, y: 500 })]);
  await tablet.untilQuiet();
  for (const label of ["Bend", "Width", "Prune"] as const) {
    await tablet.take(label);
    if (label !== "Prune") await tablet.tapAt({ x: 417, y: 800 });
    await tablet.show(`50-upright-${label.toLowerCase()}`);
    const options = await tablet.boxOf(tablet.page.locator(".tool-options"));
    expect(options.x >= 0 && options.x + options.width <= 834 && options.y + options.height <= 1194, label).toBe(true);
    for (const target of await tablet.page.locator(".side-bar button, .tool-options button, .width-box button").all()) {
      const box = (await target.boundingBox())!;
      expect(Math.min(box.width, box.height), (await target.getAttribute("aria-label")) ?? "").toBeGreaterThanOrEqual(
        44,
      );
    }
  }
});

test("what a tool can be told has a name, help, a typed value and a reset", async () => {
  const { tablet, address } = await workshop.fresh({ ...LANDSCAPE, detail: 0.2 });
  const { page } = tablet;
  await workshop.act(address, [{ kind: "grow", steps: 12 }]);
  await tablet.until("it grows", ({ lastStep }) => lastStep > 0);
  await tablet.untilQuiet();
  const options = page.locator(".tool-options");
  for (const [tool, name, usual, typed, taken] of [
    ["Bend", "Stretch", "30", "70,4", "70"],
    ["Prune", "Darker than", "0", "99", "60"],
  ] as const) {
    await tablet.take(tool);
    const [slider, box] = [page.getByLabel(name, { exact: true }), page.getByLabel(`${name}: value`)];
    const reset = page.getByLabel(`Reset ${name}`);
    expect([await box.inputValue(), await reset.count()], name).toEqual([usual, 0]);
    const help = options.locator(`[id="${await slider.getAttribute("aria-describedby")}"]`);
    expect(await help.isVisible(), `the help of ${name} is folded`).toBe(false);
    await options.getByRole("button", { name: new RegExp(`^${name}`) }).tap();
    // And unfolds.
    await help.waitFor({ state: "visible" });
    expect((await help.textContent())!.length).toBeGreaterThan(30);
    const before = await tablet.boxOf(slider);
    await box.fill(typed);
    await page.keyboard.press("Enter");
    await until("what was typed is taken", async () => (await slider.inputValue()) === taken);
    expect(await tablet.boxOf(slider), "the slider stays under the finger").toEqual(before);
    await reset.tap();
    await until("it is as it was", async () => (await slider.inputValue()) === usual);
    await reset.waitFor({ state: "detached" });
  }
});
