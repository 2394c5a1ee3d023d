import type { Settings } from "../../page/settings";
import type { ToolDescriptor } from "../descriptor";
import { placeOf } from "./brush-radius";
import { BrushTool } from "./brush-tool";

export const BRUSH: ToolDescriptor<BrushTool> = {
  key: "B",
  label: ["Brush", "Pinsel"],
  title: ["Brush: the tree grows into the stroke", "Pinsel: Der Baum wächst in den Strich"],
  Icon: BrushSample,
  group: "drawing",
  atOnce: true,
  choosesBranches: true,
  growsIntoStrokes: true,
  usesRadius: true,
  isSymmetric: true,
  hint: ({ settings, empty }) =>
    empty && !settings.hasDrawn.value ? ["Draw upward from the seedling", "Zeichne vom Sämling nach oben"] : null,
  make: ({ view, submit, next, unsettledMoves, settings, bud, base, copies, trail }) =>
    new BrushTool({
      view,
      submit,
      next,
      trail,
      unsettledMoves,
      radius: () => settings.radius.peek(),
      pressureWidens: () => settings.pressureWidens.peek(),
      bud: () => bud.row.peek(),
      base,
      copies,
      drawn: () => {
        settings.hasDrawn.value = true;
      },
    }),
  later: () => import("./later"),
};

/** The brush itself, in small. */
function BrushSample({ settings }: { settings: Settings }) {
  const radius = settings.radius.value;
  return (
    <span class="brush-sample">
      <i style={{ "--size": `${radius === 0 ? 5 : 8 + 24 * placeOf(radius)}px` }} data-sketch={radius === 0} />
    </span>
  );
}
