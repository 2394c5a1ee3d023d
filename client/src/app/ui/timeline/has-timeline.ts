import type { Timeline } from "../../../wire/generated";
import type { Studio } from "../../studio";

/** Whether the strip lies along the bottom; who only looks does not travel. */
export function hasTimeline(studio: Studio): boolean {
  if (studio.link.replaying.value) {
    return true;
  }
  return (
    studio.rights.mayChange.value && isWorthShowing(studio.time.timeline.value) && studio.settings.timelineOpen.value
  );
}

/** Before anything was done there is nowhere to travel. */
export function isWorthShowing(timeline: Timeline | null): timeline is Timeline {
  return timeline !== null && (timeline.operations.length > 0 || timeline.futures.length > 0);
}
