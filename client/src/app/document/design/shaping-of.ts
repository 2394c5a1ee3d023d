import { computed } from "@preact/signals";
import { Shells } from "../../../scene/structure/shells";
import type { Viewport } from "../../../scene/viewport";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { designOf } from "./design-of";
import { Shaping } from "./shaping";

const SHAPINGS = new WeakMap<Studio, Shaping>();

/** Shaping by hand on a page, from the first time that somebody asks for it on. */
export function shapingOf(studio: Studio): Shaping {
  const known = SHAPINGS.get(studio);
  if (known) {
    return known;
  }
  let drawn: { readonly view: Viewport; readonly shells: Shells } | null = null;
  const shaping = new Shaping({
    editing: designOf(studio),
    design: studio.design,
    view: () => studio.stage.view,
    // A picture that was lost and made anew has none yet.
    shells: () => {
      const { view } = studio.stage;
      if (view && drawn?.view !== view) {
        drawn = { view, shells: new Shells(view.backstage) };
      }
      return view ? (drawn?.shells ?? null) : null;
    },
    mayChange: studio.rights.mayChange,
    connected: computed(() => studio.link.phase.value === "connected"),
    look: (of) => studio.link.tell({ type: "look_at_branch", ...(of === null ? {} : { of }) }),
    // Handles and shells stand where the tree grew.
    hold: () => {
      const letGo = [studio.stage.hold(), studio.stage.still()];
      return () => {
        for (const end of letGo) {
          end();
        }
      };
    },
    now: () => performance.now(),
    unfitted: (why) => studio.toasts.show(say(`structure.unfitted.${why}`)),
  });
  SHAPINGS.set(studio, shaping);
  return shaping;
}
