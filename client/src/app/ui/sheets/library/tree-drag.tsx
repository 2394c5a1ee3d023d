import { signal } from "@preact/signals";
import type { SavedTree } from "../../../../wire/generated";
import { say } from "../../../words/say";

/** So near the end of a list, in pixels, it scrolls, and so fast a frame. */
const EDGE = 44;
const STEP = 8;

export interface TreeDragOptions {
  /** They are let go on the collection with this id, or, where that is empty, on none. */
  readonly dropped: (trees: readonly SavedTree[], collection: string) => void;
  /** They are let go beside every collection. */
  readonly missed: () => void;
}

interface Held {
  readonly trees: readonly SavedTree[];
  readonly x: number;
  readonly y: number;
  /** The collection below the pointer. */
  readonly over: string | null;
}

/** Trees on their way to a collection, from when they begin to be dragged until they are let go. */
export class TreeDrag {
  readonly held = signal<Held | null>(null);
  #options: TreeDragOptions;

  constructor(options: TreeDragOptions) {
    this.#options = options;
  }

  begin(trees: readonly SavedTree[], event: PointerEvent): void {
    const stop = new AbortController();
    const { signal } = stop;
    const end = () => {
      stop.abort();
      this.held.value = null;
    };
    const follow = ({ clientX: x, clientY: y }: PointerEvent) => {
      this.held.value = { trees, x, y, over: targetAt(x, y) };
    };
    const isIt = (other: PointerEvent) => other.pointerId === event.pointerId;
    addEventListener("pointermove", (moved) => isIt(moved) && follow(moved), { signal });
    addEventListener("pointercancel", (gone) => isIt(gone) && end(), { signal });
    addEventListener(
      "pointerup",
      (up) => {
        if (isIt(up)) {
          const over = targetAt(up.clientX, up.clientY);
          end();
          if (over === null) {
            this.#options.missed();
          } else {
            this.#options.dropped(trees, over);
          }
        }
      },
      { signal },
    );
    addEventListener(
      "keydown",
      (key) => {
        if (key.key === "Escape") {
          // The sheet stays.
          key.preventDefault();
          key.stopPropagation();
          end();
        }
      },
      { signal, capture: true },
    );
    follow(event);
    const scroll = () => {
      if (!signal.aborted) {
        scrollAt(this.held.peek());
        requestAnimationFrame(scroll);
      }
    };
    requestAnimationFrame(scroll);
  }
}

/** What is dragged, under the pointer. */
export function DragGhost({ drag }: { readonly drag: TreeDrag }) {
  const held = drag.held.value;
  if (held === null) {
    return null;
  }
  const [first] = held.trees;
  return (
    <div
      class="drag-ghost"
      data-over={held.over !== null}
      style={{ left: `min(${held.x}px, 100vw - 9rem)`, top: `${held.y}px` }}
    >
      {first?.thumbnail && <img src={first.thumbnail} alt="" />}
      <span>{held.trees.length === 1 ? first?.name : say("finding.dragging", { count: held.trees.length })}</span>
    </div>
  );
}

/** The collection that lies at a place of the page. */
function targetAt(x: number, y: number): string | null {
  return document.elementFromPoint(x, y)?.closest<HTMLElement>("[data-drop]")?.dataset.drop ?? null;
}

/** Scrolls the list of collections where the pointer is near one of its ends. */
function scrollAt(held: Held | null): void {
  const list = document.querySelector(".collections");
  if (held === null || list === null) {
    return;
  }
  const { left, right, top, bottom } = list.getBoundingClientRect();
  if (held.x < left || held.x > right || held.y < top || held.y > bottom) {
    return;
  }
  const step = (at: number, from: number, to: number) => (at - from < EDGE ? -STEP : to - at < EDGE ? STEP : 0);
  list.scrollBy(step(held.x, left, right), step(held.y, top, bottom));
}
