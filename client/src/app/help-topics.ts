import { type Key, say } from "./words";
import { TABLE } from "./words/table";

export type SketchName = "draw" | "turn" | "grow" | "move" | "hold" | "cut";

/** One thing help knows. */
export interface Topic {
  readonly id: string;
  readonly title: string;
  readonly text: string;
  /** The keys, where it is about keys. */
  readonly keys?: string;
  /** The drawing that shows it. */
  readonly sketch?: SketchName;
}

export interface TopicGroup {
  readonly title: Key;
  readonly topics: readonly Topic[];
}

/** A text that has another that explains it, under its key with one of these at the end. */
const EXPLAINED = ".help";

const CARDS = ["draw", "turn", "grow", "move", "hold", "cut"] as const;
const DRAWING = ["depth", "rest", "sketch", "lasso", "seed"] as const;
const SHAPING = ["bend", "width", "prune", "branch", "what-if"] as const;
const TRAVELLING = ["travel", "sign", "fork"] as const;
const PANELS = ["architecture", "leaves", "branches", "background", "scene", "hide"] as const;

/** Keys by what they do; those that are named differently in each language stand in the table. */
const KEYS: readonly (readonly [Key, () => string])[] = [
  ["help.key.draw", () => "B  L  P"],
  ["help.key.shape", () => "N  W  X"],
  ["help.key.branch", () => "T  ← ↑ → ↓"],
  ["help.key.turn", () => "←  →"],
  ["help.key.radius", () => "[  ]"],
  ["help.key.grow", () => "G  U"],
  ["help.key.travel", () => ",  ."],
  ["help.key.undo", () => say("help.keys.undo")],
  ["help.key.frame", () => "F"],
  ["help.key.draw-mode", () => "D"],
  ["help.key.hide", () => "H"],
  ["help.key.escape", () => say("help.keys.escape")],
  ["help.key.space", () => say("help.keys.space")],
  ["help.key.alt-wheel", () => say("help.keys.alt-wheel")],
  ["help.key.help", () => "?"],
];

/** All that help knows, in the language spoken now. */
export function helpGroups(): readonly TopicGroup[] {
  const about = (name: (typeof DRAWING | typeof SHAPING | typeof TRAVELLING | typeof PANELS)[number]): Topic => ({
    id: name,
    title: say(`help.topic.${name}`),
    text: say(`help.topic.${name}.text`),
  });
  return [
    {
      title: "help.group.gestures",
      topics: CARDS.map((name) => ({
        id: `card-${name}`,
        title: say(`help.card.${name}`),
        text: say(`help.card.${name}.text`),
        sketch: name,
      })),
    },
    { title: "help.group.drawing", topics: DRAWING.map(about) },
    { title: "help.group.shaping", topics: SHAPING.map(about) },
    { title: "help.group.travelling", topics: TRAVELLING.map(about) },
    { title: "help.group.panels", topics: PANELS.map(about) },
    {
      title: "help.group.keys",
      topics: KEYS.map(([key, keys]) => ({ id: key, title: keys(), text: say(key), keys: keys() })),
    },
    { title: "help.group.controls", topics: controls() },
  ];
}

/** What a query finds: each of its words somewhere in a title or text, whatever case and accents. */
export function searched(groups: readonly TopicGroup[], query: string): readonly TopicGroup[] {
  const wanted = plain(query).split(/\s+/).filter(Boolean);
  return groups
    .map(({ title, topics }) => ({
      title,
      topics: topics.filter((topic) => {
        const words = plain(`${topic.title} ${topic.text} ${say(title)}`);
        return wanted.every((word) => words.includes(word));
      }),
    }))
    .filter(({ topics }) => topics.length > 0);
}

/** Every parameter and control that explains itself in a sentence; what a panel says need not be said again here. */
function controls(): readonly Topic[] {
  const seen = new Set<string>();
  return Object.keys(TABLE).flatMap((key) => {
    const explained = key.endsWith(EXPLAINED) ? key.slice(0, -EXPLAINED.length) : null;
    if (explained === null || !(explained in TABLE)) {
      return [];
    }
    const topic = { id: explained, title: say(explained as Key), text: say(key as Key) };
    const same = `${topic.title} ${topic.text}`;
    if (seen.has(same)) {
      return [];
    }
    seen.add(same);
    return [topic];
  });
}

function plain(text: string): string {
  return text.normalize("NFD").replace(/\p{M}/gu, "").toLowerCase();
}
