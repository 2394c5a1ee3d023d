import type { Timeline, TimelineFuture } from "../../../wire/generated";
import { partsOf } from "./authors";
import type { TimeScale } from "./timeline";

/** Neighbouring operations that share one sign on the strip, because there is no room for each. */
export interface Cluster {
  /** The first of them and the last, by number. */
  readonly from: number;
  readonly to: number;
  /** The middle of the sign, in pixels. */
  readonly x: number;
}

/** The signs for a strip of a width, none nearer to the next than `room` pixels. */
export function clusters(scale: TimeScale, width: number, room: number): Cluster[] {
  const found: Cluster[] = [];
  const middle = (i: number) => (((scale.edges[i] ?? 0) + (scale.edges[i + 1] ?? 1)) / 2) * width;
  const count = scale.edges.length - 1;
  for (let from = 0, next = 0; from < count; from = next) {
    next = from + 1;
    while (next < count && middle(next) - middle(from) < room) {
      next += 1;
    }
    const x = (middle(from) + middle(next - 1)) / 2;
    const last = found[found.length - 1];
    found.push({ from, to: next - 1, x: last ? Math.max(x, last.x + room) : x });
  }
  return found;
}

/** A future as it is reached from the present line: perhaps by way of others. */
export interface Branching {
  readonly future: TimelineFuture;
  /** The step at which one leaves the present line for it. */
  readonly leaves: number;
  /** How many futures lie on the way. */
  readonly depth: number;
}

/** Where other futures branch off, those too near to each other as one. */
export interface Fork {
  readonly x: number;
  readonly futures: readonly Branching[];
}

/** The forks for a strip of a width, none nearer to the next than `room` pixels. */
export function forks(futures: readonly TimelineFuture[], scale: TimeScale, width: number, room: number): Fork[] {
  const found: { x: number; futures: Branching[] }[] = [];
  for (const branching of branchings(futures)) {
    const x = scale.placeOf(branching.leaves) * width;
    const last = found[found.length - 1];
    if (last && x - last.x < room) {
      last.futures.push(branching);
    } else {
      found.push({ x, futures: [branching] });
    }
  }
  return found;
}

/** All futures in the order in which they leave the present line, each followed by those that hang on it. */
export function branchings(futures: readonly TimelineFuture[]): Branching[] {
  const hanging = (on: number | undefined) =>
    futures.filter((future) => future.on === on).sort((a, b) => a.from - b.from || a.future - b.future);
  const seen = new Set<number>();
  const follow = (future: TimelineFuture, leaves: number, depth: number): Branching[] => {
    if (seen.has(future.future)) {
      return [];
    }
    seen.add(future.future);
    return [{ future, leaves, depth }, ...hanging(future.future).flatMap((next) => follow(next, leaves, depth + 1))];
  };
  return hanging(undefined).flatMap((future) => follow(future, future.from, 0));
}

/** How many people did something on any of these lines. */
export function peopleOf({ operations, futures }: Pick<Timeline, "operations" | "futures">): number {
  const all = [operations, ...futures.map((future) => future.operations)].flat();
  return new Set(all.flatMap(partsOf).map(({ author }) => author)).size;
}
