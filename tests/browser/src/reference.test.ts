import { beforeAll, describe, expect, test } from "vitest";
import { compare, distance, keep, TOLERANCE, within, writes } from "./reference";
import { LANDSCAPE, type Screen } from "./screens";
import { until } from "./server";
import type { Tablet } from "./tablet";
import { pullDown } from "./visits";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

const PORTRAIT: Screen = { width: 834, height: 1194, detail: 0.5 };
/** The tree from the front and a little above, the same on every machine. */
const VIEW = "?yaw=20&pitch=8&zoom=0.9";
const TREE = [
  { kind: "set_parameters", parameters: { leaves_per_node: 3, trunk_upward: true } },
  { kind: "grow", steps: 12 },
];

let address = "";

beforeAll(async () => {
  address = await workshop.server.newSession(5);
  await workshop.act(address, TREE);
});

/** A tablet that looks at the tree. */
async function looking(screen: Screen): Promise<Tablet> {
  const tablet = await workshop.open(address + VIEW, screen);
  await tablet.until("the tree is there", ({ metamers, rows }) => metamers > 100 && rows >= metamers);
  await tablet.untilQuiet();
  return tablet;
}

/** That the page looks as it is known to, and nothing of it is missing. */
async function expectKnown(tablet: Tablet, name: string): Promise<void> {
  const picture = await tablet.photograph(`reference-${name}`);
  if (writes) await keep(workshop.darkroom, picture, name);
  const apart = await compare(workshop.darkroom, picture, name);
  expect(within(apart), `${name} differs by ${JSON.stringify(apart)}, of ${JSON.stringify(TOLERANCE)}`).toBe(true);
}

/** The barks of the panel have been painted, one after the other. */
async function untilPainted(tablet: Tablet): Promise<void> {
  const barks = tablet.page.locator(".bark-picture canvas");
  await until("all barks are painted", () =>
    barks.evaluateAll((canvases: HTMLCanvasElement[]) =>
      canvases.every((canvas) => canvas.getContext("2d")!.getImageData(0, 0, 1, 1).data[3] === 255),
    ),
  );
}

describe("pictures as they are known", () => {
  test("the workspace with a tree, upright too", async () => {
    await expectKnown(await looking(LANDSCAPE), "landscape");
    await expectKnown(await looking(PORTRAIT), "portrait");
  });

  test("each panel beside the tree", async () => {
    const tablet = await looking(LANDSCAPE);
    for (const panel of ["Architecture", "Brush", "Leaves", "Branches", "Background"]) {
      await pullDown(tablet, panel);
      if (panel === "Architecture") {
        // Pictures of species come when they come.
        await tablet.turnTo("Form");
        await tablet.page.locator('.schematic[data-grown="true"]').waitFor();
      }
      await untilPainted(tablet);
      await expectKnown(tablet, panel.toLowerCase());
      await tablet.tap(panel);
      await tablet.page.locator(".drawer").waitFor({ state: "detached" });
    }
  });

  test("light and order in false colours", async () => {
    const tablet = await looking(LANDSCAPE);
    for (const [mode, name] of [
      ["Light", "exposure"],
      ["Order", "order"],
      ["Skeleton", "skeleton"],
    ] as const) {
      await tablet.tap("Way of drawing");
      await tablet.page.getByRole("button", { name: mode, exact: true }).tap();
      await tablet.page.getByRole("region", { name: mode, exact: true }).waitFor();
      await expectKnown(tablet, name);
    }
  });

  test("a black, an empty and another picture are told", async () => {
    const tablet = await looking(LANDSCAPE);
    const tree = await tablet.photograph("reference-told");
    const black = { ...tree, pixels: tree.pixels.map((value, i) => (i % 4 === 3 ? value : 0)) };
    expect(within(await compare(workshop.darkroom, black, "landscape"))).toBe(false);
    const { tablet: bare } = await workshop.fresh(LANDSCAPE);
    const empty = await bare.photograph("reference-empty");
    expect(within(await compare(workshop.darkroom, empty, "landscape"))).toBe(false);
    expect(within(await compare(workshop.darkroom, tree, "portrait"))).toBe(false);
    expect(distance(tree, tree)).toEqual({ mean: 0, worst: 0 });
  });
});
