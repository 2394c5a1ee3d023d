import { expect, test } from "vitest";
import type { Picture } from "./picture";
import { SMALL } from "./screens";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

/** An even wind along x, in which leaves do not flutter: a tree stands in it as it leans on average. */
const EVEN = { direction: 0, turbulence: 0, flutter: 0 };

/** How far to the right the leaves are that stand before the sky, as a share of the picture's width. */
function leavesOf({ width, height, pixels }: Picture): number {
  let [sum, count] = [0, 0];
  for (let y = Math.round(0.15 * height); y < 0.5 * height; y += 1) {
    for (let x = Math.round(0.2 * width); x < width; x += 1) {
      const [red, green, blue] = [0, 1, 2].map((part) => pixels[4 * (y * width + x) + part]!) as [
        number,
        number,
        number,
      ];
      if (green < red + 25 || green < blue + 25) continue;
      sum += x / width;
      count += 1;
    }
  }
  return count > 0 ? sum / count : 0;
}

test("a wall that is moved upwind of a tree shelters it at once", async () => {
  const { tablet, address } = await workshop.stem({ ...SMALL, watched: true });
  const blow = (speed: number) =>
    workshop.act(address, [{ kind: "set_appearance", appearance: { wind: { ...EVEN, speed } } }]);
  const at = (x: number) => ({ position: [x, 12, 0] });
  const leaves = async (name: string) => leavesOf(await tablet.glimpse(name));
  const shape = { kind: "box", size: [1, 24, 30] };
  await workshop.act(address, [{ kind: "place_obstacle", obstacle: { shape, pose: at(14) } }]);
  await tablet.untilQuiet();
  const upright = await leaves("98-shelter-calm");
  await blow(16);
  const leaning = { message: "it leans with the wind, whatever stands behind it" };
  await expect.poll(() => leaves("98-shelter-downwind"), leaning).toBeGreaterThan(upright + 0.04);
  const lean = (await leaves("98-shelter-open")) - upright;
  await workshop.act(address, [{ kind: "move_obstacle", id: 1, pose: at(-14) }]);
  const sheltered = { message: "it stands up behind a wall" };
  await expect.poll(() => leaves("98-shelter-upwind"), sheltered).toBeLessThan(upright + 0.5 * lean);
});
