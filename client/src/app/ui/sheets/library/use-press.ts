import { useRef } from "preact/hooks";

/** A finger is held when it has stayed for so many milliseconds. */
const HOLD = 500;
/** One that has gone so far, in pixels, scrolls; a mouse drags, and so does a finger that was held. */
const LEAVES = 10;

export interface Press {
  readonly tapped: () => void;
  readonly held: () => void;
  /** It begins to be dragged; absent where it cannot be. */
  readonly dragged?: ((at: PointerEvent) => void) | undefined;
  /** A finger pushes it so far to the right, in its own width; `null` when the finger is lifted. */
  readonly turned?: (pushed: number | null) => void;
}

/** Handlers of a button that is tapped, held, dragged and turned; the tap that would follow one of these is none. */
export function usePress({ tapped, held, dragged, turned }: Press) {
  const down = useRef<{ readonly x: number; readonly y: number; readonly timer: number } | null>(null);
  const isMore = useRef(false);
  /** Where a finger began to push. */
  const pushes = useRef<number | null>(null);
  const end = () => {
    clearTimeout(down.current?.timer);
    down.current = null;
  };
  const lifted = () => {
    end();
    if (pushes.current !== null) {
      pushes.current = null;
      turned?.(null);
    }
  };
  return {
    onPointerDown: ({ pointerType, button, clientX: x, clientY: y }: PointerEvent) => {
      isMore.current = false;
      if (button !== 0) {
        return;
      }
      const hold = () => {
        isMore.current = true;
        held();
      };
      down.current = { x, y, timer: pointerType === "mouse" ? 0 : window.setTimeout(hold, HOLD) };
    },
    onPointerMove: (event: PointerEvent) => {
      const { pointerType, clientX, clientY } = event;
      if (pushes.current !== null) {
        const { width } = (event.currentTarget as HTMLElement).getBoundingClientRect();
        turned?.((clientX - pushes.current) / width);
        return;
      }
      if (!down.current || Math.hypot(clientX - down.current.x, clientY - down.current.y) <= LEAVES) {
        return;
      }
      const [across, along] = [Math.abs(clientX - down.current.x), Math.abs(clientY - down.current.y)];
      if (turned && pointerType !== "mouse" && !isMore.current && across > along) {
        [isMore.current, pushes.current] = [true, down.current.x];
      }
      end();
      if (pushes.current === null && dragged && (pointerType === "mouse" || isMore.current)) {
        isMore.current = true;
        dragged(event);
      }
    },
    onPointerUp: lifted,
    onPointerCancel: lifted,
    // A finger that is held scrolls no more.
    onTouchMove: (event: TouchEvent) => {
      if (isMore.current && event.cancelable) {
        event.preventDefault();
      }
    },
    // Browsers would drag the picture, or open a menu of their own.
    onDragStart: (event: Event) => event.preventDefault(),
    onContextMenu: (event: Event) => event.preventDefault(),
    onClick: () => {
      if (!isMore.current) {
        tapped();
      }
      isMore.current = false;
    },
  };
}
