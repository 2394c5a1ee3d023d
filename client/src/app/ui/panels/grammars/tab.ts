import { signal } from "@preact/signals";

/** The parts of the panel of grammars: those to pick from, the text, and depth with the sliders. */
export const TABS = ["pick", "text", "depth"] as const;
export type GrammarTab = (typeof TABS)[number];

/** The one that is shown; it outlasts the panel. Null until somebody has chosen. */
export const tab = signal<GrammarTab | null>(null);
