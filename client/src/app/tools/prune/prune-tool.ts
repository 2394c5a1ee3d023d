import { signal } from "@preact/signals";
import { CutOverlay } from "../../../scene/overlay/cut-overlay";
import type { TreeTable } from "../../../scene/table/tree-table";
import type { Vec3 } from "../../../scene/vector";
import { type Command, MAX_PRUNED_ROWS } from "../../../wire/generated";
import type { StrokePoint } from "../../input/gesture-recogniser";
import type { Key } from "../../words/say";
import type { ShapingView } from "../shaping-view";
import { PICK_TOLERANCE, type StrokeTool } from "../tool";
import { CutLine } from "./cut-line";
import { PruneRule, TRUNK_STAYS } from "./prune-rule";

/** A line shorter than this, in pixels, is a tap. */
const TAP = 8;
/** How long after its answer a cut may take to show in the rows, in milliseconds. */
const LINGERS = 1500;

export interface PruneOptions {
  readonly table: TreeTable;
  readonly view: ShapingView & { projector(): (point: Vec3) => readonly [number, number] | null };
  readonly submit: (command: Command) => void;
  /** How many commands of a kind the server has not yet answered. */
  readonly unsettled: (kind: Command["kind"]) => number;
  /** The rows whose width is set. */
  readonly limits: () => ReadonlySet<number>;
  readonly say: (text: Key) => void;
  /** Shows what would become of the tree without the branches at these rows. */
  readonly predict: (rows: readonly number[]) => void;
}

interface Cutting {
  readonly rule: PruneRule;
  readonly line: CutLine;
  readonly crossed: Set<number>;
  length: number;
}

/** Cuts branches off: by a tap, by a line drawn through them, or all that stand in the dark. */
export class PruneTool implements StrokeTool {
  /** The line as it is drawn. */
  readonly line = signal<readonly (readonly [number, number])[] | null>(null);
  /** Whether what the shears are at is not cut, but shown as it would be without. */
  readonly predicts = signal(false);
  /** How many branches the shears are at. */
  readonly marked = signal(0);

  #options: PruneOptions;
  #cutting: Cutting | null = null;
  #mark: CutOverlay | null = null;
  /** Where the branches begin that are marked whatever the shears are at. */
  #lasting: readonly number[] = [];
  /** What is cut and not yet gone from the table. */
  #falling = new Set<CutOverlay>();

  constructor(options: PruneOptions) {
    this.#options = options;
  }

  begin({ x, y }: StrokePoint): void {
    const { table, view } = this.#options;
    const line = new CutLine(table, (row) => view.seenAt(row), view.projector());
    line.to(x, y);
    this.#cutting = { rule: this.#rule(), line, crossed: new Set(), length: 0 };
    this.line.value = [[x, y]];
  }

  move(points: readonly StrokePoint[]): void {
    const cutting = this.#cutting;
    const drawn = this.line.peek();
    if (!cutting || !drawn) {
      return;
    }
    const before = cutting.crossed.size;
    const next = [...drawn];
    if (this.#options.view.air?.sways) {
      cutting.line.look();
    }
    for (const { x, y } of points) {
      const last = next[next.length - 1];
      cutting.length += last ? Math.hypot(x - last[0], y - last[1]) : 0;
      for (const row of cutting.line.to(x, y)) {
        cutting.crossed.add(row);
      }
      next.push([x, y]);
    }
    this.line.value = next;
    if (cutting.crossed.size > before) {
      this.#show(cutting.rule.cutsAtAll(cutting.crossed));
    }
  }

  end(): void {
    const cutting = this.#cutting;
    const first = this.line.peek()?.[0];
    this.abandon();
    if (!cutting || !first) {
      return;
    }
    const tapped = cutting.length < TAP ? this.#options.view.pick(first[0], first[1], PICK_TOLERANCE) : null;
    const rows = cutting.crossed.size > 0 ? [...cutting.crossed] : tapped ? [tapped.row] : [];
    if (rows.length > 0) {
      this.predicts.peek() ? this.#predict(cutting.rule, rows) : this.#cut(cutting.rule, rows);
    }
  }

  abandon(): void {
    this.#cutting = null;
    this.line.value = null;
    this.#show([]);
  }

