import { say } from "../../words/say";
import type { Symmetry } from "./symmetry";

/** A symmetry in words. */
export function symmetryText({ kind, around, mirrored }: Symmetry): string {
  return say(`tools.symmetry.${kind === "around" && mirrored ? "around-mirrored" : kind}`, { count: around });
}
