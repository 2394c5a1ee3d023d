import { SeedIcon } from "../../ui/icons";
import type { ToolDescriptor } from "../descriptor";
import { SeedTool } from "./seed-tool";

export const SEED: ToolDescriptor<SeedTool> = {
  key: "P",
  label: ["Plant a seed", "Samen setzen"],
  title: ["Plant a seed: tap the ground", "Samen setzen: auf den Boden tippen"],
  Icon: SeedIcon,
  group: "drawing",
  atOnce: true,
  serves: "plant",
  keepsObstacles: true,
  hint: () => ["Tap the ground to plant a seed", "Tippe auf den Boden, um einen Samen zu setzen"],
  make: ({ view, submit, next, say }) =>
    new SeedTool({
      groundAt: (x, y) => view.pointOnLevel(x, y, [0, 0, 0]),
      submit,
      next,
      missed: () => say("tools.ground-missed"),
    }),
  later: () => import("./later"),
};
