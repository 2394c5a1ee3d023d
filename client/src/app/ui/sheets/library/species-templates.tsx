import type { Species } from "../../../../wire/generated";
import { pictureOf } from "../../../document/species/species-api";
import { foundSpecies, speciesName, speciesSentence } from "../../../document/species/species-choice";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { pick, useSpecies } from "../../panels/architecture/species-list";
import { CardMenu, type Deed, only } from "./card-menu";

/** The species whose names have all the words, each of which a new tree can be begun as. */
export function SpeciesTemplates({ studio, words }: { readonly studio: Studio; readonly words: string }) {
  const species = foundSpecies(useSpecies(studio) ?? [], words);
  if (species.length === 0) {
    return null;
  }
  return (
    <section aria-label={say("library.species")}>
      <h3 class="library-head">{say("library.species")}</h3>
      <ul class="library">
        {species.map((one) => (
          <li class="card" key={one.slug}>
            <button
              type="button"
              class="card-open"
              aria-label={say("library.begin-which", { name: speciesName(one) })}
              onClick={() => void begin(studio, one)}
            >
              <img src={pictureOf(one.slug)} alt="" loading="lazy" />
            </button>
            <div class="card-foot">
              <strong class="card-name">{speciesName(one)}</strong>
              <span class="quiet card-facts card-sentence">{speciesSentence(one)}</span>
              <CardMenu label={say("library.more-of", { name: speciesName(one) })} deeds={deedsOf(studio, one)} />
            </div>
          </li>
        ))}
      </ul>
    </section>
  );
}

/** What can be done with a species. */
function deedsOf(studio: Studio, species: Species): readonly Deed[] {
  return [
    { label: say("library.begin"), act: () => void begin(studio, species) },
    ...only(studio.rights.mayOrder, {
      label: say("library.variations"),
      act: () => {
        const { slug } = species;
        studio.layout.pattern.value = { template: slug, name: speciesName(species), picture: pictureOf(slug) };
        studio.layout.sheet.value = "variations";
      },
    }),
  ];
}

/** Begins a new tree and has it grow as a species. */
async function begin(studio: Studio, species: Species): Promise<void> {
  if (await studio.trees.leave()) {
    pick(studio, species);
  }
}
