import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { type Appearance, DEFAULT_APPEARANCE, type Parameters, type Species } from "../../../../wire/generated";
import { DEFAULTS } from "../../../document/growth/growth-parameters";
import { valuesAt } from "../../../document/growth/programme-control";
import { listSpecies } from "../../../document/species/species-api";
import { type Kin, kinByProgramme, kinOf, parametersOf } from "../../../document/species/species-choice";
import { SpeciesSource } from "../../../document/species/species-source";
import { browserClock } from "../../../page/clock";
import { sentence } from "../../../problems/plain-words";
import type { Studio } from "../../../studio";

const source = new SpeciesSource({ list: listSpecies, clock: browserClock });

/** The species there are; null before the server has answered. */
export function useSpecies(studio: Studio): readonly Species[] | null {
  useEffect(() => source.ask((error) => studio.toasts.show(sentence(error))), [studio]);
  return source.known.value;
}

/** The same, as far as they are known by now. */
export const knownSpecies = (): readonly Species[] => source.known.peek() ?? [];

/** The species picked last on this page, by its slug: some differ only in how they are raised. */
const lastPicked = signal<string | undefined>(undefined);

/** Takes a species' growth and looks, all but what is around it, as one operation. */
export function pick(
  studio: Studio,
  { slug, programme, appearance: { leaves, flowers, fruits, bark } }: Species,
): void {
  lastPicked.value = slug;
  const gesture = studio.link.next;
  studio.programme.set(programme, { gesture });
  studio.looks.commit({ leaves, flowers, fruits, bark }, gesture);
}

/** The last answer, since many controls ask for the same in one frame. */
let last: { readonly about: readonly unknown[]; readonly kin: Kin | null } = { about: [], kin: null };

/** The species that what is set now comes from, if it is near enough to one. */
export function kinNow(studio: Studio): Kin | null {
  const [species, parameters, looks] = [source.known.value, studio.parameters.value, studio.appearance.value];
  const [picked, programme] = [lastPicked.value, studio.programme.inForce.value];
  const about = [species, parameters, looks, picked, programme];
  if (about.some((one, i) => one !== last.about[i])) {
    last = { about, kin: kinOfAll() };
  }
  return last.kin;

  function kinOfAll(): Kin | null {
    if (species === null || parameters === null) {
      return null;
    }
    return programme === null ? kinOf(species, parameters, looks, picked) : kinByProgramme(species, programme, looks);
  }
}

/** What a reset goes back to: what the programme has at this age, the species' own values, or the first ones. */
export function standardOf(studio: Studio): Parameters {
  const programme = studio.programme.inForce.value?.programme;
  if (programme) {
    return valuesAt(programme, studio.document.value?.age ?? 0);
  }
  const kin = kinNow(studio);
  return kin ? parametersOf(kin.species.programme) : DEFAULTS;
}

/** The same of looks; what is around a tree is no species' own. */
export function standardLooks(studio: Studio): Appearance {
  const own = kinNow(studio)?.species.appearance;
  const { background, wind } = DEFAULT_APPEARANCE;
  return own ? { ...own, background, wind } : DEFAULT_APPEARANCE;
}
