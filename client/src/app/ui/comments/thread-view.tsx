import { useEffect, useRef, useState } from "preact/hooks";
import { type Comment, MAX_COMMENT_CHARACTERS, type Mention, type Pin, type Thread } from "../../../wire/generated";
import { CHANGED_WITHIN, pictureAddress } from "../../comments/comment-api";
import type { Conversation } from "../../comments/conversation";
import { isSameName, mentionedIn, piecesOf } from "../../comments/mentions";
import type { Studio } from "../../studio";
import { momentText } from "../../words/date-text";
import { say } from "../../words/say";
import { ConfirmRow } from "../sheets/confirm-row";
import { Compose } from "./compose";

interface ThreadViewProps {
  readonly studio: Studio;
  readonly conversation: Conversation;
  readonly thread: Thread;
}

/** A thread: where it is, what was said, and what can be done with it. */
export function ThreadView({ studio, conversation, thread }: ThreadViewProps) {
  const mayComment = studio.rights.mayComment;
  const pin = studio.comments.pins.value.get(thread.thread);
  const answers = conversation.draft.value?.thread === thread.thread;
  const list = useRef<HTMLOListElement>(null);
  const count = thread.comments.length;
  const shown = useRef(count);
  // What is said while the thread is open counts as seen, so it comes into sight, but under nobody's hand who writes.
  useEffect(() => {
    if (count > shown.current && !answers) {
      list.current?.lastElementChild?.scrollIntoView({ block: "nearest" });
    }
    shown.current = count;
  }, [count, answers]);
  return (
    <div class="stack">
      <button
        type="button"
        class="small comment-back"
        onClick={() => {
          studio.comments.open.value = null;
        }}
      >
        ‹ {say("comments.back")}
      </button>
      <p class="quiet" data-state={pin?.state}>
        {thread.thread} · {stateText(thread, pin)}
      </p>
      {thread.resolved && <p class="quiet">{say("comments.resolved", { name: thread.resolved.by })}</p>}
      <ol class="comments" ref={list}>
        {thread.comments.map((comment) => (
          <CommentView key={comment.comment} {...{ studio, conversation, thread, comment }} />
        ))}
      </ol>
      {answers && <Compose studio={studio} conversation={conversation} />}
      {mayComment && !answers && (
        <div class="comment-acts">
          <button
            type="button"
            class="primary"
            onClick={() => conversation.write({ thread: thread.thread, pin: null })}
          >
            {say("comments.reply")}
          </button>
          <button type="button" class="small" onClick={() => void conversation.resolve(thread)}>
            {say(thread.resolved ? "comments.reopen" : "comments.resolve")}
          </button>
        </div>
      )}
    </div>
  );
}

/** How the place of a thread is now. */
export function stateText({ at }: Thread, pin: Pin | undefined): string {
  if (at === undefined) {
    return say("comments.whole");
  }
  return pin === undefined ? "" : say(`comments.state.${pin.state}`, { step: pin.step ?? 0 });
}

interface WordsProps {
  readonly text: string;
  readonly mentions: readonly Mention[];
}

/** What was said, with those it is for. */
function Words({ text, mentions }: WordsProps) {
  const names = mentions.map(({ name }) => name);
  return (
    <>
      {piecesOf(text, names).map(({ text, name }, i) =>
        name === null ? (
          text
        ) : (
          <mark class="mention" key={i} data-me={mentions.some((one) => one.you && isSameName(one.name, name))}>
            {text}
          </mark>
        ),
      )}
    </>
  );
}

interface CommentViewProps extends ThreadViewProps {
  readonly comment: Comment;
}

