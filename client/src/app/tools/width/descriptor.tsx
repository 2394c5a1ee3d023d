import { WidthIcon } from "../../ui/timeline/timeline-icons";
import { scaleAt } from "../../view/places";
import type { ToolDescriptor } from "../descriptor";
import { WidthTool } from "./width-tool";

export const WIDTH: ToolDescriptor<WidthTool> = {
  key: "W",
  label: ["Width", "Dicke"],
  title: ["Width: pinch around a limb, or tap it", "Dicke: einen Ast zwischen zwei Finger nehmen oder antippen"],
  Icon: WidthIcon,
  group: "shaping",
  make: ({ table, view, submit, next, unsettled, widths, girth }) =>
    new WidthTool({
      table,
      view,
      submit,
      newGesture: next,
      unsettled: () => unsettled("set_width"),
      widths,
      girth,
      scaleAt: (row) => scaleAt(view, view.placeOf(row)),
      placeOnGlass: (row) => view.projector()(view.placeOf(row)),
    }),
  hasViews: true,
  later: () => import("./later"),
};
