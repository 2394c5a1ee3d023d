import type { Comment, Pin, Thread } from "../../wire/generated";

/** Which threads a list shows. */
export const FILTERS = ["open", "mentions", "unread", "regrown", "detached", "all"] as const;
export type Filter = (typeof FILTERS)[number];

/** Who must have said something in a thread: anybody, whoever looks, or somebody else, by their name. */
export type By = "anybody" | "own" | `other ${string}`;

/** What whoever looks wants to see. */
export interface Wanted {
  readonly filter: Filter;
  readonly by: By;
}

/** Whether there is something in a thread that whoever looks has not seen. */
export function isUnread(thread: Thread): boolean {
  return unreadIn(thread).length > 0;
}

/** What whoever looks has not seen of a thread. */
export function unreadIn({ comments, seen }: Thread): Comment[] {
  return comments.filter(({ comment, own }) => comment > seen && !own);
}

/** Whether a comment is for whoever looks (`CT7`). */
export function isForMe({ mentions }: Comment): boolean {
  return mentions.some(({ you }) => you);
}

/** Whether something in a thread that was not seen is for whoever looks. */
export function callsForMe(thread: Thread): boolean {
  return unreadIn(thread).some(isForMe);
}

/** What is for whoever looks in a thread that has changed, and was not there before. */
export function newCalls(before: Thread | undefined, after: Thread): Comment[] {
  const known = new Set(before?.comments.map(({ comment }) => comment));
  return unreadIn(after).filter((comment) => isForMe(comment) && !known.has(comment.comment));
}

/** Whether a list shows a thread. */
export function isWanted(thread: Thread, pin: Pin | undefined, { filter, by }: Wanted): boolean {
  if (by !== "anybody" && !thread.comments.some((comment) => authorOf(comment) === by)) {
    return false;
  }
  switch (filter) {
    case "open":
      return thread.resolved === undefined;
    case "mentions":
      return thread.comments.some(isForMe);
    case "unread":
      return isUnread(thread);
    case "regrown":
      return thread.at !== undefined && pin?.state === "regrown";
    case "detached":
      return thread.at !== undefined && (pin?.state === "detached" || pin?.state === "elsewhere");
    case "all":
      return true;
  }
}

/** Everybody who has said something: whoever looks, then others in order of their names. */
export function authorsOf(threads: Iterable<Thread>): By[] {
  const all = new Set([...threads].flatMap(({ comments }) => comments.map(authorOf)));
  const others = [...all].filter((by) => by !== "own").sort((a, b) => nameOf(a).localeCompare(nameOf(b)));
  return all.has("own") ? ["own", ...others] : others;
}

/** What somebody else is called. */
export function nameOf(by: By): string {
  return by.slice("other ".length);
}

/** Whoever has the same name is somebody else. */
function authorOf({ author, own }: Comment): By {
  return own ? "own" : `other ${author}`;
}
