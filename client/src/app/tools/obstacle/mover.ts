import type { Mover, ToolKit } from "../descriptor";
import { ObstacleTool } from "./obstacle-tool";

/** Moves the obstacle that a finger comes down on. */
export function obstacleMover({ view, obstacles }: ToolKit): Mover {
  return new ObstacleTool({
    view,
    poseOf: (id) => obstacles.poseOf(id),
    move: (id, pose) => obstacles.move(id, pose),
    choose: (id) => {
      obstacles.chosen.value = id;
    },
    preview: (moved) => obstacles.preview(moved),
  });
}