function CommentView({ studio, conversation, thread, comment }: CommentViewProps) {
  const [asks, setAsks] = useState(false);
  const [edits, setEdits] = useState(false);
  const { author, text, written_at, edited_at, bookmark, mentions } = comment;
  const tree = conversation.tree.value;
  const now = studio.time.timeline.value;
  const isOtherStep =
    bookmark !== undefined && now !== null && bookmark.line === now.line && bookmark.step !== now.step;
  // Who is named in the words themselves is not named twice.
  const names = mentions.map(({ name }) => name);
  const named = mentionedIn(text, names);
  const others = names.filter((name) => !named.includes(name));
  const mayDelete = studio.rights.mayComment && (comment.own || studio.rights.mayGovern);
  const mayEdit =
    studio.rights.mayComment && comment.own && Date.now() - new Date(written_at).valueOf() < CHANGED_WITHIN;
  return (
    <li data-own={comment.own}>
      <p class="comment-head">
        <strong>{author}</strong>{" "}
        <span class="quiet">
          {momentText(written_at)}
          {edited_at !== undefined && ` · ${say("comments.edited")}`}
        </span>
      </p>
      {others.length > 0 && (
        <p class="quiet">
          {say("comments.for")} {others.join(", ")}
        </p>
      )}
      {edits ? (
        <EditWords
          text={text}
          onSave={async (words) => {
            if (words === text || (await conversation.edit(thread, comment.comment, words))) {
              setEdits(false);
            }
          }}
          onKeep={() => setEdits(false)}
        />
      ) : (
        <p class="comment-text">
          <Words text={text} mentions={mentions} />
        </p>
      )}
      {comment.picture && tree !== null && (
        <img
          src={pictureAddress(tree, thread.thread, comment.comment)}
          alt={say("comments.picture", { name: author })}
          loading="lazy"
        />
      )}
      <div class="comment-acts">
        {bookmark && (
          <button type="button" class="small" onClick={() => conversation.visit(bookmark)}>
            {say("comments.go")}
          </button>
        )}
        {isOtherStep && bookmark.step <= now.last_step && (
          <button
            type="button"
            class="small"
            title={say("comments.look.title")}
            onClick={() => conversation.lookBack(thread, bookmark)}
          >
            {say("comments.look", { step: bookmark.step })}
          </button>
        )}
        {isOtherStep && studio.rights.mayChange.value && bookmark.step <= now.last_step && (
          <button
            type="button"
            class="small"
            onClick={() => {
              studio.submit({ kind: "go_to", step: bookmark.step });
              conversation.visit(bookmark);
            }}
          >
            {say("comments.go.step", { step: bookmark.step })}
          </button>
        )}
        {mayEdit && !edits && (
          <button type="button" class="small" onClick={() => setEdits(true)}>
            {say("comments.edit")}
          </button>
        )}
        {mayDelete && !asks && (
          <button
            type="button"
            class="small"
            onClick={() => (comment.own ? void conversation.delete(thread, comment) : setAsks(true))}
          >
            {say("comments.delete")}
          </button>
        )}
      </div>
      {asks && (
        <ConfirmRow
          question={say("comments.delete.ask")}
          act={say("comments.delete")}
          onAct={() => conversation.delete(thread, comment)}
          onKeep={() => setAsks(false)}
        />
      )}
    </li>
  );
}

interface EditWordsProps {
  readonly text: string;
  readonly onSave: (text: string) => Promise<void>;
  readonly onKeep: () => void;
}

/** One's own words, to be changed. */
function EditWords({ text, onSave, onKeep }: EditWordsProps) {
  const [words, setWords] = useState(text);
  const [saving, setSaving] = useState(false);
  return (
    <form
      class="stack comment-compose"
      onSubmit={(event) => {
        event.preventDefault();
        setSaving(true);
        void onSave(words.trim()).finally(() => setSaving(false));
      }}
    >
      <label class="field">
        <span>{say("comments.text")}</span>
        <textarea
          rows={3}
          maxLength={MAX_COMMENT_CHARACTERS}
          value={words}
          onInput={({ currentTarget }) => setWords(currentTarget.value)}
        />
      </label>
      <div class="actions">
        <button type="button" class="small" onClick={onKeep}>
          {say("comments.cancel")}
        </button>
        <button type="submit" class="primary" disabled={saving || words.trim() === ""}>
          {say("comments.edit.save")}
        </button>
      </div>
    </form>
  );
}
