import type { Locator } from "playwright-core";
import { expect, test } from "vitest";
import type { GrammarBody } from "../../../client/src/wire/generated";
import { LANDSCAPE, PHONE, type Screen } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import { loop, way } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();
const UPRIGHT: Screen = { ...LANDSCAPE, width: 834, height: 1194 };
const SCREENS: readonly [string, Screen][] = [
  ["a tablet on its side", LANDSCAPE],
  ["a tablet upright", UPRIGHT],
  ["a phone", PHONE],
];

const button = (tablet: Tablet, name: string | RegExp) => tablet.page.getByRole("button", { name, exact: true });
const area = (tablet: Tablet) => tablet.page.getByRole("textbox", { name: "Text of the grammar" });
const textOf = (tablet: Tablet) => area(tablet).inputValue();

/** A tablet with the panel open at one of its parts. */
async function open(tablet: Tablet, part: "Grammars" | "Text" | "Depth") {
  const tab = tablet.page.getByRole("tab", { name: part, exact: true });
  if ((await tab.count()) === 0) await tablet.tap("Grammars");
  await tablet.press(tab);
  await tablet.page.getByRole("tab", { name: part, exact: true, selected: true }).waitFor();
}

/** Writes at the end of the text, line by line. */
async function write(tablet: Tablet, lines: readonly string[]) {
  await tablet.press(area(tablet));
  await tablet.page.keyboard.press("ControlOrMeta+End");
  await tablet.page.keyboard.type(lines.join("\n"));
}

/** Whether the field and the layer below it break their lines at the same places. */
function standsOverLayer(field: Locator): Promise<boolean> {
  return field.evaluate((field) => {
    const layer = field.parentElement?.querySelector(".grammar-layer");
    const [one, other] = [getComputedStyle(field), layer && getComputedStyle(layer)];
    const alike = (["font", "letterSpacing", "padding", "whiteSpace", "width"] as const).every(
      (name) => one[name] === other?.[name],
    );
    // What the field needs to show all of its text is just as high as the layer.
    const height = (field as HTMLTextAreaElement).style.height;
    (field as HTMLTextAreaElement).style.height = "0";
    const wanted = field.scrollHeight;
    (field as HTMLTextAreaElement).style.height = height;
    return alike && layer !== null && layer !== undefined && Math.abs(wanted - layer.scrollHeight) <= 1;
  });
}

const OWN = ["a = 30", "slider: a 5 90", "derivation length: 4", "axiom: A", "A --> F[+(a)A][-(a)A"];

