import { useEffect, useState } from "preact/hooks";
import type { Thread } from "../../../wire/generated";
import { reviewAddress } from "../../comments/comment-api";
import type { Conversation } from "../../comments/conversation";
import {
  authorsOf,
  type By,
  callsForMe,
  FILTERS,
  type Filter,
  isUnread,
  isWanted,
  nameOf,
  unreadIn,
} from "../../comments/filters";
import type { Studio } from "../../studio";
import { dateText } from "../../words/date-text";
import { language, say } from "../../words/say";
import { conversationOf } from "../comments/comment-pins";
import { Compose } from "../comments/compose";
import { stateText, ThreadView } from "../comments/thread-view";
import { Pick } from "../sheets/library/pick";

/** What people say of the tree: a list, or one thread of it. */
export function CommentsPanel({ studio }: { studio: Studio }) {
  const conversation = conversationOf(studio);
  const threads = conversation.threads.value;
  const open = threads?.get(studio.comments.open.value ?? 0);
  const newest = open?.comments.at(-1)?.comment;
  // What comes while the thread is shown is seen as well.
  useEffect(() => {
    if (open && newest !== undefined) {
      conversation.see(open);
    }
  }, [conversation, open, newest]);
  useEffect(() => {
    if (conversation.threads.peek() === null || conversation.tree.peek() === null) {
      void conversation.load();
    }
  }, [conversation]);
  if (threads === null) {
    return <p class="quiet advice">{say("comments.loading")}</p>;
  }
  if (conversation.tree.value === null) {
    return <SaveFirst studio={studio} />;
  }
  if (conversation.draft.value?.thread === null) {
    return <Compose studio={studio} conversation={conversation} />;
  }
  return open ? (
    <ThreadView studio={studio} conversation={conversation} thread={open} key={open.thread} />
  ) : (
    <ThreadList studio={studio} conversation={conversation} threads={[...threads.values()]} />
  );
}

function SaveFirst({ studio }: { studio: Studio }) {
  return (
    <div class="stack">
      <p class="quiet advice">{say("comments.save-first")}</p>
      {studio.rights.mayChange.value && (
        <div class="actions">
          <button
            type="button"
            class="primary"
            onClick={() => {
              studio.layout.sheet.value = "save";
            }}
          >
            {say("bars.save")}
          </button>
        </div>
      )}
    </div>
  );
}

/** Somebody among those who can be chosen. */
function textOf(by: By): string {
  switch (by) {
    case "anybody":
      return say("comments.person.any");
    case "own":
      return say("comments.person.you");
    default:
      return nameOf(by);
  }
}

interface ThreadListProps {
  readonly studio: Studio;
  readonly conversation: Conversation;
  readonly threads: readonly Thread[];
}

function ThreadList({ studio, conversation, threads }: ThreadListProps) {
  const [filter, setFilter] = useState<Filter>("open");
  const [chosen, setChosen] = useState<By>("anybody");
  const pins = studio.comments.pins.value;
  const authors = authorsOf(threads);
  // What somebody has said may be deleted while they are chosen.
  const by = authors.length > 1 && authors.includes(chosen) ? chosen : "anybody";
  const wanted = threads.filter((thread) => isWanted(thread, pins.get(thread.thread), { filter, by }));
  const tree = conversation.tree.value;
  return (
    <div class="stack">
      {studio.rights.mayComment ? (
        <div class="comment-acts">
          <button
            type="button"
            class="primary"
            aria-pressed={conversation.placing.value}
            onClick={() => {
              conversation.placing.value = true;
            }}
          >
            {say("comments.new")}
          </button>
          <button type="button" class="small" onClick={() => conversation.write({ thread: null, pin: null })}>
            {say("comments.new.whole")}
          </button>
        </div>
      ) : (
        <p class="quiet">{say("comments.looking")}</p>
      )}
      {threads.length > 0 && (
        <>
          <fieldset class="comment-names">
            <legend>{say("comments.filter")}</legend>
            {FILTERS.map((one) => (
              <button
                type="button"
                class="small"
                key={one}
                aria-pressed={filter === one}
                onClick={() => setFilter(one)}
              >
                {say(`comments.filter.${one}`)}
              </button>
            ))}
          </fieldset>
          {authors.length > 1 && (
            <div class="field">
              <span aria-hidden="true">{say("comments.person")}</span>
              <Pick
                label={say("comments.person")}
                value={by}
                options={(["anybody", ...authors] as const).map((author) => [author, textOf(author)] as const)}
                onPick={setChosen}
              />
            </div>
          )}
        </>
      )}
      {wanted.length === 0 && (
        <p class="quiet advice">{say(threads.length === 0 ? "comments.none" : "comments.none.like")}</p>
      )}
      <ul class="comment-threads">
        {wanted.map((thread) => (
          <li key={thread.thread} data-unread={isUnread(thread)} data-resolved={thread.resolved !== undefined}>
            <button type="button" onClick={() => conversation.show(thread)}>
              <span class="comment-number">{thread.thread}</span>
              <span>
                <strong>{thread.comments[0]?.author}</strong>{" "}
                <span class="quiet">{dateText(thread.comments[0]?.written_at ?? "")}</span>
                {isUnread(thread) && (
                  <span class="comment-new" data-me={callsForMe(thread)}>
                    {say(callsForMe(thread) ? "comments.new.me" : "comments.new.in", {
                      count: unreadIn(thread).length,
                    })}
                  </span>
                )}
                <br />
                <span class="comment-excerpt">{thread.comments[0]?.text}</span>
                <span class="quiet">
                  {stateText(thread, pins.get(thread.thread))}
                  {thread.comments.length > 1 && ` · ${say("comments.answers", { count: thread.comments.length - 1 })}`}
                </span>
              </span>
            </button>
          </li>
        ))}
      </ul>
      {tree !== null && threads.length > 0 && (
        <a class="comment-summary" href={reviewAddress(tree, language.value)} target="_blank" rel="noreferrer">
          {say("comments.review")}
        </a>
      )}
    </div>
  );
}
