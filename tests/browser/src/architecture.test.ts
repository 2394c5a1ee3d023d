import { expect, test } from "vitest";
import { pickSpecies } from "./by-hand";
import { LANDSCAPE, PHONE, type Screen, SMALL } from "./screens";
import { until } from "./server";
import type { Tab, Tablet } from "./tablet";
import { middle, type Point, way } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** A tablet held upright. */
const UPRIGHT: Screen = { width: 834, height: 1194, detail: 0.5 };

/** One with the panel of architecture pulled down and one of its tabs shown. */
async function opened(tab: Tab, screen?: Screen): Promise<{ tablet: Tablet; address: string }> {
  const { tablet, address } = await workshop.fresh(screen);
  await pullDown(tablet, tab);
  return { tablet, address };
}

async function pullDown(tablet: Tablet, tab: Tab): Promise<void> {
  await tablet.tap("Architecture");
  await tablet.turnTo(tab);
  await sketch(tablet);
}

/** The lines of the schematic tree that has grown with the parameters as they are. */
async function sketch(tablet: Tablet): Promise<string> {
  await tablet.page.locator('.schematic[data-grown="true"]').waitFor();
  return tablet.page
    .locator(".schematic-wood")
    .evaluateAll((paths) => paths.map((path) => path.getAttribute("d")).join());
}

/** A sketch that lasts, other than one before. */
async function otherSketch(tablet: Tablet, before: string, after = "a change"): Promise<string> {
  let now = before;
  await until(`the schematic tree is another after ${after}`, async () => {
    now = await sketch(tablet);
    return now !== before;
  });
  return now;
}

/** What stands in a box that can be typed in. */
function typed(tablet: Tablet, name: string): Promise<string> {
  return tablet.page.getByLabel(`${name}: value`, { exact: true }).inputValue();
}

async function untilTyped(tablet: Tablet, name: string, wanted: (value: string) => boolean): Promise<string> {
  let value = "";
  await until(`${name} is as wanted`, async () => {
    value = await typed(tablet, name);
    return wanted(value);
  }).catch((error) => {
    throw new Error(`${error}; it is ${value}`);
  });
  return value;
}

/** Drags a grip with one finger by so many pixels. */
async function drag(tablet: Tablet, grip: string, by: Point, lift = true): Promise<void> {
  const knob = tablet.page.getByRole("slider", { name: grip, exact: true });
  await knob.scrollIntoViewIfNeeded();
  const box = await tablet.boxOf(knob);
  expect(Math.min(box.width, box.height), "a grip is as large as a fingertip").toBeGreaterThan(43.9);
  const from = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  await tablet.lead([way(from, { x: from.x + by.x, y: from.y + by.y }, 14)], 20);
  if (lift) await tablet.touch("touchEnd", []);
}

/** Every widget: which grip is dragged by how much, and which parameter that changes. */
const WIDGETS: readonly { grip: string; by: Point; parameter: string; unseen?: boolean }[] = [
  { grip: "Set-point angle", by: { x: 70, y: 70 }, parameter: "Set-point angle" },
  { grip: "Branching angle", by: { x: -5, y: -45 }, parameter: "Branching angle" },
  { grip: "Deflection", by: { x: -40, y: 10 }, parameter: "Deflection" },
  { grip: "Balance of heading, tropism and free space", by: { x: 30, y: 40 }, parameter: "Straight on" },
  { grip: "Upper side", by: { x: 0, y: -30 }, parameter: "Shift" },
  // A flat tree has no buds on its flanks.
  { grip: "Flanks", by: { x: -20, y: 0 }, parameter: "Half-axis, level", unseen: true },
  { grip: "Occupied zone", by: { x: -14, y: 0 }, parameter: "Occupied zone" },
  { grip: "Depth of perception", by: { x: 0, y: -22 }, parameter: "Depth of perception" },
  { grip: "Angle of perception", by: { x: 20, y: 60 }, parameter: "Angle of perception" },
];

test("each widget follows a finger, and one undo takes the whole drag back", async () => {
  const { tablet, address } = await opened("Form");
  // Another tablet at the same tree sees only what the server has.
  const witness = await workshop.open(address);
  await pullDown(witness, "Form");
  for (const { grip, by, parameter, unseen } of WIDGETS) {
    const [before, drawn] = [await typed(tablet, parameter), await sketch(tablet)];
    await drag(tablet, grip, by);
    const after = await untilTyped(tablet, parameter, (value) => value !== before);
    await untilTyped(witness, parameter, (value) => value === after);
    const { operations } = await tablet.until("one more operation", (facts) => facts.done === 1);
    expect(operations, grip).toBe("parameters");
    if (!unseen) await otherSketch(tablet, drawn, `${grip}: ${after}`);

    await tablet.tap("Undo");
    await untilTyped(tablet, parameter, (value) => value === before);
    await untilTyped(witness, parameter, (value) => value === before);
    await until(`the sketch is as it was before ${grip}`, async () => (await sketch(tablet)) === drawn);
    await tablet.until("nothing is left of it", (facts) => facts.done === 0);
  }
});