test.each(SCREENS)("LT11 a plant is written, mended, taken deeper and back on %s", async (name, screen) => {
  const { tablet } = await workshop.fresh(screen);
  const { page } = tablet;
  const shown = name.replaceAll(" ", "-");
  await open(tablet, "Text");
  await write(tablet, OWN);

  // What is wrong is underlined where it stands; its number leads to the words, and they to the place.
  await page.locator('.grammar-layer [data-problem="0"]').first().waitFor();
  expect(await page.locator('.grammar-layer [data-problem="0"]').first().textContent()).toBe("[");
  expect(await area(tablet).getAttribute("aria-invalid")).toBe("true");
  await tablet.show(`101-grammar-${shown}-problem`);
  await tablet.press(button(tablet, "1 problem"));
  await page.getByText("Line 5, column 15").first().waitFor();
  const caret = () => area(tablet).evaluate((field) => (field as HTMLTextAreaElement).selectionStart);
  await until("the caret stands there", async () => {
    const before = (await textOf(tablet)).slice(0, await caret());
    return before.endsWith("A --> F[+(a)A]");
  });
  expect((await tablet.facts()).metamers).toBe(0);

  // A sign from the row above the keyboard ends the branch; the plant follows.
  await page.keyboard.press("ControlOrMeta+End");
  await tablet.press(button(tablet, "] the branch ends"));
  expect(await area(tablet).evaluate((field) => field === document.activeElement)).toBe(true);
  const planted = await tablet.until("the plant is there", ({ metamers, pending }) => metamers === 15 && pending === 0);
  await page.getByText("Planted", { exact: true }).waitFor();
  expect(await standsOverLayer(area(tablet))).toBe(true);
  await tablet.show(`101-grammar-${shown}`);

  // One more depth, and back through time; on a phone the line of time is folded at first.
  const folded = button(tablet, "Show the timeline");
  if ((await folded.count()) > 0) await tablet.press(folded);
  const depth = page.locator(".depth-stepper output");
  await tablet.press(button(tablet, "One depth more"));
  await tablet.until("it is a depth larger", ({ metamers }) => metamers === 31);
  await expect.poll(() => depth.textContent()).toContain("5");
  await tablet.press(button(tablet, "One depth less"));
  await tablet.until("it is as it was", ({ metamers }) => metamers === planted.metamers);

  // A number of the text as a slider: one movement is one deed.
  await open(tablet, "Depth");
  await tablet.show(`101-grammar-${shown}-depth`);
  const slider = page.getByRole("slider", { name: "a", exact: true });
  await slider.scrollIntoViewIfNeeded();
  await tablet.untilSettled();
  const box = await tablet.boxOf(slider);
  const at = (x: number) => ({ x: box.x + x * box.width, y: box.y + 0.5 * box.height });
  await tablet.swipe([way(at(0.3), at(0.8), 8)]);
  const value = page.getByLabel("a: value");
  await expect.poll(async () => Number(await value.inputValue())).toBeGreaterThan(60);
  await tablet.untilQuiet();
  await tablet.show(`101-grammar-${shown}-slider`);
  await tablet.tap("Undo");
  await expect.poll(async () => Number(await value.inputValue())).toBe(30);
  await tablet.until("the plant is there", ({ metamers }) => metamers === planted.metamers);
});

test("a bout of typing is one step to take back", async () => {
  const { tablet } = await workshop.fresh(LANDSCAPE);
  await open(tablet, "Grammars");
  await tablet.press(button(tablet, "Write your own"));
  const first = await tablet.until("it is planted", ({ metamers, pending }) => metamers > 3 && pending === 0);
  const before = await textOf(tablet);
  await write(tablet, ["B --> F", "C --> F"]);
  const next = await tablet.until("it is sent", ({ sent, acknowledged }) => sent > first.sent && sent === acknowledged);
  await write(tablet, ["", "D --> F"]);
  await tablet.until("the rest is sent", ({ sent, acknowledged }) => sent > next.sent && sent === acknowledged);
  await tablet.untilQuiet();
  await tablet.tap("Undo");
  await expect.poll(() => textOf(tablet)).toBe(before);
});

test("a grammar of the library is planted with a tap, and a branch tells its rule", async () => {
  const { tablet } = await workshop.fresh(LANDSCAPE);
  const { page } = tablet;
  await open(tablet, "Grammars");
  const card = page.locator('[data-grammar="barron-binary"]');
  await card.scrollIntoViewIfNeeded();
  const picture = card.locator("img");
  await until("its picture is there", () =>
    picture.evaluate((image) => (image as HTMLImageElement).complete && (image as HTMLImageElement).naturalWidth > 0),
  );
  await tablet.show("101-grammars");
  await tablet.press(card);
  await tablet.until("it is planted", ({ metamers, pending }) => metamers > 255 && pending === 0);
  await page.locator('[data-grammar="barron-binary"][aria-pressed="true"]').waitFor();

  await open(tablet, "Text");
  await tablet.press(button(tablet, "Rule and branch"));
  const arrow = await tablet.boxOf(page.locator(".grammar-layer [data-kind=arrow]").first());
  await tablet.tapAt({ x: arrow.x + arrow.width / 2, y: arrow.y + arrow.height / 2 });
  await page.getByText(/^This line made \d+ internodes/).waitFor();
  await tablet.show("101-grammar-rule");

  // And the other way round: no line is looked at where the tree has none, until a finger comes to wood.
  await open(tablet, "Depth");
  await open(tablet, "Text");
  await tablet.press(button(tablet, "Rule and branch"));
  const { x, y, width, height } = await tablet.boxOf(page.locator("main.workspace"));
  const looked = page.locator(".grammar-layer [data-looked]");
  await until("a branch tells its rule", async () => {
    for (let share = 0.5; share < 0.8 && (await looked.count()) === 0; share += 0.04) {
      await tablet.tapAt({ x: x + width / 2, y: y + share * height });
    }
    return (await looked.count()) > 0;
  });
  expect(await looked.allTextContents()).toContain("-->");
});

