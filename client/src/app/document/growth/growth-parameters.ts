import {
  DEFAULT_PARAMETERS as DEFAULTS,
  type Parameters,
  type ParametersPatch,
  type Setting,
} from "../../../wire/generated";
import { PARAMETERS } from "../../../wire/generated-tables";
import { numberText, unitText } from "../../words/number-text";
import { type Key, say } from "../../words/say";

export { DEFAULTS };

type Table = typeof PARAMETERS;
type ParameterName = keyof Table;
type NamesOf<Kind extends Setting["kind"]> = {
  [Name in ParameterName]: Table[Name]["kind"] extends Kind ? Name : never;
}[ParameterName];
type Row<Kind extends Setting["kind"]> = Extract<Setting, { kind: Kind }>;

/** Parameters that stand together. */
export type Group = Table[ParameterName]["group"];

/** A parameter that is a number. */
export type NumberName = NamesOf<"number">;

interface Shown {
  /** Whether it has an effect as things are. */
  readonly applies?: (parameters: Parameters) => boolean;
}

export type NumberParameter = Row<"number"> & Shown & { readonly name: NumberName };
export type SwitchParameter = Row<"switch"> & Shown & { readonly name: NamesOf<"switch"> };
export type ChoiceParameter = Omit<Row<"choice">, "choices"> &
  Shown & { readonly name: NamesOf<"choice">; readonly choices: Table[NamesOf<"choice">]["choices"] };
export type GrowthParameter = NumberParameter | SwitchParameter | ChoiceParameter;

const priority = ({ vigor_model }: Parameters) => vigor_model === "priority";
const borchertHonda = ({ vigor_model }: Parameters) => vigor_model === "borchert_honda";
const maturing = (parameters: Parameters) => borchertHonda(parameters) && parameters.maturity_steps > 0;

/** When those have an effect that do not always have one. */
const APPLIES: { readonly [Name in ParameterName]?: NonNullable<Shown["applies"]> } = {
  apical_control: borchertHonda,
  maturity_steps: borchertHonda,
  maturity_start: maturing,
  mature_apical_control: maturing,
  priority_least_weight: priority,
  priority_decline: priority,
  deflection_angle: ({ buds_per_node }) => buds_per_node === 1,
};

const ALL = Object.entries(PARAMETERS).map(([name, row]) => {
  const applies = APPLIES[name as ParameterName];
  return { ...row, name, ...(applies ? { applies } : {}) };
}) as readonly GrowthParameter[];

/** Whether a parameter is a number. */
export const isNumber = (parameter: GrowthParameter): parameter is NumberParameter => parameter.kind === "number";

/** All numbers among the parameters of growth. */
export const NUMBERS = Object.fromEntries(ALL.filter(isNumber).map((one) => [one.name, one])) as {
  readonly [Name in NumberName]: NumberParameter;
};

/** The parameter with a name. */
export function parameterOf(name: ParameterName): GrowthParameter {
  return ALL.find((one) => one.name === name)!;
}

/** The parameters of a group: those named here first, then all others in the order of the table. */
function group(wanted: Group, ...first: readonly ParameterName[]): readonly GrowthParameter[] {
  const all = ALL.filter((one) => one.group === wanted);
  const named = first.flatMap((name) => all.filter((one) => one.name === name));
  return [...named, ...all.filter((one) => !named.includes(one))];
}

/** Groups with a widget of their own to be pulled at. */
export const WIDGETS = {
  tropism: group("tropism"),
  sides: group("sides"),
  fork: group("fork"),
  weights: group("weights"),
  perception: group("perception"),
} as const satisfies { readonly [Name in Group]?: readonly GrowthParameter[] };

/** Sliders that go together; the first stand in the open, as in the paper's own panel. */
export const SECTIONS: readonly { readonly title: Key; readonly parameters: readonly GrowthParameter[] }[] = [
  {
    title: "architecture.section.vigor",
    parameters: group("vigor", "apical_control", "light_sensitivity", "shedding_threshold"),
  },
  {
    title: "architecture.section.sharing",
    parameters: group(
      "sharing",
      ...(["vigor_model", "priority_least_weight", "priority_decline", "vigor_gain"] as const),
      ...(["maturity_steps", "maturity_start"] as const),
    ),
  },
  { title: "architecture.section.buds", parameters: group("buds") },
  { title: "architecture.section.shade", parameters: group("shade") },
  { title: "architecture.section.wood", parameters: group("wood", "girth_exponent", "twig_diameter") },
];

/** Parameters that say what a stroke of the brush does; they stand in its panel. */
export const OF_THE_BRUSH = group("brush", "marker_density", "marker_max_age");

/** Parameters that foliage is made of; they stand in the panel of leaves. */
export const OF_THE_LEAVES = group("leaves");

/** A parameter's name in the present language. */
export function nameOf({ name }: GrowthParameter): string {
  return say(`parameters.${name}`);
}

/** What a parameter does, in a sentence. */
export function helpOf({ name }: GrowthParameter): string {
  return say(`parameters.${name}.help`);
}

const WEIGHTS = ["heading_weight", "tropism_weight", "space_weight"] as const;

/** What to send so that a number has a value; the three weights of direction stay 1 together. */
export function patchFor(name: NumberName, value: number, now: Parameters): ParametersPatch {
  if (!(WEIGHTS as readonly string[]).includes(name)) {
    return { [name]: value };
  }
  const others = WEIGHTS.filter((weight) => weight !== name);
  const sum = others.reduce((total, weight) => total + now[weight], 0);
  const left = 1 - value;
  // Thousandths, and what rounding leaves goes to the last of them.
  const first = Math.round(1000 * (sum > 0 ? (left * now[others[0]!]) / sum : left / 2)) / 1000;
  const second = Math.round(1000 * Math.max(0, left - first)) / 1000;
  return { [name]: value, [others[0]!]: first, [others[1]!]: second };
}

/** The patch that gives some parameters the values they have in another set. */
export function patchFrom(source: Parameters, parameters: readonly GrowthParameter[]): ParametersPatch {
  return Object.fromEntries(parameters.map(({ name }) => [name, source[name]]));
}

/** The unit of a number in the present language; empty if it has none, or is counted in internodes. */
export function unitOf({ unit }: Pick<Setting, "unit">): string {
  return unit === "steps" ? say("parameters.unit.steps") : unit === "internodes" ? "" : (unit ?? "");
}

/** A value as it is read: no more digits than a step shows. */
export function shownValue(parameter: NumberParameter, value: number): string {
  return `${numberText(value, parameter.step)}${unitText(unitOf(parameter))}`;
}
