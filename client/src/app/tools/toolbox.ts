import { signal } from "@preact/signals";
import { Bend } from "../../scene/bend/bend";
import type { Girth } from "../../scene/overlay/width-overlay";
import type { TreeTable } from "../../scene/table/tree-table";
import type { Vec3 } from "../../scene/vector";
import type { Viewport } from "../../scene/viewport";
import type { Command, WidthConstraint } from "../../wire/generated";
import type { PoseFrame } from "../../wire/pose";
import type { ObstacleList } from "../document/obstacles/obstacle-list";
import type { Gesture, Grip, StrokePoint } from "../input/gesture-recogniser";
import type { Settings } from "../page/settings";
import type { Toasts } from "../page/toasts";
import { nearestBase, scaleAt } from "../view/places";
import { type Key, say } from "../words/say";
import { BendPoses } from "./bend/bend-poses";
import { BendTool } from "./bend/bend-tool";
import { BranchTool } from "./branch/branch-tool";
import type { HeldBranch } from "./branch/held-branch";
import { BrushTool, SEND_EVERY } from "./brush/brush-tool";
import type { ChosenBud } from "./chosen-bud";
import { LassoTool } from "./lasso/lasso-tool";
import { OutlineTrace } from "./lasso/outline-trace";
import { ObstacleTool } from "./obstacle/obstacle-tool";
import { pace } from "./pacing";
import { PruneTool } from "./prune/prune-tool";
import { SeedTool } from "./seed/seed-tool";
import { type GripTool, PICK_TOLERANCE, type StrokeTool } from "./tool";
import { WidthTool } from "./width/width-tool";

export const TOOL_NAMES = ["brush", "lasso", "seed", "branch", "bend", "width", "prune"] as const;
export type ToolName = (typeof TOOL_NAMES)[number];

/** What the tools work with. */
export interface Workshop {
  readonly table: TreeTable;
  readonly settings: Settings;
  readonly toasts: Toasts;
  readonly bud: ChosenBud;
  readonly obstacles: ObstacleList;
  readonly branch: HeldBranch;
  readonly submit: (command: Command) => void;
  /** The number the next command gets. */
  readonly next: () => number;
  /** How many `stroke_move` the server has still to answer or to grow. */
  readonly unsettledMoves: () => number;
  /** How many commands of a kind the server has still to answer. */
  readonly unsettled: (kind: Command["kind"]) => number;
  /** What the wood's width follows from. */
  readonly girth: () => Girth;
  /** Shows what would become of the tree without the branches at these rows. */
  readonly predict: (rows: readonly number[]) => void;
  /** The picture is not at rest until what this returns was called. */
  readonly hold: () => () => void;
  /** Whether a stroke can be sent. */
  readonly ready: () => boolean;
  /** Whether a finger on an obstacle moves it. */
  readonly arranging: () => boolean;
  /** A place is held, or what is there was chosen. */
  readonly choose: (x: number, y: number) => void;
}

/** The tools that draw growth: there holding chooses a branch, and a double tap cuts one. */
const DRAWING: ReadonlySet<ToolName> = new Set(["brush", "lasso"]);

/** A place that is being held still, until it is chosen. */
export interface Hold {
  readonly x: number;
  readonly y: number;
  readonly milliseconds: number;
}

/** The tools that shape what has grown, and the bends of other people. */
export interface Shaping {
  readonly bend: BendTool;
  readonly width: WidthTool;
  readonly prune: PruneTool;
  readonly poses: BendPoses;
}

/** The tools, and the one that has the pointers. */
export class Toolbox {
  readonly chosen = signal<ToolName>("brush");
  readonly drawing = signal(false);
  readonly hold = signal<Hold | null>(null);
  readonly outline = new OutlineTrace();
  /** Where a seed would lie. */
  readonly seed = signal<Vec3 | null>(null);
  /** Those with something to show beside the picture; null without a view. */
  readonly shaping = signal<Shaping | null>(null);
  #widths: readonly WidthConstraint[] = [];
  /** The newest pose of each bend that is in progress. */
  #poses = new Map<number, PoseFrame>();

  #workshop: Workshop;
  #view: Viewport | null = null;
  #tools: Record<ToolName, StrokeTool | GripTool> | null = null;
  #mover: ObstacleTool | null = null;
  /** The tool that has the stroke in progress. */
  #active: StrokeTool | GripTool | null = null;
  /** Fingers that the tool in progress has taken. */
  #grips = new Set<number>();
  #stopPacing = () => {};
  #letGo = () => {};
  #hoverFrame = 0;

  constructor(workshop: Workshop) {
    this.#workshop = workshop;
  }

