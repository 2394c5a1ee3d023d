import { useEffect, useRef, useState } from "preact/hooks";
import { SORTS } from "../../../library/wanted";
import { say } from "../../../words/say";
import { CloseIcon } from "../../icons";
import { Filters } from "./filters";
import { FilterIcon, SearchIcon, StarIcon } from "./icons";
import type { LibraryDesk } from "./library-desk";
import { Pick } from "./pick";

/** Words are searched once nobody has typed for so many milliseconds. */
const PAUSE = 250;

/** What is searched, and in which order it is listed. */
export function FinderBar({ desk }: { readonly desk: LibraryDesk }) {
  const [open, setOpen] = useState(false);
  const { wanted, section } = desk;
  const { tags, favourite, species, author, mine, size, from, to, sort } = wanted.value;
  const count = [species, author, mine, size !== "any", from, to].filter(Boolean).length + tags.length;
  const filters = count === 0 ? say("finding.filters") : say("finding.filters.on", { count });
  return (
    <div class="finder" data-open={open}>
      <div class="finder-bar">
        <SearchField desk={desk} />
        <button
          type="button"
          class="small finder-toggle finder-star"
          aria-label={say("finding.favourites")}
          aria-pressed={favourite}
          onClick={() => {
            wanted.value = { ...wanted.value, favourite: !favourite };
          }}
        >
          <StarIcon />
          <span>{say("finding.favourites")}</span>
        </button>
        <button
          type="button"
          class="small finder-toggle"
          aria-label={filters}
          aria-expanded={open}
          data-on={count > 0}
          onClick={() => setOpen(!open)}
        >
          <FilterIcon />
          <span>{filters}</span>
        </button>
        {section.name !== "deleted" && (
          <Pick
            label={say("finding.order")}
            value={sort}
            options={SORTS.map((one) => [one, say(`finding.order.${one}`)])}
            onPick={(sort) => {
              wanted.value = { ...wanted.value, sort };
            }}
          />
        )}
      </div>
      {open && <Filters desk={desk} />}
    </div>
  );
}

/** Words that are searched while they are typed; the key `/` leads to it. */
function SearchField({ desk: { wanted, section } }: { readonly desk: LibraryDesk }) {
  const { words } = wanted.value;
  const [typed, setTyped] = useState(words);
  const field = useRef<HTMLInputElement>(null);
  const waiting = useRef(0);
  const search = (text: string) => {
    clearTimeout(waiting.current);
    if (text !== wanted.peek().words) {
      wanted.value = { ...wanted.peek(), words: text };
    }
  };
  // Somebody may have taken the words out elsewhere.
  useEffect(() => setTyped(words), [words]);
  useEffect(() => {
    const find = (event: KeyboardEvent) => {
      if (event.key === "/" && !(event.target as Element).matches?.("input, textarea, select")) {
        event.preventDefault();
        field.current?.focus();
      }
    };
    addEventListener("keydown", find);
    return () => {
      removeEventListener("keydown", find);
      clearTimeout(waiting.current);
    };
  }, []);
  return (
    <search class="finder-search" aria-busy={section.pages.asking.value && words !== ""}>
      <SearchIcon />
      <input
        ref={field}
        type="search"
        aria-label={say("finding.search")}
        aria-keyshortcuts="/"
        placeholder={say("finding.search")}
        autocomplete="off"
        enterkeyhint="search"
        value={typed}
        onInput={({ currentTarget: { value } }) => {
          setTyped(value);
          clearTimeout(waiting.current);
          waiting.current = window.setTimeout(() => search(value), PAUSE);
        }}
        onKeyDown={(event) => {
          if (event.key === "Enter") {
            search(typed);
          } else if (event.key === "Escape" && typed !== "") {
            // The sheet closes with the next one.
            event.preventDefault();
            setTyped("");
            search("");
          }
        }}
      />
      {typed !== "" && (
        <button
          type="button"
          class="tool"
          aria-label={say("finding.search.clear")}
          onClick={() => {
            setTyped("");
            search("");
            field.current?.focus();
          }}
        >
          <CloseIcon />
        </button>
      )}
    </search>
  );
}
