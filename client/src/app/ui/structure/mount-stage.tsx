import { effect } from "@preact/signals";
import { render } from "preact";
import { ROOT } from "../../document/design/design-model";
import { designOf } from "../../document/design/design-of";
import { limbsOf } from "../../document/design/limbs-of";
import { shapingOf } from "../../document/design/shaping-of";
import type { Studio } from "../../studio";
import { comeTo } from "./come-to";
import { LimbStage } from "./limb-stage";
import { StructureStage } from "./structure-stage";

const MOUNTED = new WeakSet<Studio>();

/**
 * Puts over the picture what shapes designs by hand, once. It stays there when the panel is closed, for on a phone there is
 * no room for both; another tool ends it.
 */
export function mountStage(studio: Studio): void {
  const workspace = document.querySelector<HTMLElement>(".workspace");
  if (MOUNTED.has(studio) || !workspace) {
    return;
  }
  MOUNTED.add(studio);
  const [shaping, limbs] = [shapingOf(studio), limbsOf(studio)];
  const host = document.createElement("div");
  host.className = "structure-stage";
  workspace.append(host);
  render(
    <>
      <StructureStage studio={studio} shaping={shaping} />
      <LimbStage studio={studio} limbs={limbs} />
    </>,
    host,
  );
  effect(() => {
    if (studio.layout.panel.value === "structure") {
      shaping.wanted.value = true;
    }
  });
  // A tree that somebody begins here stands in sight above the bar.
  const editing = designOf(studio);
  effect(() => {
    if (editing.isDescribed()) {
      editing.showDescribed();
    }
  });
  let begun = editing.begun.peek();
  let former = studio.design.placed.peek();
  effect(() => {
    const [now, placed] = [editing.begun.value, studio.design.placed.value];
    const stem = shaping.shapes.value.get(ROOT) ?? null;
    if (now !== begun && stem && placed !== former) {
      begun = now;
      comeTo(studio, stem);
    }
    if (now === begun) {
      former = placed;
    }
  });
  let before = studio.tools.chosen.peek();
  effect(() => {
    const tool = studio.tools.chosen.value;
    if (tool !== before) {
      before = tool;
      shaping.wanted.value = false;
      limbs.wanted.value = false;
    }
  });
  effect(() => {
    workspace.dataset.shaping = String(shaping.isOn.value || limbs.isOn.value);
  });
}
