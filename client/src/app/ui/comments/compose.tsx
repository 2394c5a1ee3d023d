import { useRef, useState } from "preact/hooks";
import { MAX_COMMENT_CHARACTERS } from "../../../wire/generated";
import type { Conversation } from "../../comments/conversation";
import { authorsOf } from "../../comments/filters";
import {
  asked,
  type Candidate,
  candidates,
  completed,
  isSameName,
  labelOf,
  matching,
  mentionsOf,
} from "../../comments/mentions";
import type { Studio } from "../../studio";
import { companions } from "../../together/people";
import { say } from "../../words/say";

interface ComposeProps {
  readonly studio: Studio;
  readonly conversation: Conversation;
}

/** Words, whom they are for, and the view with what is drawn on it. */
export function Compose({ studio, conversation }: ComposeProps) {
  const [text, setText] = useState("");
  const [chosen, setChosen] = useState<readonly Candidate[]>([]);
  /** Who was meant by a name in the text, where it was taken from the list. */
  const [picked, setPicked] = useState<readonly Candidate[]>([]);
  // An answer is mostly about the view that is there already.
  const [showsView, setShowsView] = useState(conversation.draft.peek()?.thread === null);
  const [caret, setCaret] = useState(0);
  const [closed, setClosed] = useState(false);
  const field = useRef<HTMLTextAreaElement>(null);
  const self = conversation.self.value;
  const here = companions(studio.together.people.value).map(({ name, person }) => ({ name, person: person.person }));
  const known = authorsOf(conversation.threads.value?.values() ?? []);
  const all = candidates(here, known).filter(({ name }) => !self.some((own) => isSameName(name, own)));
  const typed = closed ? null : asked(text, caret);
  const offered = typed === null ? [] : matching(all, typed).slice(0, 6);
  const [first] = offered;
  const mention = (one: Candidate) => {
    const next = completed(text, caret, one.name);
    setPicked([...picked, one]);
    setText(next.text);
    setCaret(next.caret);
    // Once the field has the new text.
    requestAnimationFrame(() => {
      field.current?.focus();
      field.current?.setSelectionRange(next.caret, next.caret);
    });
  };
  const sketching = conversation.sketching.value;
  const hasLines = conversation.lines.value.length > 0;
  const sending = conversation.sending.value;
  return (
    <form
      class="stack comment-compose"
      onSubmit={(event) => {
        event.preventDefault();
        if (text.trim() !== "") {
          const mentions = mentionsOf(text, all, chosen, picked);
          void conversation.send(text, mentions, showsView).then((sent) => sent && setText(""));
        }
      }}
    >
      <label class="field">
        <span>{say("comments.text")}</span>
        <textarea
          rows={3}
          maxLength={MAX_COMMENT_CHARACTERS}
          value={text}
          ref={field}
          onInput={({ currentTarget }) => {
            setText(currentTarget.value);
            setCaret(currentTarget.selectionStart);
            setClosed(false);
          }}
          onSelect={({ currentTarget }) => setCaret(currentTarget.selectionStart)}
          onKeyDown={(event) => {
            if (first !== undefined && (event.key === "Enter" || event.key === "Tab")) {
              event.preventDefault();
              mention(first);
            } else if (first !== undefined && event.key === "Escape") {
              event.preventDefault();
              event.stopPropagation();
              setClosed(true);
            }
          }}
        />
      </label>
      {offered.length > 0 && (
        <fieldset class="comment-names" aria-label={say("comments.mention")}>
          {offered.map((one) => (
            <button type="button" class="small" key={labelOf(one, all)} onClick={() => mention(one)}>
              @{labelOf(one, all)}
            </button>
          ))}
        </fieldset>
      )}
      {all.length > 0 && offered.length === 0 && (
        <fieldset class="comment-names">
          <legend>{say("comments.for")}</legend>
          {all.slice(0, 12).map((one) => {
            const isOne = ({ name, person }: Candidate) => name === one.name && person === one.person;
            const isChosen = chosen.some(isOne);
            return (
              <button
                type="button"
                class="small"
                key={labelOf(one, all)}
                aria-pressed={isChosen}
                onClick={() => setChosen(isChosen ? chosen.filter((other) => !isOne(other)) : [...chosen, one])}
              >
                {labelOf(one, all)}
              </button>
            );
          })}
        </fieldset>
      )}
      <label class="comment-check">
        <input
          type="checkbox"
          checked={showsView}
          onChange={({ currentTarget }) => setShowsView(currentTarget.checked)}
        />
        <span>{say("comments.view")}</span>
      </label>
      {showsView && (
        <div class="comment-acts">
          <button
            type="button"
            class="small"
            aria-pressed={sketching}
            onClick={() => {
              conversation.sketching.value = !sketching;
            }}
          >
            {say(sketching ? "comments.sketch.done" : "comments.sketch")}
          </button>
          {hasLines && (
            <button
              type="button"
              class="small"
              onClick={() => {
                conversation.lines.value = [];
              }}
            >
              {say("comments.sketch.clear")}
            </button>
          )}
        </div>
      )}
      <div class="actions">
        <button type="button" class="small" onClick={() => conversation.giveUp()}>
          {say("comments.cancel")}
        </button>
        <button type="submit" class="primary" disabled={sending || text.trim() === ""}>
          {say(sending ? "comments.sending" : "comments.send")}
        </button>
      </div>
    </form>
  );
}
