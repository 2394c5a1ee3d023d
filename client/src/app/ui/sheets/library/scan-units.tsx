import { SCAN_UNITS, type ScanUnit } from "../../../library/scan-units";
import { treeFiles } from "../../../library/tree-files";
import { say } from "../../../words/say";
import { Pick } from "./pick";

const UNITS = Object.keys(SCAN_UNITS) as readonly ScanUnit[];

/** Once a scan was taken: in which units, and a way to take it again in others. */
export function ScanUnits({ onAgain }: { readonly onAgain: () => void }) {
  const { units, scan, transfer } = treeFiles;
  if (scan.value === null) return null;
  const { length, diameter } = units.value;
  return (
    <fieldset class="scan-units" aria-label={say("library.scan", { file: scan.value.name })}>
      <Pick
        label={say("library.scan.lengths")}
        value={length}
        options={UNITS.map((unit) => [unit, say("library.scan.lengths-in", { unit })] as const)}
        onPick={(picked) => {
          units.value = { length: picked, diameter };
        }}
      />
      <Pick
        label={say("library.scan.diameters")}
        value={diameter}
        options={[
          ["same", say("library.scan.diameters-same")] as const,
          ...UNITS.map((unit) => [unit, say("library.scan.diameters-in", { unit })] as const),
        ]}
        onPick={(picked) => {
          units.value = { length, diameter: picked };
        }}
      />
      <button type="button" class="small" disabled={transfer.progress.value !== null} onClick={onAgain}>
        {say("library.scan.again", { file: scan.value.name })}
      </button>
    </fieldset>
  );
}