test("two people see what the other plants, and nobody's text is lost", async () => {
  const { tablet, address } = await workshop.fresh(LANDSCAPE);
  const other = await workshop.open(address, LANDSCAPE);
  await open(tablet, "Grammars");
  await tablet.press(button(tablet, "Write your own"));
  await tablet.until("it is planted", ({ metamers }) => metamers > 3);
  await open(other, "Text");
  const shared = await textOf(tablet);
  await expect.poll(() => textOf(other)).toBe(shared);

  // Somebody types what cannot be planted; meanwhile the other plants something else.
  await write(tablet, ["E --> F["]);
  await other.page.getByText(/is writing here, too/).waitFor();
  await write(other, ["G --> F"]);
  await other.page
    .getByText("Planted", { exact: true })
    .or(other.page.getByRole("button", { name: /note/ }))
    .waitFor();
  await tablet.page.getByText(/has planted another text/).waitFor();
  expect(await textOf(tablet)).toContain("E --> F[");
  await tablet.show("101-grammar-theirs");
  await tablet.press(button(tablet, "Take theirs"));
  await expect.poll(() => textOf(tablet)).toContain("G --> F");
  await tablet.press(button(tablet, "Bring it back"));
  await expect.poll(() => textOf(tablet)).toContain("E --> F[");
});

test("a file that is dropped on the page is opened and planted", async () => {
  const { tablet } = await workshop.fresh(LANDSCAPE);
  const { page } = tablet;
  // What takes files comes once the first picture is drawn.
  await tablet.photograph("101-grammar-drop");
  await page.locator(".file-drop").waitFor({ state: "attached" });
  await page.evaluate(() => {
    const data = new DataTransfer();
    data.items.add(new File(["axiom: F\nF --> F[+F]F\nderivation length: 3\n"], "weed.lsys"));
    for (const kind of ["dragover", "drop"]) {
      document.body.dispatchEvent(new DragEvent(kind, { dataTransfer: data, bubbles: true, cancelable: true }));
    }
  });
  await tablet.until("it is planted", ({ metamers }) => metamers >= 27);
  await expect.poll(() => textOf(tablet)).toContain("F --> F[+F]F");
});

/** The ends of all internodes of a session's tree, in internodes; a seed is none. */
async function ends(address: string): Promise<number[][]> {
  const answer = await fetch(`${address.replace("/s/", "/api/v1/sessions/")}/tree.json`);
  const { metamers, parameters } = (await answer.json()) as {
    metamers: { parent: number | null; position: number[] }[];
    parameters: { internode_length: number };
  };
  const grown = metamers.filter(({ parent }) => parent !== null);
  return grown.map(({ position }) => position.map((metres) => metres / parameters.internode_length));
}

/** Whether a place lies in what is drawn on a plane, seen across it. */
function surrounds({ outline, plane: { origin, right, up } }: GrammarBody, place: readonly number[]): boolean {
  const along = (axis: readonly number[]) => axis.reduce((sum, part, i) => sum + part * (place[i]! - origin[i]!), 0);
  const [x, y] = [along(right), along(up)];
  return (
    outline.filter(([x1, y1], i) => {
      const [x2, y2] = outline[(i + 1) % outline.length]!;
      return y1 > y !== y2 > y && x < x1 + ((y - y1) / (y2 - y1)) * (x2 - x1);
    }).length %
      2 ===
    1
  );
}

