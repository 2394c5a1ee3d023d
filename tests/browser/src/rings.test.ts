import { expect, test } from "vitest";
import { ringHandles } from "../../../client/src/app/ui/overlays/ring-handles";
import { misses } from "./hits";
import type { Screen } from "./screens";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** Nothing is looked at here: the fewer pixels the sooner. */
const PORTRAIT: Screen = { width: 834, height: 1194, detail: 0.2 };
const MIDDLE = { x: 417, y: 500 };
/** The least that a ring is wide on the screen, and one around a trunk that is seen near by. */
const WIDTHS = [18, 140];
/** In which way limbs may lean. */
const LEANS = [0, 15, 30, 45, 60, 75, 90, -15, -30, -45, -60, -75];

/** The handles of a ring that is so wide on the screen, and inclined by so many degrees. */
function handles(width: number, degrees: number) {
  const angle = (degrees * Math.PI) / 180;
  const [x, y] = [(width / 2) * Math.cos(angle), (width / 2) * Math.sin(angle)];
  const ends = [
    [MIDDLE.x - x, MIDDLE.y - y],
    [MIDDLE.x + x, MIDDLE.y + y],
  ] as const;
  return ringHandles({ middle: [MIDDLE.x, MIDDLE.y], ends });
}

test("the handles of a ring are hit however its limb leans", async () => {
  const { tablet, at } = await workshop.stem(PORTRAIT);
  const { page } = tablet;
  await tablet.take("Width");
  await tablet.tapAt(at(0, 170));
  await page.getByLabel("Diameter in internodes").waitFor();
  // Another one beside it, which no frame moves to where the stem is.
  await page.locator(".width-widget").evaluate((shown: HTMLElement) => {
    const other = shown.cloneNode(true) as HTMLElement;
    shown.style.display = "none";
    other.classList.add("leaning");
    // It is hidden from readers of the screen, for whom the right one does the same; fingers pull it all the same.
    other.querySelector(".left")?.setAttribute("role", "slider");
    shown.after(other);
  });
  expect(await page.locator(".leaning :is([role=slider], .width-box)").count()).toBe(4);
  const faults: string[] = [];
  for (const width of WIDTHS) {
    for (const degrees of LEANS) {
      await page.locator(".leaning").evaluate(
        (ring: HTMLElement, places) => {
          for (const [name, value] of Object.entries(places)) ring.style.setProperty(name, value);
        },
        handles(width, degrees),
      );
      const where = `a ring ${width} wide, inclined by ${degrees}°`;
      faults.push(...(await misses(tablet, where, ".leaning")));
    }
  }
  expect(faults).toEqual([]);
});
