import { expect, test } from "vitest";
import { type Picture, whole } from "./picture";
import type { Screen } from "./screens";
import type { Tablet } from "./tablet";
import { sessionOf, Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

const SMALL: Screen = { width: 720, height: 720, detail: 0.75 };
/** Leaves of limbs that no tree has, and bark that is hardly seen. */
const STRANGE = {
  edit: "set",
  of: "level 1",
  key: "material",
  value: { own: { bark: [0.1, 0.1, 4], leaves: [0.2, 0.1, 4] } },
};

/** Which share of a picture is blue and far from grey. */
function blue(picture: Picture): number {
  const { width, height } = whole(picture);
  let count = 0;
  for (let at = 0; at < 4 * width * height; at += 4) {
    const [red, green, blue] = [picture.pixels[at]!, picture.pixels[at + 1]!, picture.pixels[at + 2]!];
    if (blue > 1.5 * green && blue > 1.4 * red && blue > 40) count += 1;
  }
  return count / (width * height);
}

/** The picture on the glass, and that which the server makes. */
async function seen(tablet: Tablet, name: string): Promise<{ page: number; server: number }> {
  const { page } = tablet;
  const shown = await tablet.photograph(`99-colours-${name}`);
  const png = await page.request.get(
    `${workshop.server.address}/api/v1/sessions/${sessionOf(tablet)}/tree.png?size=360x360`,
  );
  expect(png.ok(), await png.text().catch(() => "")).toBe(true);
  return { page: blue(shown), server: blue(await workshop.darkroom.develop(await png.body())) };
}

test("colours that a design says of branches are seen on the glass and in the server's picture, and taken back", async () => {
  const address = await workshop.server.newSession(5);
  await workshop.act(address, [{ kind: "new_design", position: [0, 0, 0], template: "chokkan" }]);
  const tablet = await workshop.open(`${address}?yaw=0&pitch=8&zoom=1`, SMALL);
  await tablet.until("the bonsai stands", ({ metamers }) => metamers > 100);
  await tablet.untilQuiet();
  const plain = await seen(tablet, "plain");
  expect(plain.page).toBeLessThan(0.002);
  expect(plain.server).toBeLessThan(0.002);

  await workshop.act(address, [{ kind: "edit_design", edits: [STRANGE] }]);
  await tablet.untilQuiet();
  const dyed = await seen(tablet, "dyed");
  expect(dyed.page).toBeGreaterThan(0.02);
  expect(dyed.server).toBeGreaterThan(0.02);

  // Let go, it keeps them; whoever comes later sees them as well.
  await workshop.act(address, [{ kind: "release_design" }]);
  await tablet.page.reload({ waitUntil: "commit" });
  await tablet.until("all of it is back", ({ metamers, rows }) => metamers > 100 && rows >= metamers);
  await tablet.untilQuiet();
  expect((await seen(tablet, "let-go")).page).toBeGreaterThan(0.02);

  await workshop.act(address, [{ kind: "undo" }, { kind: "undo" }]);
  await tablet.untilQuiet();
  const back = await seen(tablet, "back");
  expect(back.page).toBeLessThan(0.002);
  expect(back.server).toBeLessThan(0.002);
});
