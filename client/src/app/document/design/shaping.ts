import { computed, effect, type ReadonlySignal, signal } from "@preact/signals";
import type { Shell, Shells } from "../../../scene/structure/shells";
import type { Ray, Vec3 } from "../../../scene/vector";
import type { DesignEdit } from "../../../wire/generated";
import type { Gesture } from "../../input/gesture";
import { drawnAxis } from "./axis-sketch";
import {
  type Change,
  type Dragged,
  type Handle,
  type HandleGroup,
  type HandleView,
  type Held,
  handlesOf,
} from "./branch-handles";
import { BranchShape } from "./branch-shape";
import type { Curve } from "./curve-points";
import type { DesignEditing } from "./design-editing";
import { bearerOf, keyNamed, ROOT } from "./design-model";
import type { DesignSignal } from "./design-signal";
import { type HandsOn, type HeldShape, type Hidden, holdHands } from "./hands-on";
import { fittedOutline, type Unfitted } from "./outline-fit";
import { borneBy, pickable, pickBranch } from "./shell-pick";
import { TapOrTurn } from "./tap-or-turn";

/** How soon after a tap another one goes deeper, in milliseconds, and how near to it. */
const SECOND_TAP = 380;
const SAME_PLACE = 32;

/** What shaping needs of the picture. */
export interface ShapingView extends HandleView {
  rayAt(x: number, y: number): Ray;
}

export interface ShapingOptions {
  readonly editing: DesignEditing;
  readonly design: DesignSignal;
  readonly view: () => ShapingView | null;
  /** Shells in the picture; null while there is none. */
  readonly shells: () => Shells | null;
  /** Whether whoever is here may change the tree. */
  readonly mayChange: ReadonlySignal<boolean>;
  /** Whether a session is open. */
  readonly connected: ReadonlySignal<boolean>;
  /** Tells the server which branch is looked at. */
  readonly look: (of: string | null) => void;
  /** A finger shapes until what this returns was called: the picture is not at rest, and the tree stands as it grew. */
  readonly hold: () => () => void;
  readonly now: () => number;
  /** Says why nothing comes of a drawn outline. */
  readonly unfitted: (why: Unfitted) => void;
}

/** A handle in a finger. */
interface Grip {
  readonly handle: Handle;
  readonly from: Held;
  readonly letGo: () => void;
  dragged: Dragged | null;
}

/** Shaping a design by hand, in the picture: which branch is chosen, and its handles. */
export class Shaping implements HandsOn {
  /** Whether it is wanted. */
  readonly wanted = signal(false);
  readonly group = signal<HandleGroup>("way");
  /** Whether the list of branches is open, which asks for those around the chosen one. */
  readonly isListed = signal(false);
  /** Whether a finger on the picture draws the outline of the chosen branch, or its axis where the handles are about that. */
  readonly sketching = signal(false);
  /** What it has drawn. */
  readonly trace = signal<readonly (readonly [number, number])[]>([]);
  /** Handles that are not shown. */
  readonly hidden = signal<Hidden>({ near: 0, along: 0 });
  /** What the finger makes of the chosen branch, while it does. */
  readonly held = signal<HeldShape | null>(null);
  /** Whether fingers shape: there is an open design, and whoever is here may change it. */
  readonly isOn = computed(() => {
    const told = this.#options.design.inForce.value;
    return this.wanted.value && told !== null && told.steps_on_top === 0 && this.#options.mayChange.value;
  });
  /** The branches around the chosen one, as the server told them. */
  readonly shapes = computed<ReadonlyMap<string, BranchShape>>(() => {
    const model = this.#options.editing.model.value;
    const { branches } = this.#options.design.placed.value;
    return new Map(model ? branches.map((placed) => [placed.path, BranchShape.of(placed, model)]) : []);
  });
  /** The chosen branch as it is to be drawn. */
  readonly chosen = computed(() => {
    const path = this.#options.editing.chosen.value;
    const held = this.held.value?.shape;
    return held?.path === path ? held : (this.shapes.value.get(path) ?? null);
  });
  /** What a finger draws. */
  readonly draws = computed(() => (this.group.value === "axis" ? "axis" : "outline"));
  readonly handles = computed(() => {
    const [shape, group] = [this.chosen.value, this.group.value];
    if (this.held.value !== null && this.#grip !== null) {
      return [this.#grip.handle];
    }
    return shape ? handlesOf(shape).filter((handle) => handle.group === group) : [];
  });

  #options: ShapingOptions;
  #grip: Grip | null = null;
  /** Ends what a finger that draws holds. */
  #letGo: (() => void) | null = null;
  #taps = new TapOrTurn((x, y) => this.tap(x, y));
  #tapped: { readonly x: number; readonly y: number; readonly at: number } | null = null;
  #stop: () => void;

  constructor(options: ShapingOptions) {
    this.#options = options;
    const { design, editing, connected } = options;
    let isLooking = false;
    const stops = [
      holdHands(options, this.isOn, this.shown, (gesture) => this.gesture(gesture)),
      effect(() => {
        const isAsked = this.isOn.value || (this.isListed.value && design.inForce.value !== null);
        const of = isAsked ? editing.chosen.value : null;
        if (connected.value && (of !== null || isLooking)) {
          isLooking = of !== null;
          options.look(of);
        }
      }),
      effect(() => {
        if (!this.isOn.value) {
          this.cancel();
          this.sketching.value = false;
        }
      }),
    ];
    this.#stop = () => {
      for (const stop of stops) {
        stop();
      }
    };
  }

