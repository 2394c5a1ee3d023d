import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import type { AxeResults } from "axe-core";
import { describe, expect, it } from "vitest";
import { COARSE, type Screen } from "./screens";
import { inTime } from "./server";
import type { Tablet } from "./tablet";
import { atWork, PANELS, pullDown, SHEETS, unfolded } from "./visits";
import { way } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

const axe = await readFile(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

/** Nothing is looked at here: the fewer pixels the sooner. */
const TABLET: Screen = { ...COARSE, detail: 0.2 };
const PHONE: Screen = { width: 390, height: 844, detail: 0.2 };

/** What a person with an aid could not use: findings of axe that are serious or worse, each with what it is about. */
async function findings(tablet: Tablet, where: string, within = "body"): Promise<string[]> {
  // What slides in is judged once it has come.
  await tablet.untilCome();
  if (!(await tablet.page.evaluate(() => "axe" in globalThis))) await tablet.page.evaluate(axe);
  const judged = tablet.page.evaluate(async (within) => {
    const { axe } = globalThis as unknown as { axe: { run(within: string): Promise<AxeResults> } };
    return axe.run(within);
  }, within);
  const results = await inTime(`axe judges ${where}`, judged);
  expect(results.passes.length, where).toBeGreaterThan(5);
  return results.violations
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .flatMap(({ id, nodes }) => nodes.map(({ html, failureSummary }) => `${where}: ${id}: ${html} ${failureSummary}`));
}

async function wear(tablet: Tablet, theme: "light" | "dark"): Promise<void> {
  await tablet.page.emulateMedia({ colorScheme: theme, reducedMotion: "reduce" });
}

/** A phone on which something was drawn. */
async function phone(): Promise<Tablet> {
  const { tablet } = await workshop.fresh(PHONE);
  await tablet.swipe([way({ x: 215, y: 600 }, { x: 215, y: 300 })]);
  await tablet.untilQuiet();
  return tablet;
}

/** On a phone, has the tools unfold. */
async function unfoldTools(tablet: Tablet): Promise<void> {
  await tablet.page.getByLabel("All tools", { exact: false }).tap();
  await tablet.page.getByRole("button", { name: "Prune", exact: true }).waitFor();
}

/** Has the tool marked what is darker than so many hundredths. */
async function markDark(tablet: Tablet, percent: string): Promise<void> {
  await tablet.page.getByLabel("Darker than: value").fill(percent);
  await tablet.page.keyboard.press("Enter");
  await tablet.page.locator(".tool-options .danger").waitFor();
}

/** Has the tour begin from the sheet of help. */
async function tourFromHelp(tablet: Tablet): Promise<void> {
  await tablet.page.getByRole("button", { name: "Take the tour" }).tap();
  await tablet.page.getByText("1 of 3").waitFor();
}

describe.each(["light", "dark"] as const)("in the %s theme", (theme) => {
  it("axe has nothing serious against the workspace and its panels", async () => {
    const { tablet } = await workshop.drawn(TABLET);
    await wear(tablet, theme);
    const found = await findings(tablet, "workspace");
    for (const panel of PANELS) {
      await pullDown(tablet, panel);
      found.push(...(await findings(tablet, panel, ".drawer")));
    }
    expect(found).toEqual([]);
  });

  it("nor against the sheets", async () => {
    const { tablet } = await workshop.drawn(TABLET);
    await wear(tablet, theme);
    const found: string[] = [];
    for (const sheet of SHEETS) {
      await tablet.tap(sheet);
      await tablet.page.getByRole("dialog").waitFor();
      found.push(...(await findings(tablet, sheet, "dialog")));
      await tablet.page.keyboard.press("Escape");
      await tablet.page.getByRole("dialog").waitFor({ state: "detached" });
    }
    expect(found).toEqual([]);
  });

  it("nor against any tool at work", async () => {
    const stem = await workshop.stem(TABLET);
    const { tablet } = stem;
    await wear(tablet, theme);
    const found: string[] = [];
    await atWork(stem, async (where) => void found.push(...(await findings(tablet, where, "main"))));
    expect(found).toEqual([]);
  });

  it("nor, on a phone, against the tour and what is folded out", async () => {
    const tablet = await phone();
    await wear(tablet, theme);
    const found: string[] = [];
    await unfoldTools(tablet);
    found.push(...(await findings(tablet, "all tools")));
    await tablet.take("Prune");
    await markDark(tablet, "50");
    found.push(...(await findings(tablet, "Prune", "main")));
    await tablet.tap("More");
    await tablet.page.getByRole("list", { name: "More" }).waitFor();
    found.push(...(await findings(tablet, "menu", "main")));
    await tablet.page.getByRole("button", { name: "Help" }).tap();
    await tourFromHelp(tablet);
    found.push(...(await findings(tablet, "tour", "main")));
    expect(found).toEqual([]);
  });
});

/** Controls within a part of the page that a finger 22 pixels off their middle would miss. */
async function small(tablet: Tablet, where: string, within = "main"): Promise<string[]> {
  await tablet.untilCome();
  const found = await tablet.page.locator(within).evaluate((part) => {
    const FINGER = 44;
    const wide = (element: Element | null | undefined) => {
      const { width, height } = element?.getBoundingClientRect() ?? { width: 0, height: 0 };
      return Math.round(width) >= FINGER && Math.round(height) >= FINGER;
    };
    /** What is at a place of the glass is the control, or its label. */
    const answers = (control: Element, x: number, y: number) => {
      const there = document.elementFromPoint(x, y);
      return there !== null && (control.contains(there) || there.closest("label")?.control === control);
    };
    const used = 'button, a[href], input, select, textarea, summary, [role="slider"], [role="tab"]';
    return [...part.querySelectorAll<HTMLElement>(used)].flatMap((control) => {
      const label = control.closest("label");
      if (wide(control) || wide(label) || !control.checkVisibility({ visibilityProperty: true })) return [];
      // The workspace itself must stay where it is.
      if (control.closest(".drawer, dialog")) control.scrollIntoView({ block: "center" });
      const { x, y, width, height } = (label ?? control).getBoundingClientRect();
      if (width === 0) return [];
      const [middleX, middleY, reach] = [x + width / 2, y + height / 2, FINGER / 2 - 1];
      const hit = [
        [-reach, 0],
        [reach, 0],
        [0, -reach],
        [0, reach],
      ].every(([right = 0, down = 0]) => answers(control, middleX + right, middleY + down));
      const name = control.getAttribute("aria-label") ?? control.textContent?.trim().slice(0, 40);
      return hit ? [] : [`${name}: ${Math.round(width)} × ${Math.round(height)}`];
    });
  });
  return found.map((line) => `${where}: ${line}`);
}

describe.each([
  ["a tablet", TABLET],
  ["a phone", PHONE],
] as const)("a finger on %s finds every control 44 pixels wide and high", (_, screen) => {
  /** Taps what stands in the bar, or on a phone in its menu. */
  const open = async (tablet: Tablet, label: string) => {
    if (screen === PHONE) await tablet.tap("More");
    await tablet.page.getByRole("button", { name: label, exact: true }).first().tap();
  };

  it("of the bars and the panels", async () => {
    const { tablet } = await workshop.fresh(screen);
    const { page } = tablet;
    const found = await small(tablet, "bars");
    for (const panel of PANELS) {
      await pullDown(tablet, panel);
      const tabs = await page.locator(".drawer [role=tab]").all();
      if (panel === "Scene") {
        await page.locator(".kinds button").first().tap();
        await tablet.until("it has what can be told of a thing", ({ obstacles }) => obstacles === 1);
      }
      if (tabs.length === 0) {
        await unfolded(tablet);
        found.push(...(await small(tablet, panel, ".drawer")));
      }
      for (const tab of tabs) {
        await tab.tap();
        await expect.poll(() => tab.getAttribute("aria-selected")).toBe("true");
        await unfolded(tablet);
        found.push(...(await small(tablet, `${panel}, ${await tab.textContent()}`, ".drawer")));
      }
    }
    expect(found).toEqual([]);
  });

  it("of the sheets, the menu and the tour", async () => {
    const { tablet } = await workshop.fresh(screen);
    const { page } = tablet;
    const found: string[] = [];
    const dialog = page.getByRole("dialog");
    for (const sheet of SHEETS) {
      await open(tablet, sheet);
      await dialog.waitFor();
      found.push(...(await small(tablet, sheet, "dialog")));
      if (sheet === "Save") {
        await dialog.getByRole("button", { name: "Save tree" }).tap();
      } else {
        if (sheet === "Library") {
          const more = dialog.getByRole("button", { name: /^More for / }).first();
          await more.tap();
          await page.locator(".card-menu").waitFor();
          found.push(...(await small(tablet, "the menu of a tree", ".card-menu")));
          await page.locator(".card-menu").getByRole("button", { name: "Rename" }).tap();
          // Where the key is pressed too soon it closes the sheet.
          await dialog.locator("input:focus").waitFor();
          found.push(...(await small(tablet, "renaming", "dialog")));
          await page.keyboard.press("Escape");
          await dialog.locator("input:focus").waitFor({ state: "detached" });
        }
        await page.keyboard.press("Escape");
      }
      await dialog.waitFor({ state: "detached" });
    }
    if (screen === PHONE) {
      await tablet.tap("More");
      const menu = page.getByRole("list", { name: "More" });
      await menu.waitFor();
      found.push(...(await small(tablet, "menu")));
      await tablet.tap("More");
      await menu.waitFor({ state: "detached" });
    }
    await open(tablet, "Help");
    await tourFromHelp(tablet);
    found.push(...(await small(tablet, "tour")));
    expect(found).toEqual([]);
  });
});

it("a finger finds every control of the tools at work 44 pixels wide and high", async () => {
  const stem = await workshop.stem(TABLET);
  const found: string[] = [];
  await atWork(stem, async (where) => void found.push(...(await small(stem.tablet, where))));
  expect(found).toEqual([]);
});

it("and on a phone those of what the tools can be told", async () => {
  const tablet = await phone();
  const found: string[] = [];
  for (const tool of ["Bend", "Width", "Prune"] as const) {
    await unfoldTools(tablet);
    if (tool === "Bend") found.push(...(await small(tablet, "all tools")));
    await tablet.take(tool);
    found.push(...(await small(tablet, tool)));
  }
  await markDark(tablet, "50");
  found.push(...(await small(tablet, "what is dark")));
  expect(found).toEqual([]);
});
