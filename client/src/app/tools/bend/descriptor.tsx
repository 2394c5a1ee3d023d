import { BendIcon } from "../../ui/timeline/timeline-icons";
import type { ToolDescriptor } from "../descriptor";
import type { BendTool } from "./bend-tool";

export const BEND: ToolDescriptor<BendTool> = {
  key: "N",
  label: ["Bend", "Biegen"],
  title: ["Bend: hold a branch's base and drag its end", "Biegen: den Astansatz halten und das Ende ziehen"],
  Icon: BendIcon,
  group: "shaping",
  make: async ({ table, view, submit, next, unsettled, settings, poses, say }) => {
    const [{ Bend }, { BendPoses }, { BendTool }] = await Promise.all([
      import("../../../scene/bend/bend"),
      import("./bend-poses"),
      import("./bend-tool"),
    ]);
    const bend = new BendTool({
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
    poses.attach(new BendPoses(table, view, bend));
    return bend;
  },
  hasViews: true,
  later: () => import("./later"),
};
