import { BOUNDS, type LinkRole, type NewLink, type NewToken } from "../../../wire/generated";

/** For how long somebody can be let in; `open` is as long as they come. */
export const LASTING = ["day", "week", "month", "year", "open"] as const;
export type Lasting = (typeof LASTING)[number];

const DAY = 24;

const HOURS: Readonly<Record<Exclude<Lasting, "open">, number>> = {
  day: DAY,
  week: 7 * DAY,
  month: 30 * DAY,
  year: BOUNDS.LinkHours.most,
};

/** What a link may allow, the least first. */
export const LINK_ROLES = ["viewer", "commenter", "editor"] as const satisfies readonly LinkRole[];

/** Who is to be let in, and for how long. */
export interface Wish {
  readonly role: LinkRole;
  readonly lasting: Lasting;
  /** What their device is called. */
  readonly name: string;
}

export const FIRST_WISH: Wish = { role: "viewer", lasting: "week", name: "" };

/** For how long a program can be let in. */
export const LASTING_TOKENS = ["week", "month", "year"] as const satisfies readonly Lasting[];

/** The same for a program. */
export function tokenOf({ role, lasting, name }: Wish): NewToken {
  return { role, name: name.trim(), ...(lasting === "open" ? {} : { hours: HOURS[lasting] }) };
}

/** The same as the server takes it; who has no name is called as others say. */
export function linkOf({ role, lasting, name }: Wish, unnamed: string): NewLink {
  const called = name.trim() || unnamed;
  return lasting === "open" ? { role, name: called } : { role, hours: HOURS[lasting], name: called };
}
