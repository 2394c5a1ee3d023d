import type { Command, Problem } from "../../wire/generated";
import type { Studio } from "../studio";
import { say } from "../words/say";
import { plainly } from "./plain-words";

/** What follows from a command the server refused; a person is told where it is news to them. */
export function refused(studio: Studio, problem: Problem, command?: Command): void {
  if (command?.kind === "lasso") {
    studio.tools.outline.clear();
  }
  if (command?.kind === "go_to") {
    studio.time.stop();
  }
  studio.branches.refused(command);
  studio.tools.refused(command);
  if (command?.kind.endsWith("_obstacle")) {
    studio.obstacles.refused(command);
  }
  if (problem.code === "not_found" && problem.field === "bud") {
    studio.loseBud();
    return;
  }
  if (problem.code === "not_found" && problem.field === "stroke") {
    // Someone went back in time, which ends every stroke; what was still under way of this one is refused.
    if (studio.tools.drawing.peek()) {
      studio.toasts.show(say("notices.stroke-ended"));
    }
    studio.tools.abandon();
    return;
  }
  if (problem.code === "not_found" && problem.field === "bend") {
    // What was still under way of a bend that was refused or given up says nothing new.
    return;
  }
  studio.toasts.show(plainly(problem));
  console.warn("The server refused:", problem);
}
