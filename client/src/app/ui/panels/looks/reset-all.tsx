import type { Part } from "../../../document/appearance/look-numbers";
import { alike } from "../../../document/draft";
import type { DEFAULTS } from "../../../document/growth/growth-parameters";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { ResetIcon } from "../../controls/icons";
import { standardLooks, standardOf, useSpecies } from "../architecture/species-list";

type ParameterName = keyof typeof DEFAULTS;

interface ResetAllProps {
  readonly studio: Studio;
  /** The sections of the appearance that a panel sets. */
  readonly parts: readonly Part[];
  /** The parameters of growth that it sets. */
  readonly parameters?: readonly ParameterName[];
}

/** Puts all that a panel sets back to what the species has, else a session begins with; one undo brings it back. */
export function ResetAll({ studio, parts, parameters = [] }: ResetAllProps) {
  useSpecies(studio);
  const [looksThen, grownThen] = [standardLooks(studio), standardOf(studio)];
  const now = studio.appearance.value;
  const growing = studio.parameters.value;
  const looks = parts.filter((part) => !alike(now[part], looksThen[part]));
  const grown = growing === null ? [] : parameters.filter((name) => !alike(growing[name], grownThen[name]));
  return (
    <button
      type="button"
      class="reset-all"
      disabled={looks.length + grown.length === 0}
      onClick={() => {
        const gesture = studio.link.next;
        if (looks.length > 0) {
          studio.looks.commit(Object.fromEntries(looks.map((part) => [part, looksThen[part]])), gesture);
        }
        if (grown.length > 0) {
          studio.growing.commit(Object.fromEntries(grown.map((name) => [name, grownThen[name]])), gesture);
        }
      }}
    >
      <ResetIcon />
      {say("controls.reset-all")}
    </button>
  );
}
