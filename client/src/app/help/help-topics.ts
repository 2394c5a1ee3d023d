import { SHOWN_NAMES } from "../../scene/mode/shown";
import { PARAMETERS } from "../../wire/generated-tables";
import { type Group, SECTIONS, WIDGETS } from "../document/growth/growth-parameters";
import type { PanelName, SheetName } from "../page/layout";
import type { ToolDescriptor, ToolLater } from "../tools/descriptor";
import { TOOL_NAMES, TOOLS, type ToolName, toolFor } from "../tools/tools";
import { inAll, type Key, keysSaid, say, type Text } from "../words/say";
import type { PlaceName } from "./help-places";

export type SketchName = "draw" | "turn" | "grow" | "move" | "hold" | "cut";

/** What a topic speaks of, to be shown. */
export type Subject =
  | { readonly panel: PanelName; readonly tab?: "species" | "form" | "growth"; readonly control?: Control }
  | { readonly sheet: SheetName }
  | { readonly tool: ToolName; readonly control?: Control }
  | { readonly place: PlaceName }
  | { readonly tour: true }
  | { readonly page: string };

/** A control of a panel or of a tool, and the section it is folded into. */
export interface Control {
  readonly label: Key;
  readonly section?: string;
}

/** One entry of the help. */
export interface Topic {
  readonly id: string;
  readonly title: string;
  readonly text: string;
  /** Other words for it. */
  readonly also?: string;
  /** All of it in every language: who reads one may know a word in another. */
  readonly everywhere: string;
  /** The keys, where it is about keys. */
  readonly keys?: string;
  /** The drawing that shows it. */
  readonly sketch?: SketchName;
  readonly subject?: Subject;
}

export interface TopicGroup {
  readonly title: Key;
  readonly topics: readonly Topic[];
}

/** A text that has another that explains it, under its key with one of these at the end. */
const EXPLAINED = ".help";

type Named<Name extends string> = readonly (readonly [Name, Subject?])[];

const CARDS = [
  ["draw", { tool: "brush" }],
  ["turn", { place: "rotation" }],
  ["grow", { place: "grow" }],
  ["move"],
  ["hold", { tool: "brush" }],
  ["cut", { tool: "brush" }],
] as const satisfies Named<SketchName>;

/** Topics by their names, each with what it speaks of. */
const TRAVELLING = [
  ["travel", { place: "timeline" }],
  ["sign", { place: "timeline" }],
  ["fork", { place: "timeline" }],
  ["undo", { place: "undo" }],
] as const;
const LOOKING = [
  ["rotation", { place: "rotation" }],
  ["fit", { place: "fit" }],
  ["size", { place: "size" }],
  ["sun", { panel: "background", control: { label: "background.time", section: "background.sun" } }],
  ["draw-modes", { place: "draw-modes" }],
  ["hide", { place: "hide" }],
] as const;
const PANELS = [
  ["architecture", { panel: "architecture" }],
  ["species", { panel: "architecture", tab: "species" }],
  ["brush-panel", { panel: "brush" }],
  ["symmetry", { panel: "brush", control: { label: "brush.symmetry", section: "brush.symmetry" } }],
  ["leaves", { panel: "leaves" }],
  ["branches", { panel: "branches" }],
  ["background", { panel: "background" }],
  ["wind", { panel: "wind" }],
  ["structure", { panel: "structure" }],
  ["grammars", { panel: "grammars" }],
  ["scene", { panel: "scene" }],
  ["import", { panel: "scene" }],
] as const;
const WHOLE = [
  ["new", { place: "new" }],
  ["save", { sheet: "save" }],
  ["library", { sheet: "library" }],
  ["share", { sheet: "share" }],
  ["people", { sheet: "people" }],
  ["accounts", { sheet: "accounts" }],
  ["comments", { panel: "comments" }],
  ["variations", { sheet: "variations" }],
  ["download", { sheet: "download" }],
  ["install"],
  ["api", { page: "/api" }],
  ["settings", { sheet: "settings" }],
  ["help", { tour: true }],
] as const satisfies Named<string>;

