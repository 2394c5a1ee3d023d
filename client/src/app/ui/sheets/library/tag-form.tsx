import { useEffect, useRef, useState } from "preact/hooks";
import { MAX_NAME_CHARACTERS, MAX_TAGS, type TreeTag } from "../../../../wire/generated";
import { folded } from "../../../library/found-text";
import { say } from "../../../words/say";
import { CloseIcon } from "../../icons";

/** So many of the tags that other trees have are offered. */
const OFFERED = 8;

interface TagFormProps {
  readonly label: string;
  readonly tags: readonly string[];
  readonly known: readonly TreeTag[];
  readonly onSave: (tags: string[]) => void;
  readonly onEnd: () => void;
}

/** A row in which tags are typed, taken from those of other trees, and taken away. */
export function TagForm({ label, tags, known, onSave, onEnd }: TagFormProps) {
  const [chosen, setChosen] = useState(tags);
  const [typed, setTyped] = useState("");
  const field = useRef<HTMLInputElement>(null);
  useEffect(() => field.current?.focus(), []);
  const add = (text: string) => {
    const all = withTags(chosen, text);
    setChosen(all);
    setTyped("");
    return all;
  };
  const offered = [...known]
    .sort((a, b) => b.trees - a.trees)
    .filter(({ tag }) => !chosen.includes(tag) && folded(tag).includes(folded(typed.trim())));
  return (
    <form
      class="card-form"
      aria-label={label}
      onSubmit={(event) => {
        event.preventDefault();
        const all = add(typed);
        if (all.join() !== tags.join()) {
          onSave([...all]);
        }
        onEnd();
      }}
      onKeyDown={(event) => {
        if (event.key === "Escape") {
          event.preventDefault();
          onEnd();
        }
      }}
    >
      <div class="tags">
        {chosen.map((tag) => (
          <button
            key={tag}
            type="button"
            class="small tag"
            aria-label={say("finding.remove-tag", { tag })}
            onClick={() => setChosen(chosen.filter((other) => other !== tag))}
          >
            {tag}
            <CloseIcon />
          </button>
        ))}
        {chosen.length < MAX_TAGS ? (
          <input
            type="text"
            aria-label={say("finding.new-tag")}
            placeholder={say("finding.new-tag")}
            autocomplete="off"
            maxLength={MAX_NAME_CHARACTERS}
            value={typed}
            ref={field}
            onInput={({ currentTarget: { value } }) => (value.includes(",") ? add(value) : setTyped(value))}
            onKeyDown={(event) => {
              if (event.key === "Enter" && typed.trim() !== "") {
                event.preventDefault();
                add(typed);
              }
            }}
          />
        ) : (
          <p class="quiet">{say("finding.most-tags", { count: MAX_TAGS })}</p>
        )}
      </div>
      {offered.length > 0 && chosen.length < MAX_TAGS && (
        <div class="tags">
          {offered.slice(0, OFFERED).map(({ tag }) => (
            <button
              key={tag}
              type="button"
              class="small tag"
              aria-label={say("finding.add-tag", { tag })}
              onClick={() => add(tag)}
            >
              + {tag}
            </button>
          ))}
        </div>
      )}
      <button type="button" class="small" onClick={onEnd}>
        {say("library.cancel")}
      </button>
      <button type="submit" class="primary">
        {say("library.save")}
      </button>
    </form>
  );
}

/** The tags with those of a text, which has commas between them. */
function withTags(tags: readonly string[], text: string): readonly string[] {
  const typed = text
    .split(",")
    .map((tag) => tag.trim())
    .filter(Boolean);
  return [...new Set([...tags, ...typed])].slice(0, MAX_TAGS);
}
