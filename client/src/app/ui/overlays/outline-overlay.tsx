import { useRef } from "preact/hooks";
import type { Studio } from "../../studio";
import { closedPath, useAnimationFrames } from "../use-animation-frames";

/** The lasso's outline: on the screen while it is drawn, in the world while the tree grows into it. */
export function OutlineOverlay({ studio }: { studio: Studio }) {
  const fill = useRef<SVGPathElement>(null);
  const outline = studio.outline.shown.value;
  const growing = outline?.stage === "growing" ? outline.places : null;
  useAnimationFrames(growing !== null, () => {
    const project = studio.stage.projector();
    const places = project && growing?.map((place) => project(place));
    const all = places?.every((place) => place !== null) ? places : [];
    fill.current?.setAttribute("d", closedPath(all.flatMap((place) => (place ? [place] : []))));
  });
  if (outline === null) {
    return null;
  }
  if (outline.stage === "growing") {
    return (
      <svg class="overlay outline" data-stage="growing" aria-hidden="true">
        <path class="outline-body" ref={fill} />
      </svg>
    );
  }
  const { points } = outline;
  const [first, last] = [points[0], points[points.length - 1]];
  const drawn = points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L");
  return (
    <svg class="overlay outline" data-stage="drawing" aria-hidden="true">
      <path class="outline-body" d={closedPath(points)} />
      {first && last && <path class="outline-closing" d={`M${last[0]} ${last[1]}L${first[0]} ${first[1]}`} />}
      <path class="outline-casing" d={`M${drawn}`} />
      <path class="outline-line" d={`M${drawn}`} />
    </svg>
  );
}