/** Grows as far as it may, and asks each place before it draws. */
const FILLS = [
  "axiom: f(1)Q(-1)",
  "derivation length: 14",
  "Q(v) : v < 0 --> Q(inside(0))",
  "f(l) > Q(v) : v == 1 --> F(l)",
  "f(l) > Q(v) : v == 0 --> *",
  "Q(v) : v == 0 --> %",
  "Q(v) : v == 1 --> [&(60)f(1)Q(-1)]/(137.5)[&(35)f(1)Q(-1)]f(1)Q(-1)",
];

test.each([
  ["a tablet on its side", LANDSCAPE],
  ["a tablet upright", UPRIGHT],
] as const)("GR9 a space is drawn by hand and filled on %s", async (name, screen) => {
  const { tablet, address } = await workshop.fresh(screen);
  const { page } = tablet;
  const shown = name.replaceAll(" ", "-");
  const bodies: GrammarBody[] = [];
  page.on("websocket", (socket) =>
    socket.on("framesent", ({ payload }) => {
      const said = String(payload);
      const within = said.includes('"set_grammar_body"')
        ? (JSON.parse(said) as { command?: { within?: GrammarBody } }).command?.within
        : undefined;
      if (within) bodies.push(within);
    }),
  );
  await page.reload();
  await tablet.untilReady();
  await open(tablet, "Text");
  await write(tablet, FILLS);
  const free = await tablet.until("it is planted", ({ metamers, pending }) => metamers > 500 && pending === 0);
  await open(tablet, "Depth");
  await tablet.untilQuiet();

  // A loop on the picture, from below the foot of the plant upwards.
  await tablet.press(button(tablet, "Draw its space"));
  await page.getByText(/^Draw an outline on the picture/).waitFor();
  await tablet.showNow(`101-grammar-${shown}-space-ahead`);
  const { x, y, width, height } = await tablet.boxOf(page.locator("main.workspace canvas"));
  const centre = { x: x + 0.5 * width, y: y + 0.55 * height };
  await tablet.swipe([loop(centre, { x: 0.12 * width, y: 0.27 * height })]);
  const outline = page.locator(".grammar-space-outline path");
  await expect.poll(() => outline.getAttribute("d")).toContain("L");
  const filled = await tablet.until(
    "the plant stays within it",
    ({ metamers, pending }) => metamers < free.metamers && metamers > 20 && pending === 0,
  );
  await tablet.untilQuiet();
  await tablet.show(`101-grammar-${shown}-space`);

  // No internode ends outside of what was drawn.
  expect(bodies).toHaveLength(1);
  const grown = await ends(address);
  expect(grown.length).toBeGreaterThan(20);
  expect(grown.filter((end) => !surrounds(bodies[0]!, end))).toEqual([]);

  // Taken away, all space is the plant's again; taken back, it is as it was.
  await tablet.press(button(tablet, "Take the space away"));
  const isFree = () =>
    tablet.until("it is free", ({ metamers, pending }) => metamers === free.metamers && pending === 0);
  await isFree();
  await outline.waitFor({ state: "detached" });
  await tablet.tap("Undo");
  await tablet.until("the space is back", ({ metamers, pending }) => metamers === filled.metamers && pending === 0);
  await outline.waitFor({ state: "attached" });

  // The slider of depth goes back and forth through what was derived, with a finger.
  const depth = page.getByRole("slider", { name: "Depth", exact: true });
  await depth.scrollIntoViewIfNeeded();
  await tablet.untilSettled();
  const box = await tablet.boxOf(depth);
  const at = (x: number) => ({ x: box.x + x * box.width, y: box.y + 0.5 * box.height });
  await tablet.swipe([way(at(0.7), at(0.2), 8)]);
  await tablet.until("it is less deep", ({ metamers, pending }) => metamers < filled.metamers && pending === 0);
});
