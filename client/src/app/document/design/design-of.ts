import type { Studio } from "../../studio";
import { DesignEditing } from "./design-editing";

const EDITINGS = new WeakMap<Studio, DesignEditing>();

/** The editing of designs on a page, from the first time that somebody asks for it on. */
export function designOf(studio: Studio): DesignEditing {
  const known = EDITINGS.get(studio);
  if (known) {
    return known;
  }
  const editing = new DesignEditing({
    design: studio.design,
    submit: (command) => studio.submit(command),
    newGesture: () => studio.link.next,
    unsettled: () => studio.link.unsettled("edit_design"),
    now: () => performance.now(),
    later: (run, milliseconds) => void setTimeout(run, milliseconds),
  });
  EDITINGS.set(studio, editing);
  return editing;
}
