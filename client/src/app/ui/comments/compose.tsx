import { useState } from "preact/hooks";
import { MAX_COMMENT_CHARACTERS } from "../../../wire/generated";
import type { Conversation } from "../../comments/conversation";
import { authorsOf } from "../../comments/filters";
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
  const [chosen, setChosen] = useState<readonly string[]>([]);
  const [showsView, setShowsView] = useState(true);
  const own = studio.settings.author.value.trim();
  const here = companions(studio.together.people.value).map(({ name }) => name);
  const known = authorsOf(conversation.threads.value?.values() ?? []);
  const names = [...new Set([...here, ...known])].filter((name) => name !== own).slice(0, 12);
  const sketching = conversation.sketching.value;
  const hasLines = conversation.lines.value.length > 0;
  const sending = conversation.sending.value;
  return (
    <form
      class="stack comment-compose"
      onSubmit={(event) => {
        event.preventDefault();
        if (text.trim() !== "") {
          void conversation.send(text, chosen, showsView).then((sent) => sent && setText(""));
        }
      }}
    >
      <label class="field">
        <span>{say("comments.text")}</span>
        <textarea
          rows={3}
          maxLength={MAX_COMMENT_CHARACTERS}
          value={text}
          onInput={({ currentTarget }) => setText(currentTarget.value)}
        />
      </label>
      {names.length > 0 && (
        <fieldset class="comment-names">
          <legend>{say("comments.for")}</legend>
          {names.map((name) => (
            <button
              type="button"
              class="small"
              key={name}
              aria-pressed={chosen.includes(name)}
              onClick={() =>
                setChosen(chosen.includes(name) ? chosen.filter((other) => other !== name) : [...chosen, name])
              }
            >
              {name}
            </button>
          ))}
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
        <button type="button" onClick={() => conversation.giveUp()}>
          {say("comments.cancel")}
        </button>
        <button type="submit" class="primary" disabled={sending || text.trim() === ""}>
          {say(sending ? "comments.sending" : "comments.send")}
        </button>
      </div>
    </form>
  );
}
