import { signal } from "@preact/signals";
import type { TreeTable } from "../../scene/tree-table";
import type { Viewport } from "../../scene/viewport";
import type { Command } from "../../wire/generated";
import type { ChosenBud } from "../chosen-bud";
import type { Gesture, StrokePoint } from "../gestures";
import type { ObstacleList } from "../obstacle-list";
import { OutlineTrace } from "../outline-trace";
import { pace } from "../pacing";
import type { Point } from "../ports";
import { nearestBase } from "../scene-link";
import type { Settings } from "../settings";
import type { Toasts } from "../toasts";
import { BrushTool, SEND_EVERY } from "./brush-tool";
import { LassoTool } from "./lasso-tool";
import { ObstacleTool } from "./obstacle-tool";
import { SeedTool } from "./seed-tool";
import { PICK_TOLERANCE, type Tool } from "./tool";

export type ToolName = "brush" | "lasso" | "seed";

/** What the tools work with. */
export interface Workshop {
  readonly table: TreeTable;
  readonly settings: Settings;
  readonly toasts: Toasts;
  readonly bud: ChosenBud;
  readonly obstacles: ObstacleList;
  readonly submit: (command: Command) => void;
  /** The number the next command gets. */
  readonly next: () => number;
  /** How many `stroke_move` the server has still to answer or to grow. */
  readonly unsettledMoves: () => number;
  /** Whether a stroke would come to anything. */
  readonly ready: () => boolean;
  /** Whether a finger on an obstacle moves it. */
  readonly arranging: () => boolean;
  /** A place is held, or what is there was chosen. */
  readonly choose: (x: number, y: number) => void;
}

/** A place that is being held still, until it is chosen. */
export interface Hold {
  readonly x: number;
  readonly y: number;
  readonly milliseconds: number;
}

/** The tools, and which of them has the finger. */
export class Toolbox {
  readonly chosen = signal<ToolName>("brush");
  readonly drawing = signal(false);
  readonly hold = signal<Hold | null>(null);
  readonly outline = new OutlineTrace();
  /** Where a seed would lie. */
  readonly seed = signal<Point | null>(null);

  #workshop: Workshop;
  #view: Viewport | null = null;
  #tools: Record<ToolName, Tool> | null = null;
  #mover: ObstacleTool | null = null;
  /** The tool that has the stroke under way. */
  #active: Tool | null = null;
  #stopPacing = () => {};
  #hoverFrame = 0;

  constructor(workshop: Workshop) {
    this.#workshop = workshop;
  }

  /** Takes a view into use. */
  attach(view: Viewport): void {
    const { table, settings, toasts, bud, obstacles, submit, next, unsettledMoves } = this.#workshop;
    const base = (x: number, y: number) => nearestBase(table, view, x, y);
    const row = () => bud.row.peek();
    this.#view = view;
    this.#tools = {
      brush: new BrushTool({
        view,
        submit,
        newStroke: next,
        unsettledMoves,
        radius: () => settings.radius.peek(),
        pressureWidens: () => settings.pressureWidens.peek(),
        bud: row,
        base,
      }),
      lasso: new LassoTool({
        view,
        submit,
        bud: row,
        base,
        draw: (points) => this.outline.draw(points),
        sent: (places) => {
          settings.hasOutlined.value = true;
          this.outline.grow(places, next() - 1);
        },
        tooSmall: () => toasts.show("Draw a larger outline: the tree grows to fill it."),
      }),
      seed: new SeedTool({
        groundAt: (x, y) => view.pointOnLevel(x, y, [0, 0, 0]),
        submit,
        show: (place) => {
          this.seed.value = place;
        },
        planted: () => this.choose("brush"),
        missed: () => toasts.show("Tap the ground, not too far away."),
      }),
    };
    this.#mover = new ObstacleTool({
      view,
      submit,
      poseOf: (id) => obstacles.poseOf(id),
      choose: (id) => {
        obstacles.chosen.value = id;
      },
      preview: (moved) => obstacles.preview(moved),
    });
  }

  detach(): void {
    this.end();
    this.#view = null;
    this.#tools = null;
    this.#mover = null;
  }

  choose(tool: ToolName): void {
    this.end();
    this.seed.value = null;
    this.#view?.hideBrush();
    this.chosen.value = tool;
  }

  gesture(gesture: Gesture): void {
    const view = this.#view;
    switch (gesture.kind) {
      case "stroke-begin":
        this.#begin(gesture.point);
        break;
      case "stroke-move":
        this.#active?.move(gesture.points);
        break;
      case "stroke-end":
        this.end();
        break;
      case "hold-begin":
        this.hold.value = gesture;
        break;
      case "hold-end":
        this.hold.value = null;
        break;
      case "choose":
        this.#workshop.choose(gesture.x, gesture.y);
        break;
      case "pan":
        view?.pan(gesture.dx, gesture.dy);
        break;
      case "orbit":
        view?.orbit(gesture.dx, gesture.dy);
        break;
      case "zoom":
        view?.zoom(gesture.factor, gesture.x, gesture.y);
        break;
    }
  }

  /** A mouse or pen is over a place and not down, or over none. */
  hover(place: { readonly x: number; readonly y: number } | null): void {
    cancelAnimationFrame(this.#hoverFrame);
    if (this.drawing.peek()) {
      return;
    }
    // Picking looks at the whole tree, so it is done once a frame and not once an event.
    this.#hoverFrame = requestAnimationFrame(() => {
      const tool = this.#tools?.[this.chosen.peek()];
      if (place && !this.drawing.peek()) {
        tool?.hover?.(place.x, place.y);
      } else if (!place) {
        this.seed.value = null;
        this.#view?.hideBrush();
      }
    });
  }

  /** Whether holding still at a place chooses something there, or lets go of what is chosen. */
  holdable(x: number, y: number): boolean {
    const { bud, ready } = this.#workshop;
    if (this.chosen.peek() === "seed" || !ready() || this.#moves({ x, y, pressure: null })) {
      return false;
    }
    return bud.row.peek() !== null || this.#view?.pick(x, y, PICK_TOLERANCE) != null;
  }

  /** The stroke under way ends where it is. */
  end(): void {
    this.#stopPacing();
    const tool = this.#active;
    if (!tool) {
      return;
    }
    this.#active = null;
    this.#view?.hold(false);
    this.drawing.value = false;
    if (tool instanceof BrushTool) {
      this.#workshop.settings.hasDrawn.value = true;
    }
    tool.end();
  }

  /** The stroke under way is as if it had not been; what the brush has grown stays. */
  cancel(): void {
    if (this.#active instanceof BrushTool) {
      this.end();
    } else {
      this.abandon();
    }
  }

  /** Forgets the stroke under way, for the server no longer knows it. */
  abandon(): void {
    this.#stopPacing();
    this.hold.value = null;
    if (!this.#active) {
      return;
    }
    this.#view?.hold(false);
    this.#active.abandon();
    this.#active = null;
    this.drawing.value = false;
  }

  #begin(point: StrokePoint): void {
    const tool: Tool | null | undefined = this.#moves(point) ? this.#mover : this.#tools?.[this.chosen.peek()];
    if (!tool || !this.#workshop.ready()) {
      return;
    }
    this.end();
    this.#active = tool;
    this.drawing.value = true;
    this.#view?.hold(true);
    tool.begin(point);
    this.#stopPacing = pace(SEND_EVERY, () => tool.tick?.());
  }

  #moves(point: StrokePoint): boolean {
    return this.#workshop.arranging() && this.chosen.peek() !== "seed" && this.#mover?.grips(point) === true;
  }
}
