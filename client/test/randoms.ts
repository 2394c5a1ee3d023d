/** Numbers from 0 to 1 that only look random: the same seed gives the same row of them. */
export function randoms(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return (Math.imul(state ^ (state >>> 15), 2246822519) >>> 0) / 2 ** 32;
  };
}
