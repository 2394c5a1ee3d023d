import { useRef } from "preact/hooks";

/** A finger is held when it has stayed for so many milliseconds. */
const HOLD = 500;
/** One that has gone so far, in pixels, scrolls. */
const LEAVES = 10;

/** Handlers of a button that also answers to a finger that is held on it; the tap that would follow is none. */
export function useHold(held: () => void, tapped: () => void) {
  const begun = useRef<{ readonly x: number; readonly y: number; readonly timer: number } | null>(null);
  const wasHeld = useRef(false);
  const end = () => {
    clearTimeout(begun.current?.timer);
    begun.current = null;
  };
  return {
    onPointerDown: ({ pointerType, clientX: x, clientY: y }: PointerEvent) => {
      wasHeld.current = false;
      if (pointerType === "mouse") {
        return;
      }
      const timer = window.setTimeout(() => {
        wasHeld.current = true;
        held();
      }, HOLD);
      begun.current = { x, y, timer };
    },
    onPointerMove: ({ clientX, clientY }: PointerEvent) => {
      if (begun.current && Math.hypot(clientX - begun.current.x, clientY - begun.current.y) > LEAVES) {
        end();
      }
    },
    onPointerUp: end,
    onPointerCancel: end,
    // A browser's own menu would end the hold.
    onContextMenu: (event: Event) => event.preventDefault(),
    onClick: () => {
      if (!wasHeld.current) {
        tapped();
      }
      wasHeld.current = false;
    },
  };
}
