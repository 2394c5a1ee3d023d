import type { Command, Problem } from "../../wire/generated";
import type { ObstacleList } from "../document/obstacles/obstacle-list";
import type { TimelineControl } from "../document/timeline/timeline-control";
import type { Toasts } from "../page/toasts";
import { RequestFailed } from "../requests/request";
import type { BranchWork } from "../tools/branch/branch-work";
import type { ChosenBud } from "../tools/chosen-bud";
import type { Toolbox } from "../tools/toolbox";
import { say } from "../words/say";
import { explained } from "./explained";

/** The parts of a page that a refused command concerns. */
export interface RefusalTargets {
  readonly tools: Toolbox;
  readonly branches: BranchWork;
  readonly obstacles: ObstacleList;
  readonly time: TimelineControl;
  readonly toasts: Toasts;
  readonly bud: ChosenBud;
}

/** Undoes the previews of a command that the server refused, and shows the reason where the user does not know it yet. */
export function refused(page: RefusalTargets, problem: Problem, command?: Command): void {
  if (command?.kind === "go_to") {
    page.time.stop();
  }
  page.branches.refused(command);
  page.tools.refused(command);
  if (command?.kind.endsWith("_obstacle")) {
    page.obstacles.refused(command);
  }
  if (problem.reason === "branch-gone" && problem.field === "bud") {
    // It was shed, or someone went back to before it grew.
    page.tools.abandon();
    if (page.bud.row.peek() !== null) {
      page.bud.release();
      page.toasts.show(say("notices.bud-lost"));
    }
    return;
  }
  if (problem.reason === "stroke-gone") {
    // Someone went back in time, which ends every stroke; what was still in progress of this one is refused.
    if (page.tools.drawing.peek()) {
      page.toasts.show(say("notices.stroke-ended"));
    }
    page.tools.abandon();
    return;
  }
  if (problem.reason === "bend-gone") {
    // What was still in progress of a bend that was refused or given up says nothing new.
    return;
  }
  void explained(new RequestFailed(0, problem)).then((text) => page.toasts.show(text));
  console.warn("The server refused:", problem);
}
