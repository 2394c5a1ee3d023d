import { expect, test } from "vitest";
import { LANDSCAPE, PHONE, type Screen } from "./screens";
import type { Tablet } from "./tablet";
import { way } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();
const UPRIGHT: Screen = { ...LANDSCAPE, width: 834, height: 1194 };

const button = (tablet: Tablet, name: string) => tablet.page.getByRole("button", { name, exact: true });
const handles = (tablet: Tablet) => tablet.page.locator('[data-handle][data-shown="true"]');

/** Where the handles are that a finger can hit, by their names. */
async function placesOf(tablet: Tablet): Promise<Map<string, { x: number; y: number }>> {
  await handles(tablet).first().waitFor();
  const found = await handles(tablet).evaluateAll((all) =>
    all.map((one) => {
      const { x, y, width, height } = one.getBoundingClientRect();
      return [(one as HTMLElement).dataset.handle ?? "", { x: x + width / 2, y: y + height / 2 }] as const;
    }),
  );
  return new Map(found);
}

/** A tablet on which a stem has grown with a limb to its right, and limbs can be shaped. */
async function withLimb(screen: Screen) {
  const { tablet, at } = await workshop.stem(screen);
  await tablet.swipe([way(at(0, 130), at(190, 240))]);
  await tablet.untilQuiet();
  await tablet.tap("Structure");
  await tablet.press(button(tablet, "Shape a limb"));
  await tablet.press(tablet.page.locator(".drawer header button"));
  await tablet.page.locator(".drawer").waitFor({ state: "detached" });
  // On a phone the panel lies over it.
  await tablet.page.getByText("Tap a limb of the tree.", { exact: true }).waitFor();
  return { tablet, at };
}

test.each<[string, Screen]>([
  ["on its side", LANDSCAPE],
  ["upright", UPRIGHT],
  ["on a phone", PHONE],
])("DS12: a finger gives a limb that grew another outline, and takes it back, %s", async (name, screen) => {
  const { tablet, at } = await withLimb(screen);
  const shown = (what: string) => tablet.show(`99-limbs-${name.replaceAll(" ", "-")}-${what}`);
  const before = await tablet.facts();

  // A tap shows the outline that the limb has.
  await tablet.tapAt(at(120, 200));
  await expect.poll(() => tablet.page.locator(".structure-bar-name").innerText()).toBe("Limb");
  await shown("tapped");
  const places = await placesOf(tablet);
  expect([...places.keys()].some((id) => id.startsWith("side-"))).toBe(true);

  // Its far end goes with the finger; when that is let go, the limb grows into what is there now.
  await tablet.press(button(tablet, "Way"));
  const tip = (await placesOf(tablet)).get("tip");
  if (!tip) throw new Error("its tip cannot be hit");
  await tablet.swipe([way(tip, { x: tip.x + 40, y: tip.y - 50 }, 8)]);
  const filled = await tablet.until("one deed more is done", ({ done }) => done === before.done + 1);
  expect(filled.operations.endsWith(" refill")).toBe(true);
  const grown = await tablet.untilQuiet();
  expect(grown.metamers).not.toBe(before.metamers);
  await shown("filled");
  const to = (await placesOf(tablet)).get("tip");
  expect(to?.y).toBeLessThan(tip.y - 30);

  // It is one step to take back, and the outline is that of before.
  await tablet.tap("Undo");
  await tablet.until("it is taken back", ({ metamers, done }) => metamers === before.metamers && done === before.done);
  await expect
    .poll(async () => {
      const back = (await placesOf(tablet)).get("tip");
      return back ? Math.hypot(back.x - tip.x, back.y - tip.y) : Number.POSITIVE_INFINITY;
    })
    .toBeLessThan(3);

  await tablet.press(button(tablet, "Done"));
  await tablet.page.locator(".structure-bar").waitFor({ state: "detached" });
});
