/** How much of its sway a tree usually keeps where no hand is. */
export const ELSEWHERE = 0.25;

/** What a hand works at. */
export interface Hand {
  /** The rows under it; none where it lies on no branch. */
  readonly rows: readonly number[];
  /** How much of its sway the tree keeps elsewhere, from 0 to 1. */
  readonly elsewhere: number;
}
