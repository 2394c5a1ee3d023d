import type { Parameters, ParametersPatch } from "../../../wire/generated";
import { numberText, unitText } from "../../words/number-text";
import { type Key, say } from "../../words/say";

type NumberNames<Set> = { [Name in keyof Set]: Set[Name] extends number ? Name : never }[keyof Set];

/** A parameter that is a number. */
export type NumberName = NumberNames<Parameters>;

/** How one number is shown and set. Ranges are those of `PROTOCOL.md`. */
export interface NumberParameter {
  readonly kind: "number";
  readonly name: NumberName;
  readonly symbol?: string;
  /** A sign that stands after the value, or the key of a word that does. */
  readonly unit?: "°" | "m" | "parameters.unit.steps";
  readonly least: number;
  readonly most: number;
  readonly step: number;
  /** Whether it has an effect as things are. */
  readonly applies?: (parameters: Parameters) => boolean;
}

export interface SwitchParameter {
  readonly kind: "switch";
  readonly name: "trunk_upward" | "tropism_from_stroke";
}

export interface ChoiceParameter {
  readonly kind: "choice";
  readonly name: "vigor_model";
  readonly choices: readonly Parameters["vigor_model"][];
}

export type GrowthParameter = NumberParameter | SwitchParameter | ChoiceParameter;

const priority = ({ vigor_model }: Parameters) => vigor_model === "priority";
const borchertHonda = ({ vigor_model }: Parameters) => vigor_model === "borchert_honda";
const maturing = (parameters: Parameters) => borchertHonda(parameters) && parameters.maturity_steps > 0;

type Range = readonly [least: number, most: number, step: number];
type More = Pick<NumberParameter, "symbol" | "unit" | "applies">;

/** All numbers among the parameters of growth. */
export const NUMBERS: { readonly [Name in NumberName]: NumberParameter } = (() => {
  const rows: { readonly [Name in NumberName]: readonly [Range, More?] } = {
    apical_control: [[0.4, 0.7, 0.005], { symbol: "λ", applies: borchertHonda }],
    maturity_steps: [[0, 500, 1], { unit: "parameters.unit.steps", applies: borchertHonda }],
    maturity_start: [[0, 500, 1], { unit: "parameters.unit.steps", applies: maturing }],
    mature_apical_control: [[0.4, 0.7, 0.005], { applies: maturing }],
    priority_least_weight: [[0.001, 1, 0.001], { symbol: "w", applies: priority }],
    priority_decline: [[0.05, 1, 0.01], { symbol: "κₚ", applies: priority }],
    light_sensitivity: [[0, 6, 0.1], { symbol: "κ" }],
    max_shoot_length: [[1, 20, 1], { symbol: "nmax" }],
    vigor_gain: [[0.1, 10, 0.1]],
    shedding_threshold: [[0, 1, 0.01], { symbol: "Th" }],
    heading_weight: [[0, 1, 0.01], { symbol: "α" }],
    tropism_weight: [[0, 1, 0.01], { symbol: "β" }],
    space_weight: [[0, 1, 0.01], { symbol: "γ" }],
    setpoint_angle: [[0, 180, 1], { symbol: "θ", unit: "°" }],
    phototropism: [[0, 1, 0.01]],
    branching_angle: [[0, 120, 1], { symbol: "ψ", unit: "°" }],
    phyllotactic_angle: [[0, 180, 0.5], { symbol: "φ", unit: "°" }],
    buds_per_node: [[1, 4, 1]],
    deflection_angle: [[0, 45, 0.5], { symbol: "δ", unit: "°", applies: ({ buds_per_node }) => buds_per_node === 1 }],
    gravimorphism_shift: [[-0.99, 0.99, 0.01], { symbol: "eᵥ / sᵥ" }],
    gravimorphism_vertical: [[0.05, 3, 0.05], { symbol: "sᵥ" }],
    gravimorphism_horizontal: [[0.05, 3, 0.05], { symbol: "sₚ" }],
    occupancy_radius: [[0.5, 6, 0.1], { symbol: "r" }],
    perception_depth: [[0.5, 10, 0.1], { symbol: "d" }],
    perception_angle: [[20, 360, 1], { symbol: "ζ", unit: "°" }],
    marker_density: [[0.01, 1, 0.01]],
    markers_per_bud: [[1, 32, 1]],
    marker_max_age: [[1, 60, 1], { unit: "parameters.unit.steps" }],
    shadow_strength: [[0, 1, 0.01], { symbol: "a" }],
    shadow_decay: [[1.1, 4, 0.1], { symbol: "b" }],
    shadow_depth: [[0, 8, 1], { symbol: "q" }],
    internode_length: [[0.005, 1, 0.005], { symbol: "l", unit: "m" }],
    girth_exponent: [[2, 3, 0.05], { symbol: "n" }],
    twig_diameter: [[0.02, 0.3, 0.01]],
    leaves_per_node: [[0, 15, 1]],
    leaf_size: [[0.1, 3, 0.05]],
  };
  const made = Object.entries(rows).map(([name, [[least, most, step], more = {}]]) => [
    name,
    { kind: "number", name, least, most, step, ...more },
  ]);
  return Object.fromEntries(made) as { [Name in NumberName]: NumberParameter };
})();

