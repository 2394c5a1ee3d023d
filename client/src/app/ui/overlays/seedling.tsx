import { useMemo, useRef } from "preact/hooks";
import type { Vec3 } from "../../../scene/vector";
import type { Studio } from "../../studio";
import { seedsToGrow } from "../../view/places";
import { useAnimationFrames } from "../use-animation-frames";

/** How high a seedling stands, in internodes, and at least in pixels: from afar it must still be found. */
const HEIGHT = 1.6;
const LEAST_PIXELS = 42;
/** A thousand sprouts on the page would be slower than the forest they become. */
const MOST_SHOWN = 60;

/** A sprout for each seed that has not grown yet, since the mesh shows nothing of it; and for what is about to be planted, or was and is not there yet. */
export function Seedlings({ studio }: { studio: Studio }) {
  const bed = useRef<HTMLDivElement>(null);
  // Each frame of rows may have sown seeds, or let them grow.
  const revision = studio.revision.value;
  const waiting = useMemo(() => seedsToGrow(studio.table, MOST_SHOWN), [studio, revision]);
  const tool = studio.tools.toolFor("plant");
  const coming = tool?.coming?.value;
  const finished = studio.finished.value;
  const planted = (tool?.planted?.value ?? []).filter(
    ({ place, command }) => command > finished && !waiting.some((other) => isSame(place, other)),
  );
  const ghosts = [...planted.map(({ place }) => place), ...(coming ? [coming] : [])];
  const places: readonly Vec3[] = [...waiting, ...ghosts];
  useAnimationFrames(places.length > 0, () => {
    const project = studio.stage.projector();
    places.forEach((place, i) => {
      const sprout = bed.current?.children[i];
      const at = project?.(place);
      if (sprout instanceof SVGElement) {
        sprout.style.visibility = at ? "visible" : "hidden";
        if (at) {
          sprout.style.width = `${Math.max(LEAST_PIXELS, HEIGHT * studio.stage.scaleAt(place))}px`;
          sprout.style.transform = `translate(${at[0]}px, ${at[1]}px) translate(-50%, -90%)`;
        }
      }
    });
  });
  return (
    <div ref={bed}>
      {places.map((place, i) => (
        <Sprout key={i < waiting.length ? place.join() : `coming-${i - waiting.length}`} coming={i >= waiting.length} />
      ))}
    </div>
  );
}

/** Whether a seed lies where it was asked for; places of rows are rounded. */
function isSame(a: Vec3, b: Vec3): boolean {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) < 0.1;
}

function Sprout({ coming }: { coming: boolean }) {
  return (
    <svg class="seedling" data-coming={coming} viewBox="0 0 60 60" aria-hidden="true">
      <ellipse cx="33" cy="54" rx="17" ry="3.6" fill="#33422a" opacity="0.28" />
      <path d="M30 54c-1.2-9-.8-17 .6-26" fill="none" stroke="#6d8a45" stroke-width="3" stroke-linecap="round" />
      <path d="M30.3 31C18 32.5 10 26.5 8 13.5 21 13 29.5 19 30.3 31Z" fill="#79a84f" />
      <path d="M30.5 29C31 17.5 38 9.5 51.5 7.5 52.5 20.5 44.5 29.5 30.5 29Z" fill="#92c060" />
      <path d="M30.3 31C24 25 17 19 8 13.5M30.5 29C36 21 43 14 51.5 7.5" fill="none" stroke="#557a38" opacity="0.5" />
    </svg>
  );
}
