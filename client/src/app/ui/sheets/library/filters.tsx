import type { ComponentChildren } from "preact";
import { speciesName } from "../../../document/species/species-choice";
import { SIZES, type Size, type Wanted } from "../../../library/wanted";
import { say } from "../../../words/say";
import { useSpecies } from "../../panels/architecture/species-list";
import type { LibraryDesk } from "./library-desk";
import { Pick } from "./pick";

const [ANYBODY, MINE, BY] = ["any", "mine", "by "];

/** What trees are told apart by, all of it at once. */
export function Filters({ desk: { studio, catalogue, wanted } }: { readonly desk: LibraryDesk }) {
  const species = useSpecies(studio) ?? [];
  const now = wanted.value;
  const want = (change: Partial<Wanted>) => {
    wanted.value = { ...now, ...change };
  };
  const tags = catalogue.tags.value;
  return (
    <div class="filters">
      <Filter label={say("finding.species")}>
        <Pick
          label={say("finding.species")}
          value={now.species}
          options={[["", say("finding.species.any")], ...species.map((one) => [one.slug, speciesName(one)] as const)]}
          onPick={(species) => want({ species })}
        />
      </Filter>
      <Filter label={say("finding.person")}>
        <Pick
          label={say("finding.person")}
          value={now.mine ? MINE : now.author === "" ? ANYBODY : BY + now.author}
          options={[
            [ANYBODY, say("finding.person.any")],
            [MINE, say("finding.person.mine")],
            ...catalogue.authors.value.map(({ author }) => [BY + author, author] as const),
          ]}
          onPick={(who) => want({ mine: who === MINE, author: who.startsWith(BY) ? who.slice(BY.length) : "" })}
        />
      </Filter>
      <Filter label={say("finding.size")}>
        <Pick
          label={say("finding.size")}
          value={now.size}
          options={(Object.keys(SIZES) as Size[]).map((size) => [size, say(`finding.size.${size}`)])}
          onPick={(size) => want({ size })}
        />
      </Filter>
      {(["from", "to"] as const).map((end) => (
        <Filter key={end} label={say(`finding.${end}`)}>
          <input
            class="pick"
            type="date"
            aria-label={say(`finding.${end}`)}
            value={now[end]}
            onChange={({ currentTarget }) => want({ [end]: currentTarget.value })}
          />
        </Filter>
      ))}
      <fieldset class="filter-tags">
        <legend>{say("finding.tags")}</legend>
        {tags.length === 0 && <p class="quiet">{say("finding.no-tags")}</p>}
        {tags.map(({ tag, trees }) => {
          const on = now.tags.includes(tag);
          return (
            <button
              key={tag}
              type="button"
              class="small tag"
              aria-pressed={on}
              onClick={() => want({ tags: on ? now.tags.filter((other) => other !== tag) : [...now.tags, tag] })}
            >
              {tag} <span class="tag-count">{trees}</span>
            </button>
          );
        })}
      </fieldset>
    </div>
  );
}

function Filter({ label, children }: { readonly label: string; readonly children: ComponentChildren }) {
  return (
    <div class="filter">
      <span aria-hidden="true">{label}</span>
      {children}
    </div>
  );
}
