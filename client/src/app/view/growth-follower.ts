import type { Box } from "../../scene/camera/camera-view";

/** The view as growth is followed with it. */
export interface FollowedView {
  /** Whether it shows the whole box, or is on its way there. */
  frames(box: Box): boolean;
  /** Moves back until it does. */
  widen(box: Box): void;
  /** How often the user has moved the camera. */
  readonly moves: number;
}

export interface FollowerOptions {
  readonly view: () => FollowedView | null;
  /** The box around all that has grown; null before the rows of the session have come. */
  readonly box: () => Box | null;
  /** Whether something grows. */
  readonly growing: () => boolean;
  /** Whether a finger is down or a lever held. */
  readonly held: () => boolean;
  readonly enabled: () => boolean;
}

/**
 * Moves the camera back when a growth leaves the picture: never under a finger, not once the user has moved the camera
 * within the same growth, and not where the picture showed only a part of the tree before.
 */
export class GrowthFollower {
  #options: FollowerOptions;
  /** What had grown before the growth in progress; null before anything is known. */
  #before: Box | null = null;
  /** How the growth in progress began. */
  #began: { readonly framed: boolean; readonly moves: number } | null = null;

  constructor(options: FollowerOptions) {
    this.#options = options;
  }

  /** Rows have changed, growth has begun or ended, or a finger has lifted. */
  follow(): void {
    const { view: find, box: measure, growing, held, enabled } = this.#options;
    const view = find();
    const measured = measure();
    if (!view || !measured) {
      return;
    }
    const box = copied(measured);
    const before = this.#before;
    this.#began ??= { framed: before !== null && view.frames(before), moves: view.moves };
    const { framed, moves } = this.#began;
    const free = enabled() && !held() && view.moves === moves;
    if (free && framed && before && exceeds(box, before) && !view.frames(box)) {
      view.widen(box);
    }
    if (!growing() && !held()) {
      this.#before = box;
      this.#began = null;
    }
  }

  /** Another session is opened. */
  forget(): void {
    this.#before = null;
    this.#began = null;
  }
}

function copied({ min, max }: Box): Box {
  return { min: [...min], max: [...max] };
}

function exceeds(box: Box, other: Box): boolean {
  const axes = [0, 1, 2] as const;
  return axes.some((axis) => box.min[axis] < other.min[axis] || box.max[axis] > other.max[axis]);
}
