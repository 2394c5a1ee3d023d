import { effect, type Signal, signal } from "@preact/signals";
import { asShown, type Shown, USUAL } from "../../scene/mode/shown";
import { BOUNDS } from "../../wire/generated";
import { type ExportChoice, FIRST_CHOICE, isExportChoice } from "../library/export-choice";
import { areUnsavedTrees, isSavedState, type SavedState, type UnsavedTree } from "../library/unsaved-tree";
import { isSymmetry, OFF, type Symmetry } from "../tools/symmetry/symmetry";
import { LANGUAGES, type Language } from "../words/say";

/** In what light the interface is shown. */
export type Theme = "light" | "dark";

/** What a person chose, kept on this device. */
export interface Settings {
  /** Where the tools stand: opposite the drawing hand. */
  readonly side: Signal<"left" | "right">;
  /** Whether a pen's pressure widens the brush. */
  readonly pressureWidens: Signal<boolean>;
  /** The brush's radius, in internodes. */
  readonly radius: Signal<number>;
  /** How strokes and outlines are repeated about the trunk. */
  readonly symmetry: Signal<Symmetry>;
  /** Whether the camera moves back when growth leaves the picture. */
  readonly followsGrowth: Signal<boolean>;
  /** Whether the first stroke has been drawn, after which the hint rests. */
  readonly hasDrawn: Signal<boolean>;
  /** The same for the first outline. */
  readonly hasOutlined: Signal<boolean>;
  /** From 0, a branch that is bent keeps its length, to 1, it stretches. */
  readonly stretch: Signal<number>;
  /** How deep a lasso's body is, 0.1 to 1: at 1 as deep as wide. */
  readonly lassoDepth: Signal<number>;
  /** Whether the strip of time is unfolded. */
  readonly timelineOpen: Signal<boolean>;
  /** The language chosen; null speaks as the browser asks. */
  readonly language: Signal<Language | null>;
  /** The theme chosen; null is the system's. */
  readonly theme: Signal<Theme | null>;
  /** Whether the tour was taken or waved away. */
  readonly tourSeen: Signal<boolean>;
  /** Whether every button shows its name. */
  readonly namesShown: Signal<boolean>;
  /** How a person wants to be called where they save; empty if not at all. */
  readonly author: Signal<string>;
  /** What trees were saved or opened as, by their sessions; the latest last. */
  readonly treeNames: Signal<Readonly<Record<string, string>>>;
  /** Whether it was read that the picture is slow here. */
  readonly slownessRead: Signal<boolean>;
  /** Whether the picture at rest is the whole one also where that takes long. */
  readonly thorough: Signal<boolean>;
  /** What is shown of the picture. */
  readonly shown: Signal<Shown>;
  /** What was downloaded last. */
  readonly exportChoice: Signal<ExportChoice>;
  /** The session to come back to. */
  readonly lastSession: Signal<string | null>;
  /** Trees that were left and not saved, the last one first. */
  readonly unsavedTrees: Signal<readonly UnsavedTree[]>;
  /** The session whose tree is saved as it stands, and the place in its time that was saved. */
  readonly savedState: Signal<SavedState | null>;
}

/** Reads the settings and keeps them as they change. */
export function loadSettings(store: Storage): Settings {
  return {
    side: kept(store, "side", "left", (value) => value === "left" || value === "right"),
    pressureWidens: kept(store, "pen-pressure", true, (value) => typeof value === "boolean"),
    radius: kept(store, "radius", 4, isWithin(BOUNDS.BrushRadius)),
    symmetry: kept<Symmetry>(store, "symmetry", OFF, isSymmetry),
    followsGrowth: kept(store, "follow-growth", true, (value) => typeof value === "boolean"),
    hasDrawn: kept(store, "drawn", false, (value) => typeof value === "boolean"),
    hasOutlined: kept(store, "outlined", false, (value) => typeof value === "boolean"),
    stretch: kept(store, "stretch", 0.3, isWithin(BOUNDS.Share)),
    lassoDepth: kept(store, "lasso-depth", 1, isWithin(BOUNDS.Depth)),
    // On a phone the strip that turns the tree has its place first.
    timelineOpen: kept(
      store,
      "timeline",
      (globalThis.innerWidth ?? 1024) >= 560,
      (value) => typeof value === "boolean",
    ),
    language: kept<Language | null>(store, "language", null, (value) => LANGUAGES.some((known) => known === value)),
    theme: kept<Theme | null>(store, "theme", null, (value) => value === "light" || value === "dark"),
    tourSeen: kept(store, "tour", false, (value) => typeof value === "boolean"),
    namesShown: kept(store, "names", false, (value) => typeof value === "boolean"),
    author: kept(store, "author", "", (value) => typeof value === "string"),
    treeNames: kept<Readonly<Record<string, string>>>(store, "tree-names", {}, isNames),
    slownessRead: kept(store, "slowness-read", false, (value) => typeof value === "boolean"),
    thorough: kept(store, "whole-picture", false, (value) => typeof value === "boolean"),
    shown: keptShown(store),
    exportChoice: kept<ExportChoice>(store, "export", FIRST_CHOICE, isExportChoice),
    lastSession: kept<string | null>(store, "session", null, (value) => typeof value === "string"),
    unsavedTrees: kept<readonly UnsavedTree[]>(store, "unsaved", [], areUnsavedTrees),
    savedState: kept<SavedState | null>(store, "saved", null, isSavedState),
  };
}

/** What was added to the table since it was kept is as usual. */
function keptShown(store: Storage): Signal<Shown> {
  const setting = kept<Shown>(store, "shown", USUAL, (value) => typeof value === "object" && value !== null);
  setting.value = asShown(setting.peek());
  return setting;
}

/** Whether a value that was kept is a number between bounds. */
function isWithin({ least, most }: { readonly least: number; readonly most: number }) {
  return (value: unknown) => typeof value === "number" && value >= least && value <= most;
}

function isNames(value: unknown): boolean {
  return typeof value === "object" && value !== null && Object.values(value).every((name) => typeof name === "string");
}

/** A value that is kept in a store under a name; what else stands there is not taken. */
export function kept<Value>(
  store: Storage,
  name: string,
  fallback: Value,
  valid: (value: unknown) => boolean,
): Signal<Value> {
  const key = `espalier.${name}`;
  let initial = fallback;
  try {
    const value: unknown = JSON.parse(store.getItem(key) ?? "null");
    initial = valid(value) ? (value as Value) : fallback;
  } catch {
    // Something else stands there; the fallback takes its place.
  }
  const setting = signal<Value>(initial);
  effect(() => {
    try {
      store.setItem(key, JSON.stringify(setting.value));
    } catch {
      // Private windows may forbid storing; the setting then lives as long as the page.
    }
  });
  return setting;
}