test("the sketch changes while the finger is still down", async () => {
  const { tablet } = await opened("Form", LANDSCAPE);
  await tablet.show("80-architecture-form");
  const drawn = await sketch(tablet);
  await drag(tablet, "Set-point angle", { x: 80, y: 84 }, false);
  await otherSketch(tablet, drawn);
  await tablet.show("81-architecture-dragging");
  await tablet.touch("touchEnd", []);
  await untilTyped(tablet, "Set-point angle", (value) => Math.abs(Number(value) - 90) < 4);
});

test("a species is picked by its picture, and undone as one", async () => {
  const { tablet, address } = await opened("Species", LANDSCAPE);
  const drawn = await sketch(tablet);
  const willow = tablet.page.locator('[data-species="weeping-willow"]');
  await willow.scrollIntoViewIfNeeded();
  await until("its picture is there", async () => (await willow.locator('[data-state="there"]').count()) > 0);
  await willow.tap();
  await tablet.until("one operation", (facts) => facts.done === 1);
  await expect.poll(() => willow.getAttribute("aria-pressed")).toBe("true");
  const willowy = await otherSketch(tablet, drawn);
  await tablet.show("82-architecture-species");

  const witness = await workshop.open(address);
  await pullDown(witness, "Species");
  await until(
    "the server has it",
    async () => (await witness.page.locator(".origin").innerText()) === "Weeping willow",
  );

  await tablet.turnTo("Form");
  await drag(tablet, "Branching angle", { x: 0, y: 40 });
  await until("it is changed", async () => (await tablet.page.locator(".origin").innerText()).endsWith("changed"));
  await tablet.tap("Reset Branching");
  await until(
    "it is the species again",
    async () => !(await tablet.page.locator(".origin").innerText()).endsWith("changed"),
  );
  await until("the sketch is the species' again", async () => (await sketch(tablet)) === willowy);

  await tablet.until("picked, dragged and reset", ({ done }) => done === 3);
  for (let operations = 3; operations > 0; operations--) {
    await tablet.tap("Undo");
    await tablet.until("one less", (facts) => facts.done === operations - 1);
  }
  await until("it is no species", async () => (await tablet.page.locator(".origin").innerText()) === "Your own");
  await until("the sketch is as it was", async () => (await sketch(tablet)) === drawn);
});

test("each number of a programme's stage stands beside its name", async () => {
  const { tablet } = await workshop.fresh(SMALL);
  const { page } = tablet;
  await tablet.tap("Architecture");
  await tablet.turnTo("Species");
  await page.locator('[data-species="stone-pine"]').tap();
  await tablet.untilQuiet();
  await tablet.turnTo("Growth");
  const course = page.getByLabel("Parameter whose course is shown");
  const numbers = page.locator(".programme-number");
  for (const name of ["Shedding", "Set-point angle"]) {
    await course.selectOption(name);
    await expect.poll(() => numbers.allInnerTexts()).toEqual(["From age", name]);
    for (const number of await numbers.all()) {
      const [text, field] = [number.locator("span").first(), number.getByRole("textbox")];
      const [left, right] = [await tablet.boxOf(text), await tablet.boxOf(field)];
      expect(Math.abs(middle(left).y - middle(right).y), "they stand side by side").toBeLessThan(4);
    }
  }
});

test("the curve of a programme over age is pulled by a finger and by keys, and says what hand-set values override", async () => {
  const { tablet, address } = await workshop.fresh(LANDSCAPE);
  const { page } = tablet;
  await pickSpecies(tablet, "scots-pine");
  await tablet.tap("Architecture");
  await tablet.turnTo("Growth");
  await page.getByLabel("Parameter whose course is shown").selectOption("Shedding");
  const curve = page.locator(".programme .diagram");
  const age = curve.locator("text");
  expect(await age.textContent()).toBe("age 0");
  expect(await age.evaluate((text) => getComputedStyle(text).fill), "it can be read").not.toBe("none");

  const grip = curve.getByLabel("Shedding from age 10", { exact: true });
  const from = middle(await tablet.boxOf(grip));
  const { done } = await tablet.facts();
  await tablet.swipe([way(from, { x: from.x + 40, y: from.y - 30 }, 6)]);
  await tablet.until("the programme is another one", (facts) => facts.done === done + 1);
  const moved = curve.getByLabel(/^Shedding from age [1-9]/);
  const stage = Number(/\d+$/.exec((await moved.getAttribute("aria-label")) ?? "")?.[0]);
  expect(stage).toBeGreaterThan(10);
  await moved.focus();
  await page.keyboard.press("ArrowRight");
  await curve.getByLabel(`Shedding from age ${stage + 1}`, { exact: true }).waitFor();
  await tablet.until("and another one by the key", (facts) => facts.done === done + 2);

  const line = curve.locator(".programme-line");
  expect(await line.getAttribute("data-overridden")).toBe("false");
  await workshop.act(address, [{ kind: "set_parameters", parameters: { shedding_threshold: 0.4 } }]);
  await page.getByText("Set by hand, and so the same at every age:").waitFor();
  await until("the curve shows it", async () => (await line.getAttribute("data-overridden")) === "true");
  await page.getByRole("button", { name: "Let Shedding follow the programme again" }).tap();
  await page.getByText("All parameters follow the programme.").waitFor();
});

