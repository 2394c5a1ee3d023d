import { computed, signal } from "@preact/signals";
import type { WidthConstraint } from "../../../wire/generated";

/** All widths that are set, as the server has them. */
export class WidthList {
  readonly all = signal<readonly WidthConstraint[]>([]);
  /** The rows whose width is set. */
  readonly rows = computed<ReadonlySet<number>>(() => new Set(this.all.value.map(({ row }) => row)));
}
