import { BOUNDS, type LinkRole, type NewLink } from "../../../wire/generated";

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

/** The same as the server takes it; who has no name is called as others say. */
export function linkOf({ role, lasting, name }: Wish, unnamed: string): NewLink {
  const called = name.trim() || unnamed;
  return lasting === "open" ? { role, name: called } : { role, hours: HOURS[lasting], name: called };
}
