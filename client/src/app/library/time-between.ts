import { KEPT_DAYS } from "../../wire/generated";
import { language } from "../words/say";

const DAY = 86_400_000;

const UNITS = [
  ["day", DAY],
  ["hour", 3_600_000],
  ["minute", 60_000],
  ["second", 1000],
] as const;

/** The time between two moments in the largest unit that fits, as a person says it. */
export function timeBetween(one: string, other: string): string {
  const apart = Math.abs(Date.parse(one) - Date.parse(other));
  const [unit, length] = UNITS.find(([, length]) => apart >= length) ?? (["second", 1000] as const);
  const count = Math.round(apart / length);
  return count.toLocaleString(language.value, { style: "unit", unit, unitDisplay: "long" });
}

/** For how many days more a tree can be taken back, the one that has begun among them. */
export function daysLeft(deleted: string, now = Date.now()): number {
  return Math.max(0, Math.ceil((Date.parse(deleted) - now) / DAY) + KEPT_DAYS);
}
