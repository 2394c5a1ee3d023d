import { useEffect, useRef } from "preact/hooks";
import { accepted, type TreeFile, treeFiles } from "../../../library/tree-files";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { TransferChip } from "../../notices/transfer-chip";
import type { LibraryDesk } from "./library-desk";
import { ScanUnits } from "./scan-units";

/** Lets files be chosen that become trees, and says how far they are. */
export function OpenFile({ desk: { studio, section } }: { readonly desk: LibraryDesk }) {
  const input = useRef<HTMLInputElement>(null);
  useEffect(() => {
    // What was added before is in the list that is asked for.
    const before = treeFiles.added.peek();
    return treeFiles.added.subscribe((tree) => {
      if (tree !== null && tree !== before && section.name === "trees") {
        section.pages.begin(tree);
      }
    });
  }, [section]);
  return (
    <>
      <button
        type="button"
        class="small"
        disabled={treeFiles.transfer.progress.value !== null}
        onClick={() => input.current?.click()}
      >
        {say("library.open-file")}
      </button>
      <input
        ref={input}
        hidden
        type="file"
        multiple
        accept={accepted()}
        onChange={({ currentTarget }) => {
          void takeFiles(studio, currentTarget.files).then(() => {
            // The same file can then be chosen again.
            currentTarget.value = "";
          });
        }}
      />
      <ScanUnits studio={studio} onAgain={() => void takeAgain(studio)} />
      <TransferChip transfer={treeFiles.transfer} name="tree" />
    </>
  );
}

/** Puts files into the library. */
export function takeFiles(studio: Studio, files: FileList | null): Promise<void> {
  return take(studio, [...(files ?? [])]);
}

/** Puts the last scan into the library once more, in the units that are chosen now. */
function takeAgain(studio: Studio): Promise<void> {
  const scan = treeFiles.scan.peek();
  return take(studio, scan === null ? [] : [scan]);
}

function take(studio: Studio, files: readonly TreeFile[]): Promise<void> {
  return treeFiles.take(files, {
    show: (text, action) => studio.toasts.show(text, action),
    open: (tree) => void studio.trees.leave({ tree }),
  });
}
