import type { Species } from "../../../../wire/generated";
import { speciesName } from "../../../document/species/species-choice";
import { SCAN_UNITS, type ScanUnit } from "../../../library/scan-units";
import { treeFiles } from "../../../library/tree-files";
import type { Studio } from "../../../studio";
import { language, say } from "../../../words/say";
import { useSpecies } from "../../panels/architecture/species-list";
import { Pick } from "./pick";

const UNITS = Object.keys(SCAN_UNITS) as readonly ScanUnit[];

interface ScanUnitsProps {
  readonly studio: Studio;
  readonly onAgain: () => void;
}

/** Once a scan was taken: in which units and as which species, and a way to take it again otherwise. */
export function ScanUnits({ studio, onAgain }: ScanUnitsProps) {
  const { units, scan, transfer } = treeFiles;
  const species = useSpecies(studio);
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
      {species !== null && (
        <Pick
          label={say("library.scan.species")}
          value={treeFiles.species.value}
          options={[["", say("library.scan.species-own")] as const, ...namesOf(species)]}
          onPick={(picked) => {
            treeFiles.species.value = picked;
          }}
        />
      )}
      <button type="button" class="small" disabled={transfer.progress.value !== null} onClick={onAgain}>
        {say("library.scan.again", { file: scan.value.name })}
      </button>
    </fieldset>
  );
}

/** All species by their names, in the order of these. */
function namesOf(species: readonly Species[]): readonly (readonly [string, string])[] {
  const { compare } = new Intl.Collator(language.value);
  return species.map((one) => [one.slug, speciesName(one)] as const).sort(([, a], [, b]) => compare(a, b));
}
