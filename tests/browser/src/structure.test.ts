import { expect, test } from "vitest";
import { LANDSCAPE, type Screen } from "./screens";
import type { Tablet } from "./tablet";
import { way } from "./ways";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();
const UPRIGHT: Screen = { ...LANDSCAPE, width: 834, height: 1194 };

const button = (tablet: Tablet, name: string) => tablet.page.getByRole("button", { name, exact: true });

/** A tablet with the panel open, and a bonsai begun from its template. */
async function withBonsai(screen: Screen) {
  const { tablet } = await workshop.fresh(screen);
  await tablet.tap("Structure");
  await tablet.press(tablet.page.getByRole("button", { name: /^chokkan/ }));
  await tablet.until("the bonsai stands", ({ metamers }) => metamers > 100);
  return tablet;
}

test.each<[string, Screen]>([
  ["on its side", LANDSCAPE],
  ["upright", UPRIGHT],
])("a finger begins a bonsai, changes a limb and takes it back on a tablet %s", async (name, screen) => {
  const tablet = await withBonsai(screen);
  const before = (await tablet.facts()).metamers;
  await tablet.show(`99-structure-${name.replaceAll(" ", "-")}`);

  // The list unfolds from the plant to its limbs; the chosen one shows where its values come from.
  await tablet.press(button(tablet, "Limb 3"));
  const length = tablet.page.getByRole("slider", { name: "Length", exact: true });
  await length.waitFor();
  await length.scrollIntoViewIfNeeded();
  await tablet.untilSettled();
  const box = await tablet.boxOf(length);
  const at = (x: number) => ({ x: box.x + x * box.width, y: box.y + 0.5 * box.height });
  await tablet.swipe([way(at(0.33), at(0.75), 6)]);
  await tablet.until("the limb has grown longer", ({ metamers }) => metamers !== before);
  await expect.poll(() => tablet.page.locator(".structure-value[data-status=own]").count()).toBeGreaterThan(0);
  await tablet.show(`99-structure-${name.replaceAll(" ", "-")}-limb`);

  // One movement is one deed.
  await tablet.tap("Undo");
  await tablet.until("it is as it was", ({ metamers }) => metamers === before);
});

test.each<[string, Screen]>([
  ["on its side", LANDSCAPE],
  ["upright", UPRIGHT],
])("DS10: a tree that grew becomes a design on a tablet %s, and Undo brings it back", async (name, screen) => {
  const { tablet, address } = await workshop.fresh(screen);
  await workshop.act(address, [{ kind: "grow", steps: 9 }]);
  await tablet.until("a tree has grown", ({ metamers }) => metamers > 100);
  await tablet.untilSettled();
  const grown = (await tablet.facts()).metamers;
  await tablet.tap("Structure");
  await tablet.press(button(tablet, "From the tree"));
  await tablet.page.getByText(/^Fitted to what grew: \d+ % of the silhouette stayed\.$/).waitFor();
  await tablet.until("the design stands in its place", ({ metamers }) => metamers !== grown);
  await tablet.show(`99-structure-${name.replaceAll(" ", "-")}-fitted`);

  await tablet.tap("Undo");
  await tablet.until("it is as it grew", ({ metamers }) => metamers === grown);
});
