import { useEffect, useRef } from "preact/hooks";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { isGrammarFile } from "../panels/grammars/grammar-endings";
import { takeFiles } from "../sheets/library/open-file";

/** Takes files that are dropped anywhere on the page into the library, which it opens. */
export function FileDrop({ studio }: { readonly studio: Studio }) {
  const hint = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const stop = new AbortController();
    const show = (shown: boolean) => hint.current?.togglePopover(shown);
    const carriesFiles = ({ dataTransfer }: DragEvent) => dataTransfer?.types.includes("Files") === true;
    addEventListener(
      "dragover",
      (event) => {
        if (carriesFiles(event)) {
          event.preventDefault();
          show(true);
        }
      },
      stop,
    );
    // It has left the page, and not only gone from one part of it to the next.
    addEventListener("dragleave", ({ relatedTarget }) => relatedTarget === null && show(false), stop);
    addEventListener(
      "drop",
      (event) => {
        if (carriesFiles(event)) {
          event.preventDefault();
          show(false);
          const files = [...(event.dataTransfer?.files ?? [])];
          const grammar = files.find(isGrammarFile);
          if (grammar) {
            studio.layout.panel.value = "grammars";
            void import("../panels/grammars/dropped").then(({ takeGrammar }) => takeGrammar(studio, grammar));
            return;
          }
          studio.layout.section.value = "trees";
          studio.layout.sheet.value = "library";
          void takeFiles(studio, event.dataTransfer?.files ?? null);
        }
      },
      stop,
    );
    return () => stop.abort();
  }, [studio]);
  // Only what is shown like this lies over a sheet.
  return (
    <div class="file-drop" ref={hint} popover="manual">
      {say("library.drop-file")}
    </div>
  );
}
