import type { Pin, Thread } from "../../wire/generated";

/** Which threads a list shows. */
export const FILTERS = ["open", "mine", "mentions", "unread", "detached", "all"] as const;
export type Filter = (typeof FILTERS)[number];

/** Who looks, and what they want to see. */
export interface Wanted {
  readonly filter: Filter;
  /** What somebody must have taken part, if anybody must. */
  readonly person: string | null;
  /** What whoever looks is called. */
  readonly self: string;
}

/** Whether there is something in a thread that whoever looks has not seen. */
export function isUnread({ comments, seen }: Thread): boolean {
  return comments.some(({ comment, own }) => comment > seen && !own);
}

/** Whether a list shows a thread. */
export function isWanted(thread: Thread, pin: Pin | undefined, { filter, person, self }: Wanted): boolean {
  if (person !== null && !thread.comments.some(({ author }) => author === person)) {
    return false;
  }
  switch (filter) {
    case "open":
      return thread.resolved === undefined;
    case "mine":
      return thread.comments.some(({ own }) => own);
    case "mentions":
      return thread.comments.some(({ mentions }) => mentions.some((name) => isSame(name, self)));
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

function isSame(name: string, other: string): boolean {
  return other !== "" && name.localeCompare(other, undefined, { sensitivity: "base" }) === 0;
}
