import type { Handle } from "../../document/design/branch-handles";
import type { BranchShape } from "../../document/design/branch-shape";
import type { Hidden } from "../../document/design/hands-on";

type Pixel = readonly [x: number, y: number];
type Project = (point: readonly [number, number, number]) => Pixel | null;

/** Handles nearer to one another than this, in pixels, could not be told apart by a finger. */
const APART = 18;

/** Which handles are shown, and how many are not for which reason. */
export interface Shown {
  readonly ids: ReadonlySet<string>;
  readonly hidden: Hidden;
}

/**
 * The handles that a finger can hit. Of two that lie upon one another the one that is there comes before one that is not
 * there yet; what is held stays.
 */
export function shownHandles(
  handles: readonly Handle[],
  shape: BranchShape,
  project: Project,
  held: string | undefined,
): Shown {
  const [ids, taken] = [new Set<string>(), [] as Pixel[]];
  let [near, along] = [0, 0];
  const order = [...handles].sort((a, b) => rank(a, held) - rank(b, held));
  for (const handle of order) {
    const at = project(handle.place(shape));
    if (!at) {
      continue;
    }
    const isHeld = handle.id === held;
    const isFolded = handle.hides?.(shape, project) === true;
    const isCrowded = taken.some(([x, y]) => Math.hypot(x - at[0], y - at[1]) < APART);
    if (isHeld || (!isFolded && !isCrowded)) {
      ids.add(handle.id);
      taken.push(at);
    } else if (isFolded && handle.id.startsWith("side-")) {
      along += 1;
    } else {
      near += 1;
    }
  }
  // With no width to be seen at all it is the size that hides them.
  const isSideSeen = [...ids].some((id) => id.startsWith("side-"));
  return { ids, hidden: isSideSeen ? { near, along } : { near: near + along, along: 0 } };
}

function rank(handle: Handle, held: string | undefined): number {
  if (handle.id === held) {
    return 0;
  }
  return handle.isNew ? 2 : 1;
}
