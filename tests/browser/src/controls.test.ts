import { expect, test } from "vitest";
import { SMALL } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import { openPart, PARTS } from "./visits";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** The names of all fields of the panel, and what is wrong with what can be used in it. */
function survey(tablet: Tablet): Promise<{ readonly names: string[]; readonly faults: string[] }> {
  return tablet.page.evaluate(() => {
    const faults: string[] = [];
    const text = (element: Element | null | undefined) => element?.textContent?.trim() ?? "";
    const fields = [...document.querySelectorAll<HTMLElement>(".drawer :is(.control, .widget-value)")];
    const names = fields.map((field) => text(field.querySelector(".field-name span")));
    for (const [i, field] of fields.entries()) {
      const name = names[i];
      const asked = field.querySelector(".field-name");
      if (name === "") faults.push(`no name: ${field.innerHTML.slice(0, 80)}`);
      if ((asked?.getAttribute("title") ?? "").length < 12) faults.push(`${name}: no help`);
      if (!document.getElementById(asked?.getAttribute("aria-controls") ?? ""))
        faults.push(`${name}: help has no place`);
      if (!field.querySelector("input, [role=slider], [role=radiogroup]")) faults.push(`${name}: nothing to use`);
    }
    const used = ':is(input, select, [role="slider"], [role="radiogroup"])';
    for (const control of document.querySelectorAll<HTMLElement>(`.drawer ${used}`)) {
      const said = control.getAttribute("aria-label") ?? "";
      // On the picture of the brush its radius is pulled by the rim.
      const label = said === "Rim of the brush" ? "Radius" : said;
      // The arrow on the sketch stands above every tab; its field is on one of them.
      if (control.closest(".sketch") && !names.some((name) => name.startsWith(label))) continue;
      if (control.closest('[role="radiogroup"]') && control.localName === "input") continue;
      if (label === "") faults.push(`no label: ${control.outerHTML.slice(0, 80)}`);
      // A grip or dial is another way to set what a field beside it tells of.
      const field = control.closest(".control, .widget-value");
      const widget = control.closest(".widget, .architecture");
      const twin = names.some((name) => name.startsWith(label) || label.startsWith(name));
      if (!field && !twin && !widget?.querySelector(".widget-help")) faults.push(`${label}: belongs to no field`);
      const isNumber = control.matches('input[type="range"], [role="slider"]');
      const holder = field ?? fields.find((_, i) => names[i]?.startsWith(label)) ?? widget;
      if (isNumber && !holder?.querySelector('.typed input[type="text"]')) faults.push(`${label}: cannot be typed`);
    }
    return { names, faults };
  });
}

/** The field of a name. */
function fieldOf(tablet: Tablet, name: string) {
  const exactly = new RegExp(`^${name.replace(/[.*+?^${}()|[\]\\]/g, "\\$&")}$`);
  const named = tablet.page.locator(".field-name span", { hasText: exactly });
  return tablet.page.locator(".drawer :is(.control, .widget-value)").filter({ has: named });
}

/** Sets a field to something else; gives false where it does not take it. */
function change(tablet: Tablet, name: string): Promise<boolean> {
  return tablet.page.evaluate(async (name) => {
    const frame = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    // Where it stands may change with what it is set to.
    const field = () =>
      [...document.querySelectorAll<HTMLElement>(".drawer :is(.control, .widget-value)")].find(
        (one) => one.querySelector(".field-name span")?.textContent?.trim() === name,
      )!;
    const other = field().querySelector<HTMLElement>(
      'input[type="radio"]:not(:checked), .colour-dot[aria-pressed="false"], input[type="checkbox"]',
    );
    if (other) {
      other.click();
      await frame();
    } else {
      for (const key of ["ArrowUp", "ArrowDown", "ArrowDown"]) {
        const typed = field().querySelector<HTMLInputElement>(".typed input")!;
        typed.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }));
        await frame();
        if (field().querySelector(".field-reset")) break;
      }
    }
    return field().querySelector(".field-reset") !== null;
  }, name);
}

test("every control has a name, a sentence of help, a value to type", async () => {
  const { tablet } = await workshop.fresh(SMALL);
  for (const part of PARTS) {
    await openPart(tablet, part);
    const { names, faults } = await survey(tablet);
    const where = `${part.panel} ${part.tab ?? ""}`;
    expect(faults, where).toEqual([]);
    expect(names.length, `${where}: ${names}`).toBeGreaterThanOrEqual(part.least);
    expect(new Set(names).size, where).toBe(names.length);
    if (part.tab === "Form") expect(names, "the arrow on the sketch has a field").toContain("Set-point angle θ");
  }
});

