import { signal } from "@preact/signals";
import type { SavedTree } from "../../wire/generated";
import type { Gift } from "../library/gifts/gift-api";
import type { Pattern } from "../library/variations/order";

/** Cards over the workspace, one at a time. */
export const SHEET_NAMES = [
  "save",
  "leave",
  "library",
  "versions",
  "share",
  "gifts",
  "people",
  "accounts",
  "variations",
  "download",
  "help",
  "settings",
] as const;
export type SheetName = (typeof SHEET_NAMES)[number];

/** The panels, as they stand in the tool bar. */
export const PANEL_NAMES = [
  "architecture",
  "brush",
  "leaves",
  "branches",
  "background",
  "wind",
  "structure",
  "grammars",
  "scene",
] as const;
/** Panels of the tool bar, and the one of comments, which everybody has. */
export type PanelName = (typeof PANEL_NAMES)[number] | "comments";

/** What the library shows: its trees, those to begin new ones with, or those that can still be taken back. */
export const SECTION_NAMES = ["trees", "templates", "deleted"] as const;
export type SectionName = (typeof SECTION_NAMES)[number];

/** What is given to people and groups, and what is gone back to. */
export interface Given extends Gift {
  readonly from: "library" | "share" | "people";
  /** The collection that it lies in. */
  readonly within?: string | undefined;
}

/** What stands on the page around the picture. */
export class Layout {
  readonly sheet = signal<SheetName | null>(null);
  /** What the library shows when it is opened. */
  readonly section = signal<SectionName>("trees");
  /** The tree of the library that the sheet of versions is about. */
  readonly subject = signal<SavedTree | null>(null);
  /** The tree of the library that is shared; null for the one on the page. */
  readonly shared = signal<Pick<SavedTree, "id" | "name"> | null>(null);
  /** What is given to people and groups. */
  readonly given = signal<Given | null>(null);
  /** The tree of the library that is downloaded; null for the one on the page. */
  readonly taken = signal<SavedTree | null>(null);
  /** What the trees that are ordered are to be like; null where what was ordered is only looked at. */
  readonly pattern = signal<Pattern | null>(null);
  readonly panel = signal<PanelName | null>(null);
  /** Whether nothing but the workspace is shown. */
  readonly bare = signal(false);

  togglePanel(panel: PanelName): void {
    this.panel.value = this.panel.peek() === panel ? null : panel;
  }
}
