import type { Tablet } from "./tablet";
import type { Point } from "./ways";

/** Where the axis of the chosen branch of a design is on the glass, from its base to its tip. */
export async function axisOf(tablet: Tablet): Promise<readonly Point[]> {
  return tablet.page.locator(".structure-stage-axis").evaluate((line) => {
    const { left, top } = (line as SVGPolylineElement).ownerSVGElement?.getBoundingClientRect() ?? { left: 0, top: 0 };
    return [...(line as SVGPolylineElement).points].map(({ x, y }) => ({ x: x + left, y: y + top }));
  });
}
