import type { Timeline, TimelineChange, TimelineOperation } from "../../../wire/generated";

/** The timeline of a document in which nothing was done. */
export const NOTHING_DONE: Timeline = { line: 0, step: 0, last_step: 0, done: 0, operations: [], futures: [] };

/** A timeline after a change of it (`TT6`). */
export function changed(timeline: Timeline, change: TimelineChange): Timeline {
  const { from, operations, changed: elsewhere = [], futures, ...now } = change;
  const kept = timeline.operations.slice(0, from);
  for (const { at, operation } of elsewhere) {
    kept[at] = operation;
  }
  return { ...now, operations: [...kept, ...operations], futures: futures ?? timeline.futures };
}

/** Operations that run for long would push all others off the strip: length counts by its root. */
const weightOf = ({ first, last }: TimelineOperation) => 1 + Math.sqrt(Math.max(0, last - first));

/** Where each step of a line of time stands on a strip from 0 to 1; operations without steps have a place as well. */
export class TimeScale {
  /** Where each operation begins, and in the end where the last one ends. */
  readonly edges: readonly number[];
  #operations: readonly TimelineOperation[];
  #done: number;

  constructor({ operations, done }: Pick<Timeline, "operations" | "done">) {
    const edges = [0];
    for (const operation of operations) {
      edges.push((edges[edges.length - 1] ?? 0) + weightOf(operation));
    }
    const whole = edges[edges.length - 1] || 1;
    this.edges = edges.map((edge) => edge / whole);
    this.#operations = operations;
    this.#done = done;
  }

  /** The place of a step; where settings were changed at that very step, of those changes that are in force. */
  placeOf(step: number): number {
    for (const [i, { first, last }] of this.#operations.entries()) {
      const passed = first < last ? last <= step : last < step || (last === step && i < this.#done);
      if (!passed) {
        const [from, to] = [this.edges[i] ?? 0, this.edges[i + 1] ?? 1];
        return first < last && step > first ? from + ((to - from) * (step - first)) / (last - first) : from;
      }
    }
    return this.edges[this.edges.length - 1] ?? 0;
  }

  /** The step nearest to a place. */
  stepAt(place: number): number {
    const i = this.operationAt(place);
    const operation = this.#operations[i];
    if (!operation) {
      return 0;
    }
    const [from, to] = [this.edges[i] ?? 0, this.edges[i + 1] ?? 1];
    const share = Math.min(1, Math.max(0, (place - from) / (to - from)));
    return Math.round(operation.first + share * (operation.last - operation.first));
  }

  /** The number of the operation at a place; −1 if there is none at all. */
  operationAt(place: number): number {
    const { length } = this.#operations;
    for (let i = 0; i < length; i += 1) {
      if (place < (this.edges[i + 1] ?? 1)) {
        return i;
      }
    }
    return length - 1;
  }
}

/** The step at the next edge of an operation before (−1) or after (1) a step; the same step where there is none. */
export function edgeBeside(operations: readonly TimelineOperation[], step: number, direction: -1 | 1): number {
  let nearest = step;
  for (const { first, last } of operations) {
    for (const edge of [first, last]) {
      const beyond = (edge - step) * direction;
      if (beyond > 0 && (nearest === step || beyond < (nearest - step) * direction)) {
        nearest = edge;
      }
    }
  }
  return nearest;
}
