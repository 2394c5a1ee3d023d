import { TurnIcon } from "../../ui/timeline/timeline-icons";
import type { ToolDescriptor } from "../descriptor";
import { BranchTool } from "./branch-tool";

export const BRANCH: ToolDescriptor<BranchTool> = {
  key: "T",
  label: ["Branch", "Ast"],
  title: ["Branch: turn, move and copy whole branches", "Ast: ganze Äste drehen, versetzen und kopieren"],
  Icon: TurnIcon,
  group: "shaping",
  make: ({ view, branch, say }) => new BranchTool({ view, branch, say }),
  hasViews: true,
  later: () => import("./later"),
};