const VIGOR_MODEL: ChoiceParameter = {
  kind: "choice",
  name: "vigor_model",
  choices: ["borchert_honda", "priority"],
};

/** What is switched on and off. */
export const SWITCHES = {
  trunk_upward: { kind: "switch", name: "trunk_upward" },
  tropism_from_stroke: { kind: "switch", name: "tropism_from_stroke" },
} as const satisfies Record<string, SwitchParameter>;

const numbers = (...names: readonly NumberName[]): readonly NumberParameter[] => names.map((name) => NUMBERS[name]);

/** What has a widget of its own to be pulled at; the rest are sliders. */
export const WIDGETS = {
  tropism: numbers("setpoint_angle"),
  sides: numbers("gravimorphism_vertical", "gravimorphism_horizontal", "gravimorphism_shift"),
  fork: numbers("branching_angle", "deflection_angle"),
  weights: numbers("heading_weight", "tropism_weight", "space_weight"),
  perception: numbers("occupancy_radius", "perception_depth", "perception_angle"),
} as const;

/** Sliders that go together; the first stand in the open, as in the paper's own panel. */
export const SECTIONS: readonly { readonly title: Key; readonly parameters: readonly GrowthParameter[] }[] = [
  {
    title: "architecture.section.vigor",
    parameters: numbers("apical_control", "light_sensitivity", "shedding_threshold", "max_shoot_length"),
  },
  {
    title: "architecture.section.sharing",
    parameters: [
      VIGOR_MODEL,
      ...numbers("priority_least_weight", "priority_decline", "vigor_gain"),
      ...numbers("maturity_steps", "maturity_start", "mature_apical_control"),
    ],
  },
  {
    title: "architecture.section.buds",
    parameters: numbers("phyllotactic_angle", "buds_per_node", "phototropism", "markers_per_bud"),
  },
  {
    title: "architecture.section.shade",
    parameters: numbers("shadow_strength", "shadow_decay", "shadow_depth"),
  },
  {
    title: "architecture.section.wood",
    parameters: numbers("girth_exponent", "twig_diameter", "internode_length"),
  },
];

/** Parameters that say what a stroke of the brush does; they stand in its panel. */
export const OF_THE_BRUSH = numbers("marker_density", "marker_max_age");

/** Parameters that foliage is made of; they stand in the panel of leaves. */
export const OF_THE_LEAVES = numbers("leaves_per_node", "leaf_size");

/** What a session begins with, and a reset goes back to. */
export const DEFAULTS: Parameters = {
  internode_length: 0.1,
  occupancy_radius: 1.5,
  perception_depth: 3,
  perception_angle: 90,
  phyllotactic_angle: 137.5,
  buds_per_node: 1,
  branching_angle: 50,
  deflection_angle: 5,
  apical_control: 0.52,
  mature_apical_control: 0.52,
  maturity_start: 0,
  maturity_steps: 0,
  light_sensitivity: 1,
  max_shoot_length: 4,
  shedding_threshold: 0,
  vigor_gain: 2,
  vigor_model: "borchert_honda",
  priority_least_weight: 0.006,
  priority_decline: 0.5,
  heading_weight: 0.5,
  tropism_weight: 0.25,
  space_weight: 0.25,
  phototropism: 0,
  setpoint_angle: 0,
  trunk_upward: true,
  tropism_from_stroke: false,
  gravimorphism_vertical: 1,
  gravimorphism_horizontal: 1,
  gravimorphism_shift: 0,
  marker_density: 0.15,
  markers_per_bud: 6,
  marker_max_age: 8,
  shadow_strength: 0.12,
  shadow_decay: 2,
  shadow_depth: 6,
  girth_exponent: 2.5,
  twig_diameter: 0.07,
  leaves_per_node: 4,
  leaf_size: 1,
};

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

/** The unit of a number in the present language; empty if it has none. */
export function unitOf({ unit }: NumberParameter): string {
  return unit === "parameters.unit.steps" ? say(unit) : (unit ?? "");
}

/** A value as it is read: no more digits than a step shows. */
export function shownValue(parameter: NumberParameter, value: number): string {
  return `${numberText(value, parameter.step)}${unitText(unitOf(parameter))}`;
}
