import { say } from "../../words/say";

/** A number of steps in words. */
export function stepsOf(steps: number): string {
  return say(steps === 0 ? "timeline.steps.none" : steps === 1 ? "timeline.steps.one" : "timeline.steps.many", {
    count: steps,
  });
}
