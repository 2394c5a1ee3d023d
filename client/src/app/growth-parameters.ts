import type { Parameters, ParametersPatch } from "../wire/generated";

type NumberNames<Set> = { [Name in keyof Set]: Set[Name] extends number ? Name : never }[keyof Set];

/** A parameter that is a number. */
export type NumberName = NumberNames<Parameters>;

/** How one number is shown and set. Ranges are those of `PROTOCOL.md`. */
export interface NumberParameter {
  readonly kind: "number";
  readonly name: NumberName;
  readonly label: string;
  readonly symbol?: string;
  readonly unit?: string;
  readonly least: number;
  readonly most: number;
  readonly step: number;
  /** What it does, in a line. */
  readonly hint: string;
  /** Whether it has an effect as things are. */
  readonly applies?: (parameters: Parameters) => boolean;
}

export interface SwitchParameter {
  readonly kind: "switch";
  readonly name: "trunk_upward" | "tropism_from_stroke";
  readonly label: string;
  readonly hint: string;
}

export interface ChoiceParameter {
  readonly kind: "choice";
  readonly name: "vigor_model";
  readonly label: string;
  readonly choices: readonly { readonly value: Parameters["vigor_model"]; readonly label: string }[];
  readonly hint: string;
}

export type GrowthParameter = NumberParameter | SwitchParameter | ChoiceParameter;

export interface Section {
  readonly title: string;
  readonly parameters: readonly GrowthParameter[];
}

const priority = ({ vigor_model }: Parameters) => vigor_model === "priority";
const borchertHonda = ({ vigor_model }: Parameters) => vigor_model === "borchert_honda";
const maturing = (parameters: Parameters) => borchertHonda(parameters) && parameters.maturity_steps > 0;

function number(
  name: NumberName,
  label: string,
  [least, most, step]: readonly [number, number, number],
  hint: string,
  more: Pick<NumberParameter, "symbol" | "unit" | "applies"> = {},
): NumberParameter {
  return { kind: "number", name, label, least, most, step, hint, ...more };
}

