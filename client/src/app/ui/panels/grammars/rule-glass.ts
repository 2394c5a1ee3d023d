import { effect } from "@preact/signals";
import type { RefObject } from "preact";
import { useEffect } from "preact/hooks";
import { RowsOverlay } from "../../../../scene/overlay/rows-overlay";
import type { Grammars } from "../../../document/grammar/grammars-of";
import type { Studio } from "../../../studio";
import { PICK_TOLERANCE } from "../../../tools/tool";
import { say } from "../../../words/say";

/** Marks what a rule has made while somebody wants to know; a tap on a branch then looks at its rule. */
export function useRules(studio: Studio, { origins }: Grammars, layer: RefObject<HTMLElement | null>): void {
  const wanted = origins.wanted.value;
  useEffect(() => {
    const workspace = document.querySelector<HTMLElement>("main.workspace");
    if (!wanted || !workspace) {
      return undefined;
    }
    const glass = document.createElement("div");
    glass.className = "rule-glass";
    glass.addEventListener("click", ({ clientX, clientY }) => {
      const { left, top } = glass.getBoundingClientRect();
      const row = studio.stage.pickRow(clientX - left, clientY - top, PICK_TOLERANCE);
      const none = () => studio.toasts.show(say("grammars.rules.none"));
      if (row === null) {
        none();
        return;
      }
      origins.look(row, (line) => {
        if (line === null) {
          none();
          return;
        }
        requestAnimationFrame(() => layer.current?.querySelector("[data-looked]")?.scrollIntoView({ block: "center" }));
      });
    });
    workspace.querySelector("canvas")?.after(glass);
    let shown: RowsOverlay | null = null;
    const hide = () => {
      if (shown) {
        studio.stage.view?.removeOverlay(shown);
        shown = null;
      }
    };
    const stopMarking = effect(() => {
      const rows = origins.rows.value;
      hide();
      if (rows.length > 0) {
        shown = new RowsOverlay(rows, "marked");
        studio.stage.view?.addOverlay(shown);
      }
    });
    return () => {
      stopMarking();
      hide();
      glass.remove();
    };
  }, [studio, origins, wanted, layer]);
  // Who leaves the text wants to know no more.
  useEffect(
    () => () => {
      origins.wanted.value = false;
      origins.line.value = null;
    },
    [origins],
  );
}
