import { Air } from "../../../scene/motion/air";
import { SharedClock } from "../../../scene/motion/shared-clock";
import { typing } from "../../input/keyboard";
import type { Studio } from "../../studio";
import { WindControl } from "./wind-control";

const WINDS = new WeakMap<Studio, WindControl>();
/** The key that holds what moves and lets it go. */
const KEY = "a";

/** The wind on a page, from the first time that somebody asks for it on. */
export function windOf(studio: Studio): WindControl {
  const known = WINDS.get(studio);
  if (known) {
    return known;
  }
  // Clocks of devices are set by the same time, so that all see the same gust.
  const clock = new SharedClock(
    () => performance.now() / 1000,
    () => Date.now() / 1000,
  );
  const wind = new WindControl({
    parameters: studio.parameters,
    leaves: () => studio.appearance.value.leaves.shape,
    touched: () => studio.tools.drawing.value || studio.branches.held.row.value !== null,
    enliven: (make) => studio.stage.enliven(make),
    air: (stage) => new Air(stage, clock),
    calmly: matchMedia("(prefers-reduced-motion: reduce)").matches,
  });
  WINDS.set(studio, wind);
  addEventListener("keydown", (event) => {
    const isMeant = event.key.toLowerCase() === KEY && !event.ctrlKey && !event.metaKey && !event.repeat;
    if (isMeant && studio.layout.sheet.peek() === null && !typing(event.target)) {
      wind.toggle();
    }
  });
  return wind;
}
