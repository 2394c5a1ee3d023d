import { effect } from "@preact/signals";
import { subtreeRows } from "../../../scene/table/branch-rows";
import type { TreeTable } from "../../../scene/table/tree-table";
import type { Vec3 } from "../../../scene/vector";
import type { Viewport } from "../../../scene/viewport";
import type { Command } from "../../../wire/generated";
import type { Key } from "../../words/say";
import { PruneRule } from "../prune/prune-rule";
import { GhostStage } from "./ghost-stage";
import { HeldBranch } from "./held-branch";
import { Prediction } from "./prediction";

export interface BranchWorkOptions {
  readonly table: TreeTable;
  readonly submit: (command: Command) => void;
  /** A number that no other operation of this client has. */
  readonly newGesture: () => number;
  /** Asks for a ghost; false while no session is connected. */
  readonly predict: (rows: number[], steps: number) => boolean;
  /** The rows whose width is set. */
  readonly limits: () => ReadonlySet<number>;
  /** Cuts the branches off at these rows. */
  readonly cut: (rows: readonly number[]) => void;
  readonly screen: () => { readonly right: Vec3; readonly up: Vec3 };
  readonly say: (text: Key) => void;
  /** Whether the server is still growing something. */
  readonly busy: () => boolean;
}

/** What is done with whole branches: held, turned, moved, copied, cut, and what cutting them would do. */
export class BranchWork {
  readonly ghosts: GhostStage;
  readonly prediction: Prediction;
  readonly held: HeldBranch;
  #options: BranchWorkOptions;
  #stopMarking = () => {};

  constructor(options: BranchWorkOptions) {
    const { table, submit, newGesture, predict, limits, say, busy } = options;
    this.#options = options;
    this.ghosts = new GhostStage(table);
    this.prediction = new Prediction({
      cutsOf: (rows) => new PruneRule(table, limits()).cutsAtAll(rows),
      predict,
      submit,
      newGesture,
      show: (plants) => this.ghosts.showBeside(plants),
      end: (becoming) => this.ghosts.endBeside(becoming),
      tell: say,
    });
    this.held = new HeldBranch({
      rows: table,
      submit,
      newGesture,
      busy,
      branchAbove: (row, most) => subtreeRows(table, row, most),
      showTurn: (turn) => this.ghosts.showTurn(turn),
      showCopy: (row, placement) => this.ghosts.showCopy(row, placement),
    });
  }

  attach(view: Viewport): void {
    this.ghosts.attach(view);
    this.#stopMarking = effect(() => this.ghosts.mark(this.prediction.cuts.value));
  }

  detach(): void {
    this.#stopMarking();
    this.ghosts.detach();
  }

  /** The branch that is held goes to the limb that is tapped next, or a copy of it. */
  place(mode: "move" | "copy"): void {
    this.prediction.discard();
    this.held.beginPlacing(mode);
  }

  /** Turns it by a little: sideways and up on the screen, or about itself; false if none is held. */
  step(right: number, up: number, twist: number): boolean {
    return this.held.step(right, up, twist, this.#options.screen(), performance.now());
  }

  /** Cuts it off. */
  cut(): void {
    const row = this.held.row.peek();
    if (row !== null) {
      this.held.release();
      this.#options.cut([row]);
    }
  }

  /** Shows what would become of the tree without it. */
  predictCut(): void {
    const row = this.held.row.peek();
    if (row !== null) {
      this.predict([row]);
    }
  }

  /** Shows what would become of the tree without the branches at these rows. */
  predict(rows: readonly number[]): void {
    this.held.cancelPlacing();
    this.prediction.ask(rows);
  }

  /** The server has refused a command, or, where none is named, perhaps a prediction. */
  refused(command: Command | undefined): void {
    if (command === undefined) {
      this.prediction.refused();
    } else if (command.kind === "turn_branch" || command.kind === "graft") {
      this.held.refused();
    }
  }

  /** Another session: nothing that was held is there. */
  clear(): void {
    this.prediction.lost();
    this.held.release();
  }
}
