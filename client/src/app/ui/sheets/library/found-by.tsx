import { KEPT_DAYS } from "../../../../wire/generated";
import { speciesName } from "../../../document/species/species-choice";
import { cleared, conditions } from "../../../library/wanted";
import { say } from "../../../words/say";
import { CloseIcon } from "../../icons";
import { useSpecies } from "../../panels/architecture/species-list";
import type { LibraryDesk } from "./library-desk";

/** What the trees that are listed were found by; each condition can be taken out. */
export function FoundBy({ desk }: { readonly desk: LibraryDesk }) {
  const holding = useConditions(desk);
  const { wanted } = desk;
  if (holding.length === 0) {
    return null;
  }
  return (
    <fieldset class="found-by" aria-label={say("finding.found-by")}>
      {holding.map(({ text, without }) => (
        <button
          key={text}
          type="button"
          class="small tag"
          aria-label={say("finding.drop", { condition: text })}
          onClick={() => {
            wanted.value = without;
          }}
        >
          {text}
          <CloseIcon />
        </button>
      ))}
      <ClearFilters desk={desk} />
    </fieldset>
  );
}

/** Why nothing is listed, and ways on. */
export function NothingFound({ desk }: { readonly desk: LibraryDesk }) {
  const holding = useConditions(desk);
  const { wanted, catalogue, section } = desk;
  const folder = catalogue.folder(wanted.value.collection);
  const collection = folder?.name ?? "";
  if (holding.length === 0) {
    const { collection: place } = wanted.value;
    const text =
      place === null
        ? say(`library.empty.${section.name}`, { days: KEPT_DAYS })
        : place === ""
          ? say("finding.empty-none")
          : say("finding.empty", { collection });
    return <p class="quiet empty">{text}</p>;
  }
  const all = holding.map(({ text }) => text).join(", ");
  return (
    <div class="nothing-found">
      <p class="quiet" role="status">
        {folder ? say("finding.none-in", { collection, conditions: all }) : say("finding.none", { conditions: all })}
      </p>
      <div class="found-by">
        <ClearFilters desk={desk} />
        {wanted.value.collection !== null && (
          <button
            type="button"
            class="small"
            onClick={() => {
              wanted.value = { ...wanted.value, collection: null };
            }}
          >
            {say("finding.everywhere")}
          </button>
        )}
      </div>
    </div>
  );
}

function ClearFilters({ desk: { wanted } }: { readonly desk: LibraryDesk }) {
  return (
    <button
      type="button"
      class="small"
      onClick={() => {
        wanted.value = cleared(wanted.value);
      }}
    >
      {say("finding.clear")}
    </button>
  );
}

function useConditions({ studio, wanted }: LibraryDesk) {
  const species = useSpecies(studio) ?? [];
  return conditions(wanted.value, (slug) => {
    const found = species.find((one) => one.slug === slug);
    return found ? speciesName(found) : slug;
  });
}
