import { useRef } from "preact/hooks";
import type { Studio } from "../../studio";
import { sweptPath } from "../../tools/brush/trail-shape";
import { useAnimationFrames } from "../use-animation-frames";

/** The ghost of a limb is so thick at its foot and at its tip, in internodes, and nowhere thinner than this, in pixels. */
const [FOOT, TIP, LEAST] = [0.16, 0.07, 1.2];
const SVG = "http://www.w3.org/2000/svg";

/** What was drawn and has not grown yet: a limb from the wood that has come to the brush, in the brush's breadth. */
export function StrokeGhosts({ studio }: { studio: Studio }) {
  const layer = useRef<SVGSVGElement>(null);
  const shown = studio.trail.shown.value;
  useAnimationFrames(shown, () => {
    const svg = layer.current;
    if (!svg) {
      return;
    }
    const project = studio.stage.projector();
    const ghosts = project ? studio.trail.ghosts(performance.now()) : [];
    while (svg.children.length > ghosts.length) {
      svg.lastChild?.remove();
    }
    ghosts.forEach(({ places, opacity }, i) => {
      const seen = places.flatMap((place) => {
        const at = project?.(place.position);
        return at ? [{ at, radius: place.radius }] : [];
      });
      const tip = places.at(-1);
      const scale = tip ? studio.stage.scaleAt(tip.position) : 0;
      const points = seen.map(({ at }) => at);
      const last = Math.max(1, points.length - 1);
      const [breadth, limb] = pathsOf((svg.children[i] ?? svg.appendChild(fresh())) as SVGGElement);
      breadth.setAttribute(
        "d",
        sweptPath(points, (k) => (seen[k]?.radius ?? 0) * scale),
      );
      limb.setAttribute(
        "d",
        sweptPath(points, (k) => Math.max(LEAST, scale * (FOOT + (TIP - FOOT) * (k / last)))),
      );
      breadth.parentElement?.setAttribute("opacity", opacity.toFixed(2));
    });
  });
  return shown ? <svg class="overlay stroke-ghosts" aria-hidden="true" ref={layer} /> : null;
}

function fresh(): SVGGElement {
  const group = document.createElementNS(SVG, "g");
  for (const name of ["stroke-ghost-breadth", "stroke-ghost-limb"]) {
    group.appendChild(document.createElementNS(SVG, "path")).setAttribute("class", name);
  }
  return group;
}

function pathsOf(group: SVGGElement): [Element, Element] {
  return [group.firstElementChild!, group.lastElementChild!];
}
