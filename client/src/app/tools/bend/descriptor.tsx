import { BendIcon } from "../../ui/shaping-icons";
import type { ToolDescriptor } from "../descriptor";
import type { BendTool } from "./bend-tool";
import { OthersBends } from "./others-bends";

export const BEND: ToolDescriptor<BendTool> = {
  key: "N",
  label: ["Bend", "Biegen"],
  title: ["Bend: hold a branch's base and drag its end", "Biegen: den Astansatz halten und das Ende ziehen"],
  Icon: BendIcon,
  group: "shaping",
  serves: "bend",
  make: async ({ table, view, submit, next, unsettled, settings, say }) => {
    const [{ Bend }, { BendTool }] = await Promise.all([import("../../../scene/bend/bend"), import("./bend-tool")]);
    return new BendTool({
      table,
      view,
      submit,
      newBend: next,
      newGesture: next,
      unsettled,
      stretch: () => settings.stretch.peek(),
      solver: (nodes, radii, stretch) => new Bend(nodes, radii, stretch),
      say,
    });
  },
  ready: (bend, { table, view, bends }) => bends.attach(new OthersBends(table, view, bend)),
  hasViews: true,
  later: () => import("./later"),
};
