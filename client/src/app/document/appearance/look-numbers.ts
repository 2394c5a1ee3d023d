import { type Appearance, type AppearancePatch, DEFAULT_APPEARANCE, type Setting } from "../../../wire/generated";
import { LOOKS } from "../../../wire/generated-tables";

/** A section of the appearance. */
export type Part = keyof Appearance;

type FieldsOf<Look, Type> = { [Name in keyof Look]: Look[Name] extends Type ? Name : never }[keyof Look] & string;

/** Where a number of the appearance stands, as `section.field`. */
export type LookNumber = { [P in Part]: `${P}.${FieldsOf<Appearance[P], number>}` }[Part];

/** What a number of the appearance can be. */
export type LookRange = Extract<Setting, { kind: "number" }>;

/** Every number of the appearance. */
export const LOOK_NUMBERS = Object.fromEntries(
  Object.entries(LOOKS).flatMap(([part, rows]) =>
    Object.entries<Setting>(rows).flatMap(([field, row]) => (row.kind === "number" ? [[`${part}.${field}`, row]] : [])),
  ),
) as { readonly [Name in LookNumber]: LookRange };

/** A number of an appearance. */
export function numberIn(appearance: Appearance, name: LookNumber): number {
  const [part, field] = split(name);
  const value: unknown = Object.entries(appearance[part]).find(([other]) => other === field)?.[1];
  return typeof value === "number" ? value : 0;
}

/** What it is before anyone has changed it. */
export function standardOf(name: LookNumber): number {
  return numberIn(DEFAULT_APPEARANCE, name);
}

/** What is sent so that a number has a value: all else stays as others may just have set it. */
export function withNumber(name: LookNumber, value: number): AppearancePatch {
  const [part, field] = split(name);
  return { [part]: { [field]: value } };
}

/** An appearance with the fields of a patch put in. */
export function patched(appearance: Appearance, patch: AppearancePatch): Appearance {
  const sections = Object.entries(appearance).map(([part, look]) => [part, { ...look, ...patch[part as Part] }]);
  return Object.fromEntries(sections);
}

function split(name: LookNumber): [Part, string] {
  return name.split(".") as [Part, string];
}
