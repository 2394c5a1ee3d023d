import { computed } from "@preact/signals";
import { Air } from "../../../scene/motion/air";
import { ELSEWHERE, type Hand } from "../../../scene/motion/hand";
import { SharedClock } from "../../../scene/motion/shared-clock";
import { typing } from "../../input/keyboard";
import type { Studio } from "../../studio";
import { WindControl } from "./wind-control";

const WINDS = new WeakMap<Studio, WindControl>();
/** The key that holds what moves and lets it go. */
const KEY = "a";

/** The wind on a page, from the first time on that it blows or somebody asks for it. */
export function windOf(studio: Studio): WindControl {
  const known = WINDS.get(studio);
  if (known) {
    return known;
  }
  const clock = new SharedClock(
    () => performance.now() / 1000,
    () => studio.serverTime.read() / 1000,
  );
  const wind = new WindControl({
    settings: computed(() => studio.appearance.value.wind),
    told: studio.windTold,
    drag: (patch) => studio.looks.drag({ wind: patch }),
    commit: (patch) => studio.looks.commit({ wind: patch }),
    parameters: studio.parameters,
    leaves: () => studio.appearance.value.leaves.shape,
    touched: () => handOn(studio),
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

/** What this page's user is at: what fingers are on, and the branch that is held for turning; all of it where the tree is to stand still. */
function handOn({ tools, branches, stage }: Studio): Hand | null {
  if (stage.stilled.value) {
    return { rows: [], elsewhere: 0 };
  }
  const [touched, held] = [tools.touched.value, branches.held.row.value];
  return held === null ? touched : { elsewhere: ELSEWHERE, ...touched, rows: [...(touched?.rows ?? []), held] };
}
