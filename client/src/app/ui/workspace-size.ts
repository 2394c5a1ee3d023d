import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";

/** What the workspace measures, in pixels. */
const size = signal({ width: globalThis.innerWidth ?? 1024, height: globalThis.innerHeight ?? 768 });

/** The sizes below which the bars fold, in pixels: as they are, and with the names of their buttons. */
const BARE = { toolBar: 948, width: 640, height: 560 };
/** The width of a button with its name, with what lies between two. */
const NAMED_TARGET = 70;
const NAMED = { toolBar: 1336, width: 640, height: 780 };

/** Whether the tool bar has no room for all its buttons. */
export function isToolBarFolded(names: boolean): boolean {
  return size.value.width < (names ? NAMED : BARE).toolBar;
}

/** How many buttons the tool bar has room for in one row, at the sizes of `bars.css`, and with names in two: a third would lie on the side bar of a phone. */
export function roomOfToolBar(names: boolean): number {
  const { width } = size.value;
  const [target, around] = width < 440 ? [44, 25] : [48, 35];
  return names ? 2 * Math.floor((width - around) / NAMED_TARGET) : Math.floor((width - around) / target);
}

/** Whether there is room for little more than the tree, as on a phone. */
export function isSmall(names: boolean): boolean {
  const { width, height } = names ? NAMED : BARE;
  return size.value.width < width || size.value.height < height;
}

/** Measures the workspace from now on. */
export function useWorkspaceSize(workspace: { readonly current: HTMLElement | null }): void {
  useEffect(() => {
    if (!workspace.current) {
      return undefined;
    }
    const observer = new ResizeObserver(([entry]) => {
      if (entry) {
        const { width, height } = entry.contentRect;
        size.value = { width, height };
      }
    });
    observer.observe(workspace.current);
    return () => observer.disconnect();
  }, [workspace]);
}
