import { expect, test } from "vitest";
import { misses } from "./hits";
import { SMALL } from "./screens";
import { Workshop } from "./workshop";

const workshop = Workshop.forThisFile();

test("a control that something lies over, that is too small, or that a press does not get to, is told of", async () => {
  const { tablet } = await workshop.fresh(SMALL);
  await tablet.page.setContent(
    [
      '<div style="height: 300px; overflow: auto">',
      '<button style="margin: 100px; width: 60px; height: 60px">Free</button><br>',
      '<button style="margin: 400px 100px; width: 60px; height: 30px">Flat</button><br>',
      '<span style="position: relative"><button style="width: 60px; height: 60px">Under</button>',
      '<i style="position: absolute; inset: -20px">Over</i></span></div>',
      '<label style="display: block; height: 60px"><input type="checkbox" style="width: 1px">Its label</label>',
    ].join(""),
  );
  expect(await misses(tablet, "here")).toEqual([
    "here: button.null “Flat”: 21 above is div.null “FreeFlatUnderOver” (60.0 × 30.0)",
    "here: button.null “Flat”: 21 below is div.null “FreeFlatUnderOver” (60.0 × 30.0)",
    ...["at its middle", "21 to the left", "21 to the right", "21 above", "21 below"].map(
      (place) => `here: button.null “Under”: ${place} is i.null “Over” (60.0 × 60.0)`,
    ),
    expect.stringMatching(/^here: button.null “Under”: a press at .* hits i.null “Over”$/),
  ]);
  // It is out of reach as soon as it has been looked at.
  await tablet.page.setContent('<button style="width: 60px; height: 60px">Late</button>');
  await tablet.page.evaluate(() => {
    const find = document.elementFromPoint.bind(document);
    document.elementFromPoint = (x, y) => {
      setTimeout(() => document.querySelector("button")!.style.setProperty("pointer-events", "none"));
      return find(x, y);
    };
  });
  expect(await misses(tablet, "there")).toEqual([
    expect.stringMatching(/^there: button.null “Late”: a press at .* hits /),
  ]);
});
