import { laminaPath } from "../../../../scene/painting/lamina";
import type { Species } from "../../../../wire/generated";

/** A leaf of a species, in its own colours. */
export function LeafSketch({ species: { appearance } }: { species: Species }) {
  const { leaves, bark } = appearance;
  return (
    <svg class="leaf-sketch" viewBox="0 0 24 24" aria-hidden="true">
      <path d="M12 23V9" fill="none" stroke={`rgb(${bark.tint.join(" ")})`} stroke-width="1.6" stroke-linecap="round" />
      <path d={laminaPath(leaves.shape, 24)} fill={`rgb(${leaves.tint.join(" ")})`} />
    </svg>
  );
}
