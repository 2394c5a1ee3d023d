import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";

/** What the workspace measures, in pixels. */
const room = signal({ width: globalThis.innerWidth ?? 1024, height: globalThis.innerHeight ?? 768 });

/** The widths below which the bars fold, in pixels. */
const FOLDED_TOOL_BAR = 780;
const SMALL_WIDTH = 640;
const SMALL_HEIGHT = 560;

/** Whether the tool bar has no room for all its buttons. */
export function isToolBarFolded(): boolean {
  return room.value.width < FOLDED_TOOL_BAR;
}

/** Whether there is room for little more than the tree, as on a phone. */
export function isSmall(): boolean {
  return room.value.width < SMALL_WIDTH || room.value.height < SMALL_HEIGHT;
}

/** Measures the workspace from now on. */
export function useRoom(workspace: { readonly current: HTMLElement | null }): void {
  useEffect(() => {
    if (!workspace.current) {
      return undefined;
    }
    const observer = new ResizeObserver(([entry]) => {
      if (entry) {
        const { width, height } = entry.contentRect;
        room.value = { width, height };
      }
    });
    observer.observe(workspace.current);
    return () => observer.disconnect();
  }, [workspace]);
}