/** Keys by what they do; those that are named differently in each language stand in the table. */
const KEYS: readonly (readonly [Key, () => string])[] = [
  ["help.key.branch", () => `${TOOLS.branch.key}  ← ↑ → ↓`],
  ["help.key.turn", () => "←  →"],
  ["help.key.radius", () => "[  ]"],
  ["help.key.symmetry", () => "Y"],
  ["help.key.grow", () => "G  U"],
  ["help.key.travel", () => ",  ."],
  ["help.key.undo", () => say("help.keys.undo")],
  ["help.key.fit", () => "F"],
  ["help.key.draw-mode", () => "D"],
  ["help.key.shown", () => `1 – ${SHOWN_NAMES.length}  0`],
  ["help.key.wind", () => "A"],
  ["help.key.hide", () => "H"],
  ["help.key.escape", () => say("help.keys.escape")],
  ["help.key.space", () => say("help.keys.space")],
  ["help.key.alt-wheel", () => say("help.keys.alt-wheel")],
  ["help.key.help", () => "?"],
];

/** What the tools say of themselves. */
export type ToolHelp = Readonly<Record<ToolName, ToolLater>>;

/** All entries of the help, in the present language. */
export function helpGroups(tools: ToolHelp): readonly TopicGroup[] {
  const about = ([name, subject]:
    | (typeof TRAVELLING)[number]
    | (typeof LOOKING)[number]
    | (typeof PANELS)[number]
    | (typeof WHOLE)[number]): Topic => ({
    id: name,
    title: say(`help.topic.${name}`),
    text: say(`help.topic.${name}.text`),
    also: say(`help.topic.${name}.words`),
    everywhere: everywhere(`help.topic.${name}`, `help.topic.${name}.text`, `help.topic.${name}.words`),
    ...(subject ? { subject } : {}),
  });
  return [
    {
      title: "help.group.gestures",
      topics: CARDS.map(([name, subject]: (typeof CARDS)[number] | readonly ["move", undefined]) => ({
        id: `card-${name}`,
        title: say(`help.card.${name}`),
        text: say(`help.card.${name}.text`),
        also: say(`help.card.${name}.words`),
        everywhere: everywhere(`help.card.${name}`, `help.card.${name}.text`, `help.card.${name}.words`),
        sketch: name,
        ...(subject ? { subject } : {}),
      })),
    },
    { title: "help.group.drawing", topics: toolTopics(tools, "drawing") },
    { title: "help.group.shaping", topics: toolTopics(tools, "shaping") },
    { title: "help.group.travelling", topics: TRAVELLING.map(about) },
    { title: "help.group.looking", topics: LOOKING.map(about) },
    { title: "help.group.panels", topics: PANELS.map(about) },
    { title: "help.group.whole", topics: WHOLE.map(about) },
    {
      title: "help.group.keys",
      topics: [
        keyTopic("keys-drawing", toolKeys("drawing"), ...toolLabels("drawing")),
        keyTopic("keys-shaping", toolKeys("shaping"), ...toolLabels("shaping")),
        ...KEYS.map(([key, keys]) => keyTopic(key, keys(), key)),
      ],
    },
    { title: "help.group.controls", topics: controls(tools) },
  ];
}

/** What a query finds: each of its words somewhere in a topic, else in any language, whatever case and accents. */
export function searched(groups: readonly TopicGroup[], query: string): readonly TopicGroup[] {
  const wanted = plain(query).split(/\s+/).filter(Boolean);
  const among = (textOf: (topic: Topic) => string) =>
    groups
      .map(({ title, topics }) => ({
        title,
        topics: topics.filter((topic) => {
          const words = plain(`${textOf(topic)} ${say(title)}`);
          return wanted.every((word) => words.includes(word));
        }),
      }))
      .filter(({ topics }) => topics.length > 0);
  const own = among(({ title, text, also = "" }) => `${title} ${text} ${also}`);
  return own.length > 0 ? own : among((topic) => topic.everywhere);
}

/** What the tools of a group say of themselves. */
function toolTopics(tools: ToolHelp, group: ToolDescriptor["group"]): readonly Topic[] {
  return toolsIn(group).flatMap((tool) =>
    tools[tool].HELP.map(({ name, title, text, words, place }) => ({
      id: name,
      title: say(title),
      text: say(text),
      also: say(words),
      everywhere: everywhere(title, text, words),
      subject: place ? { place } : { tool },
    })),
  );
}

function toolsIn(group: ToolDescriptor["group"]): readonly ToolName[] {
  return TOOL_NAMES.filter((name) => TOOLS[name].group === group);
}

function toolKeys(group: ToolDescriptor["group"]): string {
  return toolsIn(group)
    .map((name) => TOOLS[name].key)
    .join("  ");
}

function toolLabels(group: ToolDescriptor["group"]): readonly Text[] {
  return toolsIn(group).map((name) => TOOLS[name].label);
}

