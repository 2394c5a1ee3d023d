import { signal } from "@preact/signals";

/** Cards over the workspace, one at a time. */
export const SHEET_NAMES = ["save", "leave", "library", "share", "download", "help", "settings"] as const;
export type SheetName = (typeof SHEET_NAMES)[number];

/** The panels, as they stand in the tool bar. */
export const PANEL_NAMES = ["architecture", "brush", "leaves", "branches", "background", "scene"] as const;
export type PanelName = (typeof PANEL_NAMES)[number];

/** What stands on the page around the picture. */
export class Layout {
  readonly sheet = signal<SheetName | null>(null);
  readonly panel = signal<PanelName | null>(null);
  /** Whether nothing but the workspace is shown. */
  readonly bare = signal(false);

  togglePanel(panel: PanelName): void {
    this.panel.value = this.panel.peek() === panel ? null : panel;
  }
}
