import { useEffect, useRef } from "preact/hooks";

/** Calls `draw` before each frame while `active`: what lies over the picture follows its camera. */
export function useAnimationFrames(active: boolean, draw: () => void): void {
  const latest = useRef(draw);
  latest.current = draw;
  useEffect(() => {
    if (!active) {
      return undefined;
    }
    let frame = 0;
    const follow = () => {
      frame = requestAnimationFrame(follow);
      latest.current();
    };
    follow();
    return () => cancelAnimationFrame(frame);
  }, [active]);
}

/** A closed path through places on the screen, for an SVG. */
export function closedPath(places: readonly (readonly [number, number])[]): string {
  return places.length === 0 ? "" : `M${places.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L")}Z`;
}