/** What some keys do. */
function keyTopic(id: string, keys: string, ...texts: readonly (Key | Text)[]): Topic {
  return {
    id,
    title: keys,
    text: texts.map((text) => say(text)).join(", "),
    also: say("help.group.keys.words"),
    everywhere: everywhere(...texts, "help.group.keys.words"),
    keys,
  };
}

/** What these texts are in every language. */
function everywhere(...keys: readonly (Key | Text)[]): string {
  return keys.map(inAll).join(" ");
}

/** Every parameter and control that explains itself in a sentence; what a panel says need not be said again here. */
function controls(tools: ToolHelp): readonly Topic[] {
  const seen = new Set<string>();
  const keys = new Set(keysSaid());
  return [...keys].flatMap((key) => {
    const explained = key.endsWith(EXPLAINED) ? key.slice(0, -EXPLAINED.length) : null;
    if (explained === null || !keys.has(explained)) {
      return [];
    }
    const label = explained as Key;
    const subject = subjectOf(label, tools);
    const topic = {
      id: explained,
      title: say(label),
      text: say(key as Key),
      everywhere: everywhere(label, key as Key),
      ...(subject ? { subject } : {}),
    };
    const same = `${topic.title} ${topic.text}`;
    if (seen.has(same)) {
      return [];
    }
    seen.add(same);
    return [topic];
  });
}

/** Where a control stands. */
function subjectOf(label: Key, tools: ToolHelp): Subject | undefined {
  const [area = "", name = ""] = label.split(".");
  const section = SECTION_OF[label] ?? SECTION_OF[area];
  const control = { label, ...(section === undefined ? {} : { section }) };
  switch (area) {
    case "parameters": {
      const { group } = PARAMETERS[name as keyof typeof PARAMETERS];
      const elsewhere = PLACE_OF_GROUP[group];
      if (elsewhere !== undefined) {
        return { panel: elsewhere.panel, control: { label, section: elsewhere.section } };
      }
      const folded = SECTIONS.find(({ parameters }) => parameters.some((one) => one.name === name))?.title;
      return group in WIDGETS
        ? { panel: "architecture", tab: "form", control: { label } }
        : { panel: "architecture", tab: "growth", control: { label, ...(folded ? { section: folded } : {}) } };
    }
    case "architecture":
      return { panel: "architecture", tab: "form" };
    case "leaves":
    case "flowers":
    case "fruits":
      return { panel: "leaves", control };
    case "bark":
      return { panel: "branches", control };
    case "background":
      return { panel: "background", control };
    case "wind":
      return { panel: "wind", control };
    case "structure":
    case "limbs":
      return { panel: "structure" };
    case "grammars":
      return { panel: "grammars" };
    case "brush":
      return { panel: "brush", control };
    case "scene":
      return { panel: "scene" };
    case "tools": {
      const tool = TOOL_NAMES.find((name) => tools[name].CONTROLS?.includes(label));
      // What is ahead is asked for while something is cut, in a bar of its own.
      return tool ? { tool, control } : { tool: toolFor("cut") };
    }
    default:
      return undefined;
  }
}

/** Parameters that stand in another panel than that of architecture. */
const PLACE_OF_GROUP: { readonly [Name in Group]?: { readonly panel: PanelName; readonly section: string } } = {
  brush: { panel: "brush", section: "brush.stroke" },
  leaves: { panel: "leaves", section: "leaves.leaves" },
};

/** The section that a control, or all of its area, is folded into. */
const SECTION_OF: Readonly<Record<string, string>> = {
  leaves: "leaves.leaves",
  flowers: "leaves.flowers",
  fruits: "leaves.fruits",
  "brush.lasso-depth": "brush.lasso",
  "brush.symmetry": "brush.symmetry",
  "brush.around": "brush.symmetry",
  "brush.around-mirrored": "brush.symmetry",
  "bark.kind": "branches.bark",
  "bark.tint": "branches.bark",
  "bark.relief": "branches.bark",
  bark: "branches.form",
  "background.time": "background.sun",
  "background.sun_azimuth": "background.sun",
  "background.sun_elevation": "background.sun",
  "background.pin": "background.sun",
  background: "background.surroundings",
  "wind.sag": "wind.wood",
  "wind.suppleness": "wind.wood",
  "wind.damping": "wind.wood",
  "wind.snow": "wind.weather",
  "wind.rain": "wind.weather",
  "wind.break": "wind.strength",
  wind: "wind.air",
};

function plain(text: string): string {
  return text.normalize("NFD").replace(/\p{M}/gu, "").toLowerCase();
}
