import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";
import { withScreenKeyboard } from "./screen-keyboard";
import { LANDSCAPE, PHONE, type Screen } from "./screens";
import type { Tablet } from "./tablet";
import { way } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.withItsOwnServer();

/** What the page of the documentation has whoever reads it write. */
const PAGE = readFileSync(join(import.meta.dirname, "../../../docs/first-grammar.md"), "utf8");
const TEXTS = [...PAGE.matchAll(/```lsystem\n([\s\S]*?)\n```/g)].map(([, text]) => text ?? "");
const MISTAKES = [...PAGE.matchAll(/^\| `(.+?)` \| (.+) \|$/gm)].map(([, line, told]) => [line ?? "", told ?? ""]);

const UPRIGHT: Screen = { ...LANDSCAPE, width: 834, height: 1194 };
/** Glasses, and how many of their pixels the keyboard covers. */
const SCREENS: readonly [string, Screen, number][] = [
  ["a tablet on its side", LANDSCAPE, 380],
  ["a tablet upright", UPRIGHT, 340],
  ["a phone", PHONE, 330],
];

/** What keys of the row above the keyboard write; the arrow with its blanks. */
const KEYS: readonly (readonly [string, string])[] = [
  [" --> ", "-->"],
  ..."[]()+-&^/\\FA:,!<>*=|$%{}".split("").map((sign) => [sign, sign] as const),
];

const button = (tablet: Tablet, name: string | RegExp) => tablet.page.getByRole("button", { name, exact: true });
const tab = (tablet: Tablet, name: string) => tablet.page.getByRole("tab", { name, exact: true });
const area = (tablet: Tablet) => tablet.page.getByRole("textbox", { name: "Text of the grammar" });
const key = (tablet: Tablet, sign: string) =>
  tablet.page.locator(`.grammar-keys button[aria-label^=${JSON.stringify(`${sign} `)}]`);

/** Writes as somebody does who has the signs above the keyboard: letters and numbers alone come from the keyboard. */
async function writeBySigns(tablet: Tablet, text: string): Promise<void> {
  for (let left = text; left !== ""; ) {
    const [writes, sign] = KEYS.find(([writes]) => left.startsWith(writes)) ?? [left[0] ?? "", null];
    await (sign === null ? tablet.page.keyboard.type(writes) : tablet.press(key(tablet, sign)));
    left = left.slice(writes.length);
  }
}

/** Writes over all that stands there. */
async function writeOver(tablet: Tablet, text: string): Promise<void> {
  await tablet.press(area(tablet));
  await tablet.page.keyboard.press("ControlOrMeta+A");
  await tablet.page.keyboard.type(text);
}

test.each(SCREENS)(
  "LT11 whoever knows L-systems writes a first plant as the documentation tells, on %s",
  async (name, screen, keyboard) => {
    const { tablet } = await workshop.fresh(screen);
    const { page } = tablet;
    const shown = (what: string) => tablet.show(`102-newcomer-${name.replaceAll(" ", "-")}-${what}`);
    expect([TEXTS.length, MISTAKES.length]).toEqual([2, 3]);
    const [trunk = "", tree = ""] = TEXTS;

    // Two taps, and a plant stands there that can be changed.
    await tablet.tap("Grammars");
    await tablet.press(button(tablet, "Write your own"));
    await tablet.until("it is planted", ({ metamers, pending }) => metamers > 3 && pending === 0);
    await shown("1-begun");

    // With the keyboard on the screen the signs stand above it, and the text has room.
    await withScreenKeyboard(page, keyboard);
    await tablet.press(area(tablet));
    await page.locator(":root[data-keyboard]").waitFor({ state: "attached" });
    const row = await tablet.boxOf(page.locator(".grammar-keys"));
    expect(row.y + row.height).toBeLessThanOrEqual(screen.height - keyboard + 1);
    expect((await tablet.boxOf(page.locator(".grammar-scroll"))).height).toBeGreaterThan(96);
    const arrow = await tablet.boxOf(key(tablet, "-->"));
    if (screen !== PHONE) expect(arrow.x + arrow.width).toBeLessThanOrEqual(row.x + row.width);
    await shown("2-keyboard");

    // A trunk; its rule by the row of signs.
    const lines = trunk.split("\n");
    const rule = lines.pop() ?? "";
    await writeOver(tablet, `${lines.join("\n")}\n`);
    await writeBySigns(tablet, rule);
    await expect.poll(() => area(tablet).inputValue()).toBe(trunk);
    await tablet.until("the trunk stands", ({ metamers, pending }) => metamers >= 18 && metamers < 60 && pending === 0);
    await tablet.untilQuiet();
    await shown("3-trunk");

    // Branches.
    await writeOver(tablet, tree);
    const grown = await tablet.until("the tree stands", ({ metamers, pending }) => metamers > 300 && pending === 0);
    await page.getByText("Planted", { exact: true }).waitFor();
    await tablet.untilQuiet();
    await shown("4-tree");

    // Mistakes: underlined, told in words, and the plant stays as it was.
    for (const [line = "", told = ""] of MISTAKES) {
      await page.keyboard.press("ControlOrMeta+End");
      await page.keyboard.type(`\n${line}`);
      await page.locator('.grammar-layer [data-problem="0"]').first().waitFor();
      await tablet.press(button(tablet, "1 problem"));
      const words = page.locator(".grammar-problem, .grammar-problems").first();
      await expect.poll(async () => (await words.textContent())?.toLowerCase()).toContain(told.replaceAll("`", ""));
      // Who asks goes on writing where it is wrong.
      expect(await area(tablet).evaluate((field) => field === document.activeElement)).toBe(true);
      await shown(`5-mistake-${MISTAKES.findIndex(([other]) => other === line)}`);
      expect((await tablet.facts()).metamers).toBe(grown.metamers);
      await page.keyboard.press("ControlOrMeta+End");
      for (let i = 0; i <= line.length; i++) await page.keyboard.press("Backspace");
      await page.getByText("Planted", { exact: true }).waitFor();
      expect(await page.locator(".grammar-problems").count()).toBe(0);
    }

    // The keyboard goes; depth by a finger.
    await area(tablet).blur();
    await page.locator(":root:not([data-keyboard])").waitFor({ state: "attached" });
    await tablet.press(tab(tablet, "Depth"));
    const depth = page.getByRole("slider", { name: "Depth", exact: true });
    await button(tablet, "Depth 18").waitFor();
    const { x, y, width, height } = await tablet.boxOf(depth);
    const share = (at: number) => ({ x: x + at * width, y: y + height / 2 });
    const from = await depth.evaluate((range) => {
      const { value, min, max } = range as HTMLInputElement;
      return (Number(value) - Number(min)) / (Number(max) - Number(min));
    });
    await tablet.swipe([way(share(from), share(0.35), 8)]);
    await tablet.until("it is smaller", ({ metamers, pending }) => metamers < grown.metamers && pending === 0);
    await tablet.untilQuiet();
    await shown("6-less-deep");
    expect(await page.getByRole("slider", { name: "a", exact: true }).count()).toBe(1);
  },
);