test("species are found by their names in any language", async () => {
  const { tablet } = await opened("Species");
  const search = tablet.page.getByRole("searchbox");
  const found = () =>
    tablet.page
      .locator(".species-card")
      .evaluateAll((cards) => cards.map((card) => (card as HTMLElement).dataset.species));
  await search.fill("eiche");
  await expect.poll(found).toEqual(["oak"]);
  await search.fill("Betula");
  await expect.poll(found).toEqual(["birch"]);
  await search.fill("no such tree");
  await expect.poll(found).toEqual([]);
});

test("keys and typed values do what fingers do", async () => {
  const { tablet } = await opened("Form");
  const arrow = tablet.page.getByRole("slider", { name: "Set-point angle", exact: true });
  await arrow.focus();
  for (let i = 0; i < 5; i++) await tablet.page.keyboard.press("ArrowUp");
  await untilTyped(tablet, "Set-point angle", (value) => value === "5");
  await expect.poll(() => arrow.getAttribute("aria-valuetext")).toBe("5°");
  await tablet.page.keyboard.press("End");
  await untilTyped(tablet, "Set-point angle", (value) => value === "180");

  const box = tablet.page.getByLabel("Tropism: value", { exact: true });
  await box.fill("0.6");
  await box.press("Enter");
  await untilTyped(tablet, "Straight on", (value) => value === "0.27");
  await untilTyped(tablet, "Free space", (value) => value === "0.13");
});

test("a slider is dragged as one operation too", async () => {
  const { tablet } = await opened("Growth", LANDSCAPE);
  const slider = tablet.page.getByRole("slider", { name: "Apical dominance", exact: true });
  const box = await tablet.boxOf(slider);
  const drawn = await sketch(tablet);
  const y = box.y + box.height / 2;
  await tablet.swipe([way({ x: box.x + 0.4 * box.width, y }, { x: box.x + 0.85 * box.width, y })]);
  await untilTyped(tablet, "Apical dominance", (value) => Number(value) > 0.6);
  const { operations } = await tablet.until("one operation", (facts) => facts.done === 1);
  expect(operations).toBe("parameters");
  await otherSketch(tablet, drawn);
  await tablet.show("83-architecture-growth");
  await tablet.tap("Undo");
  await untilTyped(tablet, "Apical dominance", (value) => value === "0.520");
});

test("the panel of the brush says what the brush does", async () => {
  const { tablet } = await workshop.fresh(LANDSCAPE);
  await tablet.page.locator(".tool-bar").getByRole("button", { name: "Brush", exact: true }).tap();
  const panel = tablet.page.locator(".drawer");
  const says = () => panel.locator(".brush-does").innerText();
  await expect.poll(says).toMatch(/^Fills its sweep/);
  await tablet.show("84-brush-panel");
  await drag(tablet, "Rim of the brush", { x: -200, y: 0 });
  await expect.poll(says).toMatch(/^Sketches one limb/);
  await drag(tablet, "Rim of the brush", { x: 12, y: 0 });
  await expect.poll(says).toMatch(/^Leads one limb/);

  const density = panel.getByLabel("Marker density: value");
  await density.fill("0.4");
  await density.press("Enter");
  const { operations } = await tablet.until("the server has it", (facts) => facts.done === 1);
  expect(operations).toBe("parameters");
  await tablet.tap("Undo");
  await until("it is as it was", async () => (await density.inputValue()) === "0.15");
});

test.each([
  ["upright", UPRIGHT],
  ["phone", PHONE],
] as const)("the widgets can be reached on a tablet held otherwise: %s", async (name, screen) => {
  const { tablet } = await opened("Form", screen);
  await drag(tablet, "Angle of perception", { x: 10, y: 40 });
  await untilTyped(tablet, "Angle of perception", (value) => Number(value) > 100);
  await tablet.show(`85-architecture-${name}`);
});
