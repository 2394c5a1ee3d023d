import { type Appearance, type AppearancePatch, DEFAULT_APPEARANCE } from "../../../wire/generated";

/** A section of the appearance. */
export type Part = keyof Appearance;

type FieldsOf<Look, Type> = { [Name in keyof Look]: Look[Name] extends Type ? Name : never }[keyof Look] & string;

/** Where a number of the appearance stands, as `section.field`. */
export type LookNumber = { [P in Part]: `${P}.${FieldsOf<Appearance[P], number>}` }[Part];

/** What a number of the appearance can be; ranges are those of `PROTOCOL.md` (`AP1`). */
export interface LookRange {
  readonly least: number;
  readonly most: number;
  readonly step: number;
  readonly unit?: "°";
}

const share = { least: 0, most: 1, step: 0.01 };
const double = { least: 0, most: 2, step: 0.02 };
const both = { least: -1, most: 1, step: 0.02 };
const size = { least: 0.05, most: 2, step: 0.05 };

/** Every number of the appearance. */
export const LOOK_NUMBERS: { readonly [Name in LookNumber]: LookRange } = {
  "leaves.vigor_shift": share,
  "leaves.season": { least: 0, most: 3, step: 0.02 },
  "leaves.orientation": both,
  "flowers.size": size,
  "flowers.share": share,
  "flowers.vigor": both,
  "fruits.size": size,
  "fruits.share": share,
  "fruits.vigor": both,
  "bark.relief": double,
  "bark.root_flare": double,
  "bark.collar": double,
  "bark.smoothing": share,
  "background.sun_azimuth": { least: 0, most: 360, step: 1, unit: "°" },
  "background.sun_elevation": { least: -10, most: 90, step: 1, unit: "°" },
};

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
