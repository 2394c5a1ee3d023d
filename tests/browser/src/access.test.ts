import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import type { AxeResults } from "axe-core";
import { describe, expect, it } from "vitest";
import { COARSE, type Screen, type Tablet, way } from "./tablet";
import { type Opened, Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

const axe = await readFile(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

const PHONE: Screen = { width: 390, height: 844, detail: 0.5 };
const PANELS = ["Architecture", "Brush", "Leaves", "Branches", "Background", "Scene"];

/** What a person with an aid could not use: findings of axe that are serious or worse, each with what it is about. */
async function findings(tablet: Tablet, where: string): Promise<string[]> {
  // What slides in is judged once it has come.
  await tablet.page.waitForTimeout(500);
  if (!(await tablet.page.evaluate(() => "axe" in globalThis))) await tablet.page.evaluate(axe);
  const results = await tablet.page.evaluate(async () => {
    const { axe } = globalThis as unknown as { axe: { run(): Promise<AxeResults> } };
    return axe.run();
  });
  expect(results.passes.length).toBeGreaterThan(5);
  return results.violations
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .flatMap(({ id, nodes }) => nodes.map(({ html, failureSummary }) => `${where}: ${id}: ${html} ${failureSummary}`));
}

/** A phone on which something was drawn. */
async function phone(): Promise<Opened> {
  const opened = await workshop.fresh(PHONE);
  await opened.tablet.swipe([way({ x: 215, y: 600 }, { x: 215, y: 300 })]);
  await opened.tablet.untilQuiet();
  return opened;
}

async function wear(tablet: Tablet, theme: "light" | "dark"): Promise<void> {
  await tablet.page.emulateMedia({ colorScheme: theme, reducedMotion: "reduce" });
}

describe.each(["light", "dark"] as const)("in the %s theme", (theme) => {
  it("axe has nothing serious against the workspace and its panels", async () => {
    const { tablet } = await workshop.drawn();
    await wear(tablet, theme);
    const found = await findings(tablet, "workspace");
    for (const panel of PANELS) {
      await tablet.tap(panel);
      found.push(...(await findings(tablet, panel)));
    }
    expect(found).toEqual([]);
  });

  it("nor against the sheets", async () => {
    const { tablet } = await workshop.drawn();
    await wear(tablet, theme);
    const found: string[] = [];
    for (const sheet of ["Save", "Library", "Share", "Settings", "Help"]) {
      await tablet.tap(sheet);
      await tablet.page.getByRole("dialog").waitFor();
      found.push(...(await findings(tablet, sheet)));
      await tablet.page.keyboard.press("Escape");
      await tablet.page.getByRole("dialog").waitFor({ state: "detached" });
    }
    expect(found).toEqual([]);
  });

  it("nor against the tools at work, the tour and what is folded out", async () => {
    const { tablet } = await phone();
    await wear(tablet, theme);
    const found: string[] = [];
    for (const tool of ["Bend", "Width", "Prune"]) {
      await tablet.page.getByLabel("All tools", { exact: false }).tap();
      await tablet.tap(tool);
      found.push(...(await findings(tablet, tool)));
    }
    await tablet.tap("More");
    found.push(...(await findings(tablet, "menu")));
    await tablet.page.getByRole("button", { name: "Help" }).tap();
    await tablet.page.getByRole("button", { name: "Take the tour" }).tap();
    found.push(...(await findings(tablet, "tour")));
    expect(found).toEqual([]);
  });
});

describe("a finger", () => {
  it.each([
    ["a tablet", COARSE],
    ["a phone", PHONE],
  ])("finds every control of the bars on %s 44 pixels wide and high", async (_, screen) => {
    const { tablet } = screen === PHONE ? await phone() : await workshop.drawn(screen);
    const small = await tablet.page
      .locator(":is(.tool-bar, .side-bar, .foot) :is(button, a, input, [role=slider])")
      .evaluateAll((controls) =>
        controls.flatMap((control) => {
          const { width, height } = control.getBoundingClientRect();
          const name = control.getAttribute("aria-label");
          return width < 44 || height < 44 ? [`${name}: ${Math.round(width)} × ${Math.round(height)}`] : [];
        }),
      );
    expect(small).toEqual([]);
  });
});
