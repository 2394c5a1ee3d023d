import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";

/** What the workspace measures, in pixels. */
const size = signal({ width: globalThis.innerWidth ?? 1024, height: globalThis.innerHeight ?? 768 });

/** The sizes below which the bars fold, in pixels: as they are, and with the names of their buttons. */
const BARE = { toolBar: 948, width: 640, height: 560 };
const NAMED = { toolBar: 1336, width: 640, height: 780 };

/** Whether the tool bar has no room for all its buttons. */
export function isToolBarFolded(names: boolean): boolean {
  return size.value.width < (names ? NAMED : BARE).toolBar;
}

/** How many buttons one row of the tool bar has room for, at the sizes of `bars.css`; with names it takes several rows. */
export function roomOfToolBar(names: boolean): number {
  const { width } = size.value;
  const [target, around] = width < 440 ? [44, 25] : [48, 35];
  return names ? Number.POSITIVE_INFINITY : Math.floor((width - around) / target);
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
