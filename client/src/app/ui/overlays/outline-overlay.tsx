import { useRef } from "preact/hooks";
import type { Studio } from "../../studio";
import { closedPath, useAnimationFrames } from "../use-animation-frames";

/** The lasso's outline: on the screen while it is drawn, in the world while the tree grows into it. */
export function OutlineOverlay({ studio }: { studio: Studio }) {
  const fills = useRef<SVGSVGElement>(null);
  const outline = studio.outline.shown.value;
  const growing = outline?.stage === "growing" ? outline.outlines : null;
  useAnimationFrames(growing !== null, () => {
    const project = studio.stage.projector();
    growing?.forEach((outline, i) => {
      const places = outline.flatMap((place) => {
        const at = project?.(place);
        return at ? [at] : [];
      });
      fills.current?.children[i]?.setAttribute("d", closedPath(places.length === outline.length ? places : []));
    });
  });
  if (outline === null) {
    return null;
  }
  if (outline.stage === "growing") {
    return (
      <svg class="overlay outline" data-stage="growing" aria-hidden="true" ref={fills}>
        {outline.outlines.map((_, i) => (
          <path class="outline-body" key={i} />
        ))}
      </svg>
    );
  }
  const { points, repeated } = outline;
  const [first, last] = [points[0], points[points.length - 1]];
  const drawn = points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L");
  return (
    <svg class="overlay outline" data-stage="drawing" aria-hidden="true">
      {[points, ...repeated].map((outline, i) => (
        <path class="outline-body" key={i} d={closedPath(outline)} />
      ))}
      {first && last && <path class="outline-closing" d={`M${last[0]} ${last[1]}L${first[0]} ${first[1]}`} />}
      <path class="outline-casing" d={`M${drawn}`} />
      <path class="outline-line" d={`M${drawn}`} />
    </svg>
  );
}