test("every control can be reset once it is changed", async () => {
  const { tablet } = await workshop.fresh(SMALL);
  const reset = tablet.page.locator(".drawer .field-reset");
  for (const part of PARTS) {
    await openPart(tablet, part);
    const { names } = await survey(tablet);
    for (const name of names) {
      const where = `${part.panel}: ${name}`;
      const field = fieldOf(tablet, name);
      // What the part picked is changed as it is; all else begins as it was.
      if ((await field.locator(".field-reset").count()) === 0) {
        expect(await change(tablet, name), `${where} can be changed`).toBe(true);
      }
      if (part.picks?.some((pick) => PICKED[name] === pick)) continue;
      await field.locator(".field-reset").evaluate((button: HTMLElement) => button.click());
      await until(`${where} is as it was`, async () => (await field.locator(".field-reset").count()) === 0);
    }
    const left = (part.picks ?? []).length;
    await until(`${part.panel} is as it was`, async () => (await reset.count()) <= left);
    // One after the other: the next is the first only once the one before it has gone.
    for (let rest = await reset.count(); rest > 0; rest--) {
      await reset.first().evaluate((button: HTMLElement) => button.click());
      await until(`${rest - 1} of ${part.panel} are left`, async () => (await reset.count()) < rest);
    }
  }
});

/** Fields that a part needs as it picked them. */
const PICKED: Readonly<Record<string, string>> = {
  "Vigor model": "Priority",
  "Kind of flower": "Rosette",
  "Kind of fruit": "Cone",
  Sky: "Studio",
};

test("a species that is picked is what resets go back to", async () => {
  const { tablet } = await workshop.fresh(SMALL);
  const { page } = tablet;
  await tablet.tap("Architecture");
  await tablet.turnTo("Species");
  await page.locator('[data-species="birch"]').tap();
  await tablet.untilQuiet();
  for (const part of PARTS.filter(({ picks }) => picks === undefined || picks.includes("Rosette"))) {
    await openPart(tablet, { panel: part.panel, ...(part.tab ? { tab: part.tab } : {}), least: 0 });
    const resets = () => page.locator(".drawer .field-reset").count();
    await expect.poll(resets, { message: part.panel }).toBe(0);
  }
  await openPart(tablet, { panel: "Branches", least: 0 });
  const papery = () => page.getByRole("radio", { name: "Papery" }).isChecked();
  await expect.poll(papery).toBe(true);
  expect(await change(tablet, "Kind of bark")).toBe(true);
  await tablet.tap("Reset Kind of bark");
  await until("it is the birch’s bark", papery);
});

test("the slider of shedding has most of its travel where most happens, and all of the range", async () => {
  const { tablet } = await workshop.fresh(SMALL);
  const { page } = tablet;
  await openPart(tablet, { panel: "Architecture", tab: "Growth", least: 0 });
  const slider = page.getByRole("slider", { name: "Shedding", exact: true });
  const typed = page.getByLabel("Shedding: value", { exact: true });
  const shown = async () => Number(await typed.inputValue());
  const shows = (value: number) => expect.poll(shown).toBe(value);
  await shows(0);
  for (const [key, value] of [
    ["ArrowRight", 0.01],
    ["PageUp", 0.11],
    ["ArrowLeft", 0.1],
    ["End", 1],
    ["Home", 0],
  ] as const) {
    await slider.press(key);
    await shows(value);
  }
  await slider.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await tablet.boxOf(slider);
  // On an even track these places would be their values.
  for (const [place, least, most] of [
    [0.25, 0.28, 0.4],
    [0.5, 0.42, 0.52],
    [0.7, 0.52, 0.62],
  ] as const) {
    await tablet.tapAt({ x: x + place * width, y: y + height / 2 });
    await expect.poll(shown, { message: `at ${place}` }).toBeGreaterThan(least);
    expect(await shown(), `at ${place}`).toBeLessThan(most);
  }
  await typed.fill("0.9");
  await typed.press("Enter");
  await shows(0.9);
  await tablet.untilQuiet();
  await page.reload();
  await tablet.untilReady();
  await openPart(tablet, { panel: "Architecture", tab: "Growth", least: 0 });
  await shows(0.9);
});
