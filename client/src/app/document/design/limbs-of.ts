import { Shells } from "../../../scene/structure/shells";
import type { Viewport } from "../../../scene/viewport";
import type { Studio } from "../../studio";
import { PICK_TOLERANCE } from "../../tools/tool";
import { say } from "../../words/say";
import { LimbShaping } from "./limb-shaping";
import { shapingOf } from "./shaping-of";

const LIMBS = new WeakMap<Studio, LimbShaping>();

/** The shaping of limbs that grew on a page, from the first time that somebody asks for it on. */
export function limbsOf(studio: Studio): LimbShaping {
  const known = LIMBS.get(studio);
  if (known) {
    return known;
  }
  let drawn: { readonly view: Viewport; readonly shells: Shells } | null = null;
  const limbs = new LimbShaping({
    design: studio.design,
    isDesigning: shapingOf(studio).isOn,
    document: studio.document,
    finished: studio.finished,
    mayChange: studio.rights.mayChange,
    view: () => studio.stage.view,
    pick: (x, y) => studio.stage.pickRow(x, y, PICK_TOLERANCE),
    // A picture that was lost and made anew has none yet.
    shells: () => {
      const { view } = studio.stage;
      if (view && drawn?.view !== view) {
        drawn = { view, shells: new Shells(view.backstage) };
      }
      return view ? (drawn?.shells ?? null) : null;
    },
    look: (row) => studio.link.tell({ type: "look_at_limb", row }),
    submit: (command) => studio.submit(command),
    hold: () => {
      const letGo = [studio.stage.hold(), studio.stage.still()];
      return () => {
        for (const end of letGo) {
          end();
        }
      };
    },
    missed: () => studio.toasts.show(say("limbs.missed")),
  });
  LIMBS.set(studio, limbs);
  return limbs;
}
