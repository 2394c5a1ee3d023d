import { PruneIcon } from "../../ui/shaping-icons";
import type { ToolDescriptor } from "../descriptor";
import { PruneTool } from "./prune-tool";

export const PRUNE: ToolDescriptor<PruneTool> = {
  key: "X",
  label: ["Prune", "Schneiden"],
  title: [
    "Prune: tap branches, or draw a line through them",
    "Schneiden: Äste antippen oder eine Linie hindurchziehen",
  ],
  Icon: PruneIcon,
  group: "shaping",
  atOnce: true,
  serves: "cut",
  stillsTree: true,
  make: ({ table, view, submit, unsettled, widths, say, predict }) =>
    new PruneTool({ table, view, submit, unsettled, limits: () => widths.rows.peek(), say, predict }),
  hasViews: true,
  later: () => import("./later"),
};
