import type { TreeMember } from "../../../wire/generated";
import { folded } from "../found-text";

/** So many names are offered at once. */
const OFFERED = 8;

/** Names that go on from what is typed: first those that begin with it, then those that have it; none that has it already. */
export function offeredNames(
  names: readonly string[],
  typed: string,
  kind: "user" | "group",
  members: readonly TreeMember[],
): readonly string[] {
  const part = folded(typed.trim());
  const has = new Set(members.filter(({ group }) => group === (kind === "group")).map(({ name }) => name));
  const fitting = names.filter((name) => !has.has(name) && folded(name).includes(part));
  const begins = (name: string) => Number(!folded(name).startsWith(part));
  return fitting.sort((a, b) => begins(a) - begins(b)).slice(0, OFFERED);
}
