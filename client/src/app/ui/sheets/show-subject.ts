import type { PlaceName } from "../../help/help-places";
import type { Control, Subject } from "../../help/help-topics";
import type { Studio } from "../../studio";
import { softly } from "../../words/joints";
import { say } from "../../words/say";
import { unfold } from "../controls/section";
import { tab } from "../panels/architecture/tab";

/** How long something is pointed at, in milliseconds. */
const POINTED = 2600;
/** In so many frames what is to be pointed at is on the page, or never. */
const MOST_FRAMES = 30;

/** Shows what help speaks of: opens it, takes it up, or points at it. */
export function showSubject(studio: Studio, subject: Subject): void {
  if ("page" in subject) {
    open(subject.page, "_blank", "noopener");
    return;
  }
  studio.layout.sheet.value = "sheet" in subject ? subject.sheet : null;
  studio.layout.bare.value = false;
  if ("tour" in subject) {
    studio.tour.start();
  } else if ("tool" in subject) {
    studio.tools.choose(subject.tool);
    const { control } = subject;
    point(() =>
      control
        ? controlNamed(control)
        : document.querySelector('.side-bar .tool[aria-pressed="true"], .side-bar .tool.folded'),
    );
  } else if ("place" in subject) {
    if (subject.place === "timeline") {
      studio.settings.timelineOpen.value = true;
    }
    point(() => placeNamed(subject.place));
  } else if ("panel" in subject) {
    studio.layout.panel.value = subject.panel;
    tab.value = subject.tab ?? tab.peek();
    if (subject.control?.section !== undefined) {
      unfold(subject.control.section);
    }
    const { control } = subject;
    point(() => (control ? controlNamed(control) : document.querySelector(".drawer header h2")));
  }
}

/** A thing on the page; where it is folded into a menu, the menu. */
function placeNamed(place: PlaceName): Element | null {
  return document.querySelector(`[data-place="${place}"]`) ?? document.querySelector('[data-place="more"]');
}

/** A control of the panel that is pulled down or of the chosen tool: its name, which unfolds its sentence. */
function controlNamed({ label }: Control): Element | null {
  const names = [...document.querySelectorAll(":is(.drawer, .tool-options) .field-name > span:first-child")];
  const name = names.find(({ firstChild }) => firstChild?.textContent?.trim() === softly(say(label)));
  return name?.parentElement ?? null;
}

/** Has something seen for a while as soon as it is there. */
function point(find: () => Element | null, frames = MOST_FRAMES): void {
  requestAnimationFrame(() => {
    const found = find();
    if (found !== null) {
      found.scrollIntoView({ block: "center" });
      found.classList.add("pointed");
      setTimeout(() => found.classList.remove("pointed"), POINTED);
    } else if (frames > 0) {
      // What is still loaded is waited for.
      point(find, document.querySelector('[aria-busy="true"]') ? frames : frames - 1);
    }
  });
}