  /** Cuts off the branch at a place; says whether there was one. */
  cutAt(x: number, y: number): boolean {
    const picked = this.#options.view.pick(x, y, PICK_TOLERANCE);
    if (picked) {
      this.#cut(this.#rule(), [picked.row]);
    }
    return picked !== null;
  }

  /** Cuts off the branches at these rows. */
  cut(rows: readonly number[]): void {
    this.#cut(this.#rule(), rows);
  }

  mark(rows: readonly number[]): { readonly cuts: readonly number[]; readonly kept: number } {
    const rule = this.#rule();
    this.#lasting = rule.cutsAtAll(rows);
    this.#show([]);
    return { cuts: this.#lasting, kept: rows.filter((row) => rule.cutsAt(row).length === 0).length };
  }

  hover(x: number, y: number): void {
    if (!this.#cutting) {
      const picked = this.#options.view.pick(x, y, PICK_TOLERANCE);
      this.#show(picked ? this.#rule().cutsAt(picked.row) : []);
    }
  }

  leave(): void {
    if (!this.#cutting) {
      this.#show([]);
    }
  }

  /** Marks what stands in the dark, to be cut or not; null marks nothing. Gives how many branches that are. */
  markDim(exposure: number | null): number {
    const cuts = exposure === null ? [] : this.#rule().dim(exposure);
    this.#show(cuts);
    return cuts.length;
  }

  cutDim(exposure: number): void {
    const cuts = this.#rule().dim(exposure);
    this.#show([]);
    if (cuts.length > 0) {
      this.#options.submit({ kind: "prune_dim", exposure });
      this.#fell(cuts);
    }
  }

  /** The server would not cut: what was hidden is there again. */
  refused({ kind }: Command): void {
    if (kind !== "prune" && kind !== "prune_dim") {
      return;
    }
    for (const felled of this.#falling) {
      this.#options.view.removeOverlay(felled);
    }
    this.#falling.clear();
  }

  changed(): void {
    const { table, view, unsettled } = this.#options;
    const waiting = unsettled("prune") + unsettled("prune_dim") > 0;
    for (const felled of this.#falling) {
      if (!view.hasOverlay(felled) || felled.over(table)) {
        this.#falling.delete(felled);
      } else if (!waiting) {
        this.#linger(felled);
      }
    }
  }

  /** Branches whose cut is answered are gone with the next rows; if not, they were not cut after all. */
  #linger(felled: CutOverlay): void {
    setTimeout(() => {
      if (this.#falling.delete(felled)) {
        this.#options.view.removeOverlay(felled);
      }
    }, LINGERS);
  }

  #predict(rule: PruneRule, rows: readonly number[]): void {
    const cuts = rule.cutsAtAll(rows);
    cuts.length > 0 ? this.#options.predict(cuts.slice(0, MAX_PRUNED_ROWS)) : this.#options.say(TRUNK_STAYS);
  }

  #cut(rule: PruneRule, rows: readonly number[]): void {
    // One row that cannot be cut would have all of them refused.
    const possible = rows.filter((row) => rule.cutsAt(row).length > 0);
    const cuts = rule.cutsAtAll(possible);
    if (cuts.length === 0) {
      this.#options.say(TRUNK_STAYS);
      return;
    }
    const asked = possible.length <= MAX_PRUNED_ROWS ? possible : cuts.slice(0, MAX_PRUNED_ROWS);
    this.#options.submit({ kind: "prune", rows: asked });
    this.#fell(asked === possible ? cuts : asked);
  }

  #fell(cuts: readonly number[]): void {
    this.#options.view.air?.cut(cuts);
    const felled = new CutOverlay(cuts, "hidden");
    this.#falling.add(felled);
    this.#options.view.addOverlay(felled);
  }

  /** Marks branches; where there are none, those whose marks last. */
  #show(asked: readonly number[]): void {
    const cuts = asked.length > 0 ? asked : this.#lasting;
    this.marked.value = asked.length;
    if (this.#mark && cuts.length === this.#mark.rows.length && cuts.every((row, i) => row === this.#mark?.rows[i])) {
      return;
    }
    if (this.#mark) {
      this.#options.view.removeOverlay(this.#mark);
    }
    this.#mark = cuts.length > 0 ? new CutOverlay(cuts, "marked") : null;
    if (this.#mark) {
      this.#options.view.addOverlay(this.#mark);
    }
  }

  #rule(): PruneRule {
    return new PruneRule(this.#options.table, this.#options.limits());
  }
}