  /** What is drawn: the chosen branch, those beside it, and what encloses them. */
  readonly shown = computed<readonly Shell[]>(() => {
    const chosen = this.chosen.value;
    if (!this.isOn.value || !chosen) {
      return [];
    }
    const shapes = this.shapes.value;
    const bearer = bearerOf(chosen.path);
    const beside = bearer === null ? borneBy(chosen.path, shapes) : borneBy(bearer, shapes);
    const around = bearer === null ? undefined : shapes.get(bearer);
    return [
      ...(around ? [around.shell("around")] : []),
      ...beside.filter(({ path }) => path !== chosen.path).map((shape) => shape.shell("beside")),
      chosen.shell("chosen"),
    ];
  });

  /** One scale up; false where there is none. */
  up(): boolean {
    const bearer = bearerOf(this.#options.editing.chosen.peek());
    if (bearer === null) {
      return false;
    }
    this.#options.editing.choose(bearer);
    return true;
  }

  /** One scale down: the lateral that is nearest to a place, or the first. */
  down(x?: number, y?: number): boolean {
    const { editing } = this.#options;
    const path = editing.chosen.peek();
    const borne = borneBy(path, this.shapes.peek());
    const found = x === undefined || y === undefined ? null : this.#pick([borne], x, y);
    const first = editing.model.peek()?.laterals(path)[0] ?? borne[0]?.path;
    const next = found ?? first;
    if (next === undefined) {
      return false;
    }
    editing.choose(next);
    return true;
  }

  /** What a gesture on the canvas still means to the view. */
  gesture(gesture: Gesture): Gesture | null {
    const isDrawing = this.sketching.peek() || this.trace.peek().length > 0;
    if (isDrawing && gesture.kind.startsWith("stroke")) {
      this.#sketch(gesture);
      return null;
    }
    return this.#taps.gesture(gesture);
  }

  /** Chooses the branch at a place; a second time, one that it bears. Beside everything it goes one scale up. */
  tap(x: number, y: number): void {
    const { editing, now } = this.#options;
    const before = this.#tapped;
    const at = now();
    const again = before !== null && at - before.at < SECOND_TAP && Math.hypot(before.x - x, before.y - y) < SAME_PLACE;
    this.#tapped = again ? null : { x, y, at };
    if (again) {
      this.down(x, y);
      return;
    }
    const found = this.#pick(pickable(editing.chosen.peek(), this.shapes.peek()), x, y);
    if (found !== null) {
      editing.choose(found);
    } else {
      this.up();
    }
  }

  /** A finger draws the outline: the shell shows at once what it comes to, and its end is one deed. */
  #sketch(gesture: Gesture): void {
    if (gesture.kind === "stroke-begin") {
      this.#letGo?.();
      this.#letGo = this.#options.hold();
      this.trace.value = [[gesture.point.x, gesture.point.y]];
    } else if (gesture.kind === "stroke-move" && this.trace.peek().length > 0) {
      this.trace.value = [...this.trace.peek(), ...gesture.points.map(({ x, y }) => [x, y] as const)];
      this.#fit();
    } else if (gesture.kind === "stroke-end" && this.trace.peek().length > 0) {
      const fit = this.#fit();
      this.#drawn();
      this.held.value = null;
      if (typeof fit === "string") {
        this.#options.unfitted(fit);
      } else if (fit) {
        this.sketching.value = false;
        this.group.value = this.draws.peek();
        this.#options.editing.shaped(fit);
      }
    }
  }

