import { useEffect, useRef } from "preact/hooks";
import type { Studio } from "../studio";

/** How high the seedling stands, in internodes, and at least in pixels: from afar it must still be found. */
const HEIGHT = 1.6;
const LEAST_PIXELS = 42;

/** A sprout where the first stroke begins; the mesh shows nothing of a seed that has not grown yet. */
export function Seedling({ studio }: { studio: Studio }) {
  const sprout = useRef<SVGSVGElement>(null);
  const visible = studio.document.value?.metamers === 0 && studio.rows.value > 0;
  useEffect(() => {
    if (!visible) {
      return undefined;
    }
    let frame = 0;
    const follow = () => {
      frame = requestAnimationFrame(follow);
      const place = studio.seedPlace();
      const element = sprout.current;
      if (element) {
        element.style.visibility = place ? "visible" : "hidden";
        if (place) {
          const size = Math.max(LEAST_PIXELS, HEIGHT * place.pixelsPerInternode);
          element.style.width = `${size}px`;
          element.style.transform = `translate(${place.x}px, ${place.y}px) translate(-50%, -90%)`;
        }
      }
    };
    follow();
    return () => cancelAnimationFrame(frame);
  }, [visible, studio]);
  if (!visible) {
    return null;
  }
  return (
    <svg class="seedling" ref={sprout} viewBox="0 0 60 60" aria-hidden="true">
      <ellipse cx="33" cy="54" rx="17" ry="3.6" fill="#33422a" opacity="0.28" />
      <path d="M30 54c-1.2-9-.8-17 .6-26" fill="none" stroke="#6d8a45" stroke-width="3" stroke-linecap="round" />
      <path d="M30.3 31C18 32.5 10 26.5 8 13.5 21 13 29.5 19 30.3 31Z" fill="#79a84f" />
      <path d="M30.5 29C31 17.5 38 9.5 51.5 7.5 52.5 20.5 44.5 29.5 30.5 29Z" fill="#92c060" />
      <path d="M30.3 31C24 25 17 19 8 13.5M30.5 29C36 21 43 14 51.5 7.5" fill="none" stroke="#557a38" opacity="0.5" />
    </svg>
  );
}
