import { useEffect, useRef, useState } from "preact/hooks";

/** A number that glides to where it should be; while it is held it stays. */
export function useEased(target: number, held: boolean): number {
  const [now, setNow] = useState(target);
  const latest = useRef(now);
  latest.current = now;
  useEffect(() => {
    if (held || latest.current === target) {
      return undefined;
    }
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) {
      setNow(target);
      return undefined;
    }
    let frame = requestAnimationFrame(function step() {
      const next = latest.current + (target - latest.current) * 0.25;
      const there = Math.abs(next - target) < 0.002 * Math.abs(target);
      setNow(there ? target : next);
      if (!there) {
        frame = requestAnimationFrame(step);
      }
    });
    return () => cancelAnimationFrame(frame);
  }, [target, held]);
  return now;
}
