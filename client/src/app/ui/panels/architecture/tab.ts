import { signal } from "@preact/signals";

/** The parts of the panel of architecture. */
export const TABS = ["species", "form", "growth"] as const;
export type Tab = (typeof TABS)[number];

/** The part that is shown; it outlasts the panel, which opens as it was closed. */
export const tab = signal<Tab>("species");