  /** Takes a view into use. */
  attach(view: Viewport): void {
    const { table, settings, toasts, bud, obstacles, branch, submit, next, unsettledMoves } = this.#workshop;
    const base = (x: number, y: number) => nearestBase(table, view, x, y);
    const row = () => bud.row.peek();
    this.#view = view;
    const shaping = this.#shaping(view);
    shaping.width.receive(this.#widths);
    for (const pose of this.#poses.values()) {
      shaping.poses.receive(pose);
    }
    this.shaping.value = shaping;
    this.#tools = {
      bend: shaping.bend,
      width: shaping.width,
      prune: shaping.prune,
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
        depth: () => settings.lassoDepth.peek(),
        draw: (points) => this.outline.draw(points),
        sent: (places) => {
          settings.hasOutlined.value = true;
          this.outline.grow(places, next() - 1);
        },
        tooSmall: () => toasts.show(say("tools.outline-small")),
      }),
      seed: new SeedTool({
        groundAt: (x, y) => view.pointOnLevel(x, y, [0, 0, 0]),
        submit,
        show: (place) => {
          this.seed.value = place;
        },
        planted: () => this.choose("brush"),
        missed: () => toasts.show(say("tools.ground-missed")),
      }),
      branch: new BranchTool({
        view,
        branch,
        say: (text) => toasts.show(say(text)),
      }),
    };
    this.#mover = new ObstacleTool({
      view,
      poseOf: (id) => obstacles.poseOf(id),
      move: (id, pose) => obstacles.move(id, pose),
      choose: (id) => {
        obstacles.chosen.value = id;
      },
      preview: (moved) => obstacles.preview(moved),
    });
  }

  /** The widths that are set; they may come before the tool that shows them. */
  receiveWidths(widths: readonly WidthConstraint[]): void {
    this.#widths = widths;
    this.shaping.peek()?.width.receive(widths);
  }

  /** A branch that is being bent; it may arrive before there is a view to show it (`BE5`). */
  receivePose(pose: PoseFrame): void {
    if (pose.motions.length > 0) {
      this.#poses.set(pose.bend, pose);
    } else {
      this.#poses.delete(pose.bend);
    }
    this.shaping.peek()?.poses.receive(pose);
  }

  /** Poses end with the connection. */
  losePoses(): void {
    this.#poses.clear();
    this.shaping.peek()?.poses.clear();
  }

  detach(): void {
    this.end();
    this.shaping.value = null;
    this.#view = null;
    this.#tools = null;
    this.#mover = null;
  }

  choose(tool: ToolName): void {
    this.end();
    this.seed.value = null;
    this.#view?.hideBrush();
    const before = this.#tools?.[this.chosen.peek()];
    before?.leave?.();
    before?.release?.();
    this.chosen.value = tool;
  }

  gesture(gesture: Gesture): void {
    const view = this.#view;
    switch (gesture.kind) {
      case "stroke-begin":
        this.#begin(gesture.point);
        break;
      case "stroke-move":
        if (this.#active && "move" in this.#active) {
          this.#active.move(gesture.points);
        }
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
      case "double-tap":
        this.shaping.peek()?.prune.cutAt(gesture.x, gesture.y);
        break;
      case "grip-begin":
        this.#gripBegin(gesture);
        break;
      case "grip-move":
        if (this.#active && "gripMove" in this.#active) {
          this.#active.gripMove(gesture.id, gesture.x, gesture.y);
        }
        break;
      case "grip-end":
        this.#gripEnd(gesture.id);
        break;
      case "grip-drop":
        this.#gripDrop();
        break;
      case "pan":
        view?.pan(gesture.dx, gesture.dy);
        break;
      case "orbit":
        view?.orbit(gesture.dx, gesture.dy);
        break;
      case "zoom":
        if (this.#active instanceof BranchTool) {
          // The wheel turns the held branch about its own axis.
          this.#active.twist(2 * Math.log(gesture.factor));
          break;
        }
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
        tool?.leave?.();
        this.#view?.hideBrush();
      }
    });
  }

  /** What the chosen tool does with one more finger at a place; null if it draws strokes. */
  grip(x: number, y: number): Grip | null {
    const tool = this.#tools?.[this.chosen.peek()];
    if (!tool || !("takes" in tool) || !this.#workshop.ready() || this.#moves({ x, y, pressure: null })) {
      return null;
    }
    return tool.takes(x, y);
  }

  /** Whether two taps mean something to the chosen tool. */
  doubles(): boolean {
    return DRAWING.has(this.chosen.peek());
  }

  /** Rows have changed, or commands were answered. */
  changed(): void {
    for (const tool of Object.values(this.#tools ?? {})) {
      tool.changed?.();
    }
  }

  /** The server would not do something: what was shown of it is as it was. */
  refused(command?: Command): void {
    const shaping = this.shaping.peek();
    if (command?.kind === "prune" || command?.kind === "prune_dim") {
      shaping?.prune.refused();
    } else if (command?.kind === "set_width") {
      shaping?.width.refused();
    } else if (command && "bend" in command) {
      shaping?.bend.refused(command.bend);
    }
  }

  /** Lets go of what the chosen tool has marked; false if there is nothing. */
  release(): boolean {
    return this.#tools?.[this.chosen.peek()].release?.() === true;
  }

  /** Whether holding still at a place chooses something there, or lets go of what is chosen. */
  holdable(x: number, y: number): boolean {
    const { bud, ready } = this.#workshop;
    if (!DRAWING.has(this.chosen.peek()) || !ready() || this.#moves({ x, y, pressure: null })) {
      return false;
    }
    return bud.row.peek() !== null || this.#view?.pick(x, y, PICK_TOLERANCE) != null;
  }

  /** The stroke in progress ends where it is. */
  end(): void {
    this.#stopPacing();
    const tool = this.#active;
    if (!tool) {
      return;
    }
    this.#rest();
    if (tool instanceof BrushTool) {
      this.#workshop.settings.hasDrawn.value = true;
    }
    tool.end();
  }

  /** Takes the stroke in progress back; what the brush has grown stays. */
  cancel(): void {
    if (this.#active instanceof BrushTool) {
      this.end();
    } else if (this.#active instanceof BendTool || this.#active instanceof WidthTool) {
      this.#active.cancel();
      this.#rest();
    } else {
      this.abandon();
    }
  }

  /** Forgets the stroke in progress, for the server no longer knows it. */
  abandon(): void {
    this.#stopPacing();
    this.hold.value = null;
    const tool = this.#active;
    this.#rest();
    tool?.abandon();
  }

  /** Another session is opened: what all tools hold and have marked is of the old one. */
  clear(): void {
    this.#widths = [];
    this.losePoses();
    this.abandon();
    for (const tool of Object.values(this.#tools ?? {})) {
      if ("abandon" in tool) {
        tool.abandon();
      }
      tool.release?.();
    }
    this.outline.clear();
  }

  #gripBegin(gesture: Extract<Gesture, { kind: "grip-begin" }>): void {
    const tool = this.#tools?.[this.chosen.peek()];
    if (!tool || !("takes" in tool) || !this.#workshop.ready()) {
      return;
    }
    if (this.#active !== tool) {
      this.end();
      this.#work(tool);
    }
    this.#grips.add(gesture.id);
    tool.gripBegin(gesture.id, gesture.x, gesture.y, gesture.slop);
  }

  #gripEnd(id: number): void {
    const tool = this.#active;
    if (!this.#grips.delete(id) || !tool || !("gripEnd" in tool)) {
      return;
    }
    if (this.#grips.size === 0) {
      this.#rest();
    }
    tool.gripEnd(id);
  }

  #gripDrop(): void {
    const tool = this.#active;
    this.#rest();
    if (tool && "gripDrop" in tool) {
      tool.gripDrop();
    }
  }

  #work(tool: StrokeTool | GripTool): void {
    this.#active = tool;
    this.drawing.value = true;
    this.#letGo = this.#workshop.hold();
    this.#stopPacing = pace(SEND_EVERY, () => tool.tick?.());
  }

  /** Nothing is in progress any more. */
  #rest(): void {
    this.#stopPacing();
    this.#grips.clear();
    if (this.#active) {
      this.#active = null;
      this.#letGo();
      this.drawing.value = false;
    }
  }

  #begin(point: StrokePoint): void {
    const tool = this.#moves(point) ? this.#mover : this.#tools?.[this.chosen.peek()];
    if (!tool || !("begin" in tool) || !this.#workshop.ready()) {
      return;
    }
    this.end();
    this.#work(tool);
    tool.begin(point);
  }

  #shaping(view: Viewport): Shaping {
    const { table, settings, toasts, submit, next, unsettled, girth, predict } = this.#workshop;
    const tell = (text: Key) => toasts.show(say(text));
    const bend = new BendTool({
      table,
      view,
      submit,
      newBend: next,
      newGesture: next,
      unsettled,
      stretch: () => settings.stretch.peek(),
      solver: (nodes, radii, stretch) => new Bend(nodes, radii, stretch),
      say: tell,
    });
    const width = new WidthTool({
      table,
      view,
      submit,
      newGesture: next,
      unsettled: () => unsettled("set_width"),
      girth,
      scaleAt: (row) => scaleAt(view, view.placeOf(row)),
      placeOnGlass: (row) => view.projector()(view.placeOf(row)),
    });
    const limits = () => width.limits.peek();
    const prune = new PruneTool({ table, view, submit, unsettled, limits, say: tell, predict });
    return { bend, width, prune, poses: new BendPoses(table, view, bend) };
  }

  #moves(point: StrokePoint): boolean {
    return this.#workshop.arranging() && this.chosen.peek() !== "seed" && this.#mover?.grips(point) === true;
  }
}