/** All parameters of growth, as the panel shows them. */
export const SECTIONS: readonly Section[] = [
  {
    title: "Vigor",
    parameters: [
      {
        kind: "choice",
        name: "vigor_model",
        label: "Vigor model",
        choices: [
          { value: "borchert_honda", label: "Borchert-Honda" },
          { value: "priority", label: "Priority" },
        ],
        hint: "How vigor is shared out among branches",
      },
      number("apical_control", "Apical control", [0.4, 0.7, 0.005], "High: one trunk. Low: a spreading crown.", {
        symbol: "λ",
        applies: borchertHonda,
      }),
      number(
        "maturity_steps",
        "Steps to maturity",
        [0, 500, 1],
        "Over so many steps apical control changes; 0: never",
        {
          applies: borchertHonda,
        },
      ),
      number("maturity_start", "Maturing begins", [0, 500, 1], "Steps after the seed was planted", {
        unit: "steps",
        applies: maturing,
      }),
      number("mature_apical_control", "Mature apical control", [0.4, 0.7, 0.005], "What apical control changes to", {
        applies: maturing,
      }),
      number("priority_least_weight", "Least weight", [0.001, 1, 0.001], "Weight of what ranks last on an axis", {
        symbol: "w",
        applies: priority,
      }),
      number("priority_decline", "Decline", [0.05, 1, 0.01], "Share of the ranking over which weight falls", {
        symbol: "κₚ",
        applies: priority,
      }),
      number("light_sensitivity", "Light sensitivity", [0, 6, 0.1], "High: only well-lit buds grow", { symbol: "κ" }),
      number("max_shoot_length", "Longest shoot", [1, 20, 1], "Internodes the most vigorous bud adds in a step", {
        symbol: "n",
      }),
      number("vigor_gain", "Vigor gain", [0.1, 10, 0.1], "Vigor for each unit of light", { symbol: "α" }),
      number("shedding_threshold", "Shedding", [0, 1, 0.01], "Branches with less vigor for their size are shed", {
        symbol: "Th",
      }),
    ],
  },
  {
    title: "Direction",
    parameters: [
      number("heading_weight", "Straight on", [0, 1, 0.01], "Weight of an axis’ present heading", { symbol: "α" }),
      number("tropism_weight", "Tropism", [0, 1, 0.01], "Weight of the pull towards the set-point angle", {
        symbol: "β",
      }),
      number("space_weight", "Free space", [0, 1, 0.01], "Weight of the direction towards free space", { symbol: "γ" }),
      number("setpoint_angle", "Set-point angle", [0, 180, 1], "0° upwards, 90° level, 180° weeping", {
        symbol: "θ",
        unit: "°",
      }),
      {
        kind: "switch",
        name: "trunk_upward",
        label: "Trunk always upward",
        hint: "The trunk rises whatever the set-point angle is",
      },
      {
        kind: "switch",
        name: "tropism_from_stroke",
        label: "Tropism from the stroke",
        hint: "Branches tend along the brush stroke",
      },
      number("phototropism", "Phototropism", [0, 1, 0.01], "How far growth turns towards the light"),
    ],
  },
  {
    title: "Branching",
    parameters: [
      number("branching_angle", "Branching angle", [0, 120, 1], "Between a bud and the axis that bears it", {
        symbol: "ψ",
        unit: "°",
      }),
      number("phyllotactic_angle", "Phyllotaxis", [0, 180, 0.5], "Between one bud and the next around the axis", {
        symbol: "φ",
        unit: "°",
      }),
      number("buds_per_node", "Buds at a node", [1, 4, 1], "1 alternate, 2 opposite, more whorled"),
      number("deflection_angle", "Deflection", [0, 45, 0.5], "An axis turns away from the bud it has passed", {
        symbol: "δ",
        unit: "°",
        applies: ({ buds_per_node }) => buds_per_node === 1,
      }),
      number("gravimorphism_shift", "Gravimorphism", [-0.99, 0.99, 0.01], "Above 0 buds on top, below 0 underneath"),
      number("gravimorphism_vertical", "Top and underside", [0.05, 3, 0.05], "Vertical half-axis of the ellipse", {
        symbol: "sᵥ",
      }),
      number("gravimorphism_horizontal", "Flanks", [0.05, 3, 0.05], "Horizontal half-axis of the ellipse", {
        symbol: "sₚ",
      }),
    ],
  },
  {
    title: "Space",
    parameters: [
      number("occupancy_radius", "Occupancy", [0.5, 6, 0.1], "Radius of the zone a bud occupies", { symbol: "r" }),
      number("perception_depth", "Perception", [0.5, 10, 0.1], "How far beyond it a bud perceives", { symbol: "d" }),
      number("perception_angle", "Perception angle", [20, 360, 1], "How wide it perceives", {
        symbol: "ζ",
        unit: "°",
      }),
      number("marker_density", "Marker density", [0.01, 1, 0.01], "Markers the brush sows per cubic internode"),
      number("markers_per_bud", "Markers for a bud", [1, 32, 1], "While it grows without guidance"),
      number("marker_max_age", "Marker age", [1, 60, 1], "Steps a marker of the brush lives", { unit: "steps" }),
    ],
  },
  {
    title: "Shade",
    parameters: [
      number("shadow_strength", "Shadow", [0, 1, 0.01], "Shadow a metamer casts", { symbol: "a" }),
      number("shadow_decay", "Fading", [1.1, 4, 0.1], "How fast it fades downwards", { symbol: "b" }),
      number("shadow_depth", "Reach", [0, 8, 1], "How far down it reaches", { symbol: "q" }),
    ],
  },
  {
    title: "Wood and leaves",
    parameters: [
      number("internode_length", "Internode", [0.005, 1, 0.005], "Its length in what is exported", {
        symbol: "l",
        unit: "m",
      }),
      number("girth_exponent", "Girth exponent", [2, 3, 0.05], "Low: thick limbs. High: slender ones.", {
        symbol: "n",
      }),
      number("twig_diameter", "Twigs", [0.02, 0.3, 0.01], "Diameter of a twig at its tip"),
      number("leaves_per_node", "Leaves at a node", [0, 15, 1], "On twigs"),
      number("leaf_size", "Leaf length", [0.1, 3, 0.05], "In internodes"),
    ],
  },
];

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

/** A value as it is read: no more digits than a step shows. */
export function shownValue({ step, unit = "" }: NumberParameter, value: number): string {
  const digits = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9));
  const space = unit === "" || unit === "°" ? "" : " ";
  return `${value.toFixed(digits).replace("-", "−")}${space}${unit}`;
}
