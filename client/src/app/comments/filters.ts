import type { Comment, Pin, Thread } from "../../wire/generated";

/** Which threads a list shows. */
export const FILTERS = ["open", "mine", "mentions", "unread", "detached", "all"] as const;
export type Filter = (typeof FILTERS)[number];

/** Who looks, and what they want to see. */
export interface Wanted {
  readonly filter: Filter;
  /** What somebody must have taken part, if anybody must. */
  readonly person: string | null;
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
export function isWanted(thread: Thread, pin: Pin | undefined, { filter, person }: Wanted): boolean {
  if (person !== null && !thread.comments.some(({ author }) => author === person)) {
    return false;
  }
  switch (filter) {
    case "open":
      return thread.resolved === undefined;
    case "mine":
      return thread.comments.some(({ own }) => own);
    case "mentions":
      return thread.comments.some(isForMe);
    case "unread":
      return isUnread(thread);
    case "detached":
      return thread.at !== undefined && (pin?.state === "detached" || pin?.state === "elsewhere");
    case "all":
      return true;
  }
}

/** Everybody who has said something, in order of their names. */
export function authorsOf(threads: Iterable<Thread>): string[] {
  const names = new Set([...threads].flatMap(({ comments }) => comments.map(({ author }) => author)));
  return [...names].sort((a, b) => a.localeCompare(b));
}