  /** Nothing is drawn any more. */
  #drawn(): void {
    this.trace.value = [];
    this.#letGo?.();
    this.#letGo = null;
  }

  /** What comes of what was drawn so far, which is shown at once. */
  #fit(): Change | Unfitted | null {
    const { editing } = this.#options;
    const path = editing.chosen.peek();
    const [shape, view, model] = [this.shapes.peek().get(path), this.#options.view(), editing.model.peek()];
    if (!shape || !view || !model) {
      return null;
    }
    if (this.draws.peek() === "axis") {
      const roll = path === ROOT ? 0 : Number(model.resolve(path, keyNamed("roll")).value);
      const drawn = drawnAxis(shape, view, this.trace.peek(), roll);
      if (typeof drawn === "string") {
        return drawn;
      }
      this.held.value = { handle: "", shape: drawn.shape, readout: {} };
      if (editing.scope.peek() === "order") {
        return { kind: "value", key: "axis", value: drawn.points, isPrivate: false };
      }
      const keys = path === ROOT ? (["height", "silhouette", "axis"] as const) : (["turn", "reach", "axis"] as const);
      return {
        kind: "edits",
        edits: [{ edit: "aim", node: path, tip: [...drawn.tip] }, axisOf(path, drawn.points)],
        keys,
      };
    }
    const fit = fittedOutline(shape, view, this.trace.peek());
    if (typeof fit === "string") {
      return fit;
    }
    this.held.value = { handle: "", shape: shape.shaped(fit), readout: {} };
    return { kind: "value", key: "silhouette", value: fit, isPrivate: false };
  }

  /** A finger takes hold of a handle. */
  grip(handle: Handle): void {
    this.cancel();
    const { editing, hold } = this.#options;
    const [shape, model] = [this.chosen.peek(), editing.model.peek()];
    if (!shape || !model) {
      return;
    }
    const bearer = bearerOf(shape.path);
    const value = (name: "roll" | "height") => Number(model.resolve(shape.path, keyNamed(name)).value);
    const from: Held = {
      shape,
      bearer: bearer === null ? null : (this.shapes.peek().get(bearer) ?? null),
      roll: value("roll"),
      height: value("height"),
    };
    this.#grip = { handle, from, letGo: hold(), dragged: null };
  }

  /** It has moved here. */
  drag(x: number, y: number): void {
    const [grip, view] = [this.#grip, this.#options.view()];
    const dragged = grip && view && grip.handle.drag(grip.from, view, x, y);
    if (grip && dragged) {
      grip.dragged = dragged;
      this.held.value = { handle: grip.handle.id, shape: dragged.shape, readout: dragged.readout };
      this.#options.editing.shape(dragged.change);
    }
  }

  /** It is let go: what was done stays, and is one deed. */
  release(): void {
    const grip = this.#grip;
    if (!grip) {
      return;
    }
    this.#grip = null;
    grip.letGo();
    if (grip.dragged) {
      this.#options.editing.shaped(grip.dragged.change);
    }
    this.held.value = null;
  }

  /** What is in progress is as if it had never begun; false where nothing is. */
  cancel(): boolean {
    const grip = this.#grip;
    const wasDrawing = this.trace.peek().length > 0;
    this.#grip = null;
    this.held.value = null;
    this.#drawn();
    grip?.letGo();
    if (grip?.dragged) {
      this.#options.editing.unshape(grip.dragged.change);
    }
    return grip !== null || wasDrawing;
  }

  /** A point of the axis is taken away by a double tap on it. */
  without(handle: Handle): void {
    const shape = this.chosen.peek();
    if (shape && handle.without) {
      this.cancel();
      this.#options.editing.shaped(handle.without(shape));
    }
  }

  dispose(): void {
    this.#stop();
  }

  #pick(levels: readonly (readonly BranchShape[])[], x: number, y: number): string | null {
    const view = this.#options.view();
    if (!view) {
      return null;
    }
    const drawn = this.#options.shells();
    const hits = drawn ? drawn.hits(view.rayAt(x, y)) : [];
    return pickBranch(levels, hits, view.projector() as (point: Vec3) => readonly [number, number] | null, x, y);
  }
}

/** A course that belongs to one branch alone; that of the plant as a whole is for all. */
function axisOf(path: string, points: Curve): DesignEdit {
  const value = { own: points, ...(path === ROOT ? {} : { private: true }) };
  return { edit: "set", of: path, key: "axis", value };
}
