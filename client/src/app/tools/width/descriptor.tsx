import { WidthIcon } from "../../ui/shaping-icons";
import { scaleAt } from "../../view/places";
import type { ToolDescriptor } from "../descriptor";
import type { WidthTool } from "./width-tool";

export const WIDTH: ToolDescriptor<WidthTool> = {
  key: "W",
  label: ["Width", "Dicke"],
  title: ["Width: pinch around a limb, or tap it", "Dicke: einen Ast zwischen zwei Finger nehmen oder antippen"],
  Icon: WidthIcon,
  group: "shaping",
  make: async ({ table, view, submit, next, unsettled, widths, girth }) => {
    const { WidthTool } = await import("./width-tool");
    return new WidthTool({
      table,
      view,
      submit,
      newGesture: next,
      unsettled: () => unsettled("set_width"),
      widths,
      girth,
      scaleAt: (row) => scaleAt(view, view.placeOf(row)),
      placeOnGlass: (row) => view.projector()(view.seenAt(row)),
    });
  },
  hasViews: true,
  later: () => import("./later"),
};
