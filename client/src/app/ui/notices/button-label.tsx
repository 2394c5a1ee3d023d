import { useLayoutEffect, useRef } from "preact/hooks";
import type { NamedControl } from "../../input/button-holds";

/** What is left free between a label and the edge of the page. */
const MARGIN = 8;
/** A finger hides so much beside what it holds. */
const FINGER = 28;

/** The name of the button that a finger is held on, beside it, above whatever else is open. */
export function ButtonLabel({ control }: { control: NamedControl | null }) {
  const host = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    const label = host.current;
    if (!label?.showPopover || control === null) {
      return undefined;
    }
    label.showPopover();
    const { left, top } = besides(control.place, label.getBoundingClientRect());
    label.style.translate = `${left}px ${top}px`;
    return () => label.hidePopover();
  }, [control]);
  return (
    <div class="button-label" ref={host} popover="manual" role="tooltip">
      {control !== null && <strong>{control.name}</strong>}
      {control !== null && control.purpose !== "" && <span>{control.purpose}</span>}
    </div>
  );
}

/** Beside what stands at a side of the page, else below it, or above where there is no room. */
function besides(place: DOMRect, label: DOMRect): { left: number; top: number } {
  const [width, height] = [globalThis.innerWidth, globalThis.innerHeight];
  const within = (value: number, most: number) => Math.round(Math.max(MARGIN, Math.min(value, most - MARGIN)));
  const middle = place.top + place.height / 2;
  const isAside = middle > height / 6 && middle < (5 * height) / 6;
  if (isAside) {
    const right = place.right + FINGER;
    const left = place.left - FINGER - label.width;
    return {
      left: within(right + label.width > width - MARGIN ? left : right, width - label.width),
      top: within(middle - label.height / 2, height - label.height),
    };
  }
  const below = place.bottom + FINGER;
  return {
    left: within(place.left + place.width / 2 - label.width / 2, width - label.width),
    top: within(
      below + label.height > height - MARGIN ? place.top - FINGER - label.height : below,
      height - label.height,
    ),
  };
}
