import { TurnIcon } from "../../ui/shaping-icons";
import type { ToolDescriptor } from "../descriptor";
import type { BranchTool } from "./branch-tool";

export const BRANCH: ToolDescriptor<BranchTool> = {
  key: "T",
  label: ["Branch", "Ast"],
  title: ["Branch: turn, move and copy whole branches", "Ast: ganze Äste drehen, versetzen und kopieren"],
  Icon: TurnIcon,
  group: "shaping",
  make: async ({ view, branch, say }) => new (await import("./branch-tool")).BranchTool({ view, branch, say }),
  hasViews: true,
  later: () => import("./later"),
};
