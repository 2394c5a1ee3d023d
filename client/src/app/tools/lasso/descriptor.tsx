import { LassoIcon } from "../../ui/icons";
import type { ToolDescriptor } from "../descriptor";
import type { LassoTool } from "./lasso-tool";

export const LASSO: ToolDescriptor<LassoTool> = {
  key: "L",
  label: ["Lasso", "Lasso"],
  title: ["Lasso: draw the outline the tree grows to fill", "Lasso: den Umriss zeichnen, den der Baum ausfüllt"],
  Icon: LassoIcon,
  group: "drawing",
  choosesBranches: true,
  isSymmetric: true,
  hint: ({ settings, outlined }) =>
    outlined || settings.hasOutlined.value ? null : ["Draw the outline of a crown", "Zeichne den Umriss einer Krone"],
  make: async ({ view, submit, next, settings, bud, base, copies, outline, say }) => {
    const { LassoTool } = await import("./lasso-tool");
    return new LassoTool({
      view,
      submit,
      bud: () => bud.row.peek(),
      base,
      copies,
      taker: () => outline.taker,
      newGesture: next,
      depth: () => settings.lassoDepth.peek(),
      draw: (points, copies) => outline.draw(points, copies),
      sent: (places) => {
        settings.hasOutlined.value = true;
        outline.grow(places, next() - 1);
      },
      tooSmall: () => say("tools.outline-small"),
      refused: () => outline.clear(),
    });
  },
  later: () => import("./later"),
};
