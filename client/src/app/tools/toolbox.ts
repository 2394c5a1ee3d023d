import { signal } from "@preact/signals";
import { ELSEWHERE, type Hand } from "../../scene/motion/hand";
import type { Viewport } from "../../scene/viewport";
import type { Command } from "../../wire/generated";
import type { Gesture, Grip, StrokePoint } from "../input/gesture-recogniser";
import { nearestBase } from "../view/places";
import { say } from "../words/say";
import type { AnyTool, Mover, Service, ToolDescriptor, ToolKit, Workshop } from "./descriptor";
import { pace } from "./pacing";
import { strokeCopies, symmetryNow } from "./symmetry/stroke-copies";
import type { SymmetryCentre } from "./symmetry/symmetry";
import { PICK_TOLERANCE } from "./tool";
import { descriptorOf, FIRST_TOOL, type MadeTools, makeMover, TOOL_NAMES, type ToolName, toolFor } from "./tools";

/** After so many milliseconds a press that waits for a tool's code is answered. */
const LATE = 400;

/** How often a tool in progress is called, in milliseconds. */
const TICK = 33;

/** What the tools work with, and what the pointers do beside them. */
export interface ToolboxOptions extends Workshop {
  /** The picture is not at rest until what this returns was called. */
  readonly hold: () => () => void;
  /** Whether a stroke can be sent. */
  readonly ready: () => boolean;
  /** Whether a finger on an obstacle moves it. */
  readonly arranging: () => boolean;
  /** A place is held, or what is there was chosen. */
  readonly choose: (x: number, y: number) => void;
  /** So many fingers tapped at once. */
  readonly tapped: (fingers: number) => void;
}

/** A place that is being held still, until it is chosen. */
export interface Hold {
  readonly x: number;
  readonly y: number;
  readonly milliseconds: number;
}

/** The tools, and the one that has the pointers. */
export class Toolbox {
  readonly chosen = signal<ToolName>(FIRST_TOOL);
  readonly drawing = signal(false);
  readonly hold = signal<Hold | null>(null);
  /** What the stroke in progress is repeated about. */
  readonly centre = signal<SymmetryCentre | null>(null);
  /** What hands are at, with the rows they were laid on while wind blew; null where there are none. */
  readonly touched = signal<Hand | null>(null);
  /** Each tool by its name, once its code is there; null without a view. */
  readonly made = signal<MadeTools | null>(null);

  #options: ToolboxOptions;
  #kit: ToolKit | null = null;
  #loading = new Map<ToolName, Promise<void>>();
  #mover: Mover | null = null;
  /** The tool that has the stroke in progress. */
  #active: AnyTool | null = null;
  /** Fingers that the tool in progress has taken. */
  #grips = new Set<number>();
  #stopPacing = () => {};
  #letGo = () => {};
  #hoverFrame = 0;

  constructor(options: ToolboxOptions) {
    this.#options = options;
  }

  /** Takes a view into use. */
  attach(view: Viewport): void {
    const { table, toasts, settings, bud } = this.#options;
    const base = (x: number, y: number) => nearestBase(table, view, x, y);
    const kit: ToolKit = {
      ...this.#options,
      view,
      base,
      copies: strokeCopies(
        { table, view, base },
        () => symmetryNow(settings, bud.row.peek()),
        (centre) => {
          this.centre.value = centre;
        },
      ),
      say: (text) => toasts.show(say(text)),
    };
    this.#kit = kit;
    this.#loading.clear();
    this.made.value = {};
    for (const name of TOOL_NAMES.filter((name) => descriptorOf(name).atOnce === true)) {
      void this.load(name);
    }
    void this.#open(this.chosen.peek());
    this.#mover = makeMover(kit);
  }

  detach(): void {
    this.end();
    this.made.value = null;
    this.#kit = null;
    this.#loading.clear();
    this.#mover = null;
  }

  choose(tool: ToolName): void {
    this.end();
    this.#tool?.leave?.();
    this.#tool?.release?.();
    this.chosen.value = tool;
    void this.#open(tool);
  }

  /** Makes a tool, once, and loads its code before that where it has to be. After a failure only `choose` tries again. */
  async load(name: ToolName): Promise<void> {
    const kit = this.#kit;
    if (!kit) {
      return;
    }
    const loading = this.#loading.get(name) ?? this.#make(descriptorOf(name), name, kit);
    this.#loading.set(name, loading);
    await loading;
  }

  /** The tool that does something for the rest of the page, once its code is there. */
  toolFor(service: Service): AnyTool | undefined {
    return this.made.value?.[toolFor(service)];
  }

  async #make({ make, ready }: ToolDescriptor, name: ToolName, kit: ToolKit): Promise<void> {
    const made = make(kit);
    const tool = made instanceof Promise ? await made.catch((error) => lost(error)) : made;
    if (tool && this.#kit === kit) {
      this.made.value = { ...this.made.peek(), [name]: tool };
      ready?.(tool, kit);
    }
  }

  /** Whether the chosen tool came, while its code is being loaded; null where it is there. */
  loading(): Promise<boolean> | null {
    const name = this.chosen.peek();
    if (!this.#kit || this.#tool) {
      return null;
    }
    const late = setTimeout(() => this.#kit?.say("notices.part-loading"), LATE);
    return this.load(name).then(() => {
      clearTimeout(late);
      return this.#tool !== undefined && this.chosen.peek() === name;
    });
  }

  /** Loads the tool that was chosen; where it does not come, the first tool is chosen again, with a reason. */
  async #open(name: ToolName): Promise<void> {
    const kit = this.#kit;
    await this.load(name);
    if (kit && this.#kit === kit && !this.made.peek()?.[name]) {
      this.#loading.delete(name);
      kit.say("notices.part-lost");
      if (this.chosen.peek() === name) {
        this.choose(FIRST_TOOL);
      }
    }
  }

  gesture(gesture: Gesture): void {
    const view = this.#kit?.view;
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
        this.#touch(gesture.x, gesture.y);
        break;
      case "hold-end":
        this.hold.value = null;
        this.#untouch();
        break;
      case "choose":
        this.#options.choose(gesture.x, gesture.y);
        break;
      case "double-tap":
        this.toolFor("cut")?.cutAt?.(gesture.x, gesture.y);
        break;
      case "several-tap":
        this.#options.tapped(gesture.fingers);
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
        view?.camera.pan(gesture.dx, gesture.dy);
        break;
      case "orbit":
        view?.camera.orbit(gesture.dx, gesture.dy);
        break;
      case "zoom":
        if (this.#active?.zoom?.(gesture.factor) !== true) {
          view?.camera.zoom(gesture.factor, gesture.x, gesture.y);
        }
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
      if (place && !this.drawing.peek()) {
        this.#tool?.hover?.(place.x, place.y);
      } else if (!place) {
        this.#tool?.leave?.();
      }
    });
  }

  /** What the chosen tool does with one more finger at a place; null if it draws strokes. */
  grip(x: number, y: number): Grip | null {
    const tool = this.#tool;
    if (!tool || !("takes" in tool) || !this.#options.ready() || this.#moves({ x, y, pressure: null })) {
      return null;
    }
    return tool.takes(x, y);
  }

  /** Whether two taps mean something to the chosen tool. */
  doubles(): boolean {
    return descriptorOf(this.chosen.peek()).choosesBranches === true;
  }

  /** Rows have changed, or commands were answered. */
  changed(): void {
    for (const tool of this.#all) {
      tool.changed?.();
    }
  }

  /** The server would not do something: what was shown of it is as it was. */
  refused(command?: Command): void {
    if (command) {
      for (const tool of this.#all) {
        tool.refused?.(command);
      }
    }
  }

  /** Lets go of what the chosen tool has marked; false if there is nothing. */
  release(): boolean {
    return this.#tool?.release?.() === true;
  }

  /** Whether holding still at a place chooses something there, or lets go of what is chosen. */
  holdable(x: number, y: number): boolean {
    const { bud, ready } = this.#options;
    if (!this.doubles() || !ready() || this.#moves({ x, y, pressure: null })) {
      return false;
    }
    return bud.row.peek() !== null || this.#kit?.view.pick(x, y, PICK_TOLERANCE) != null;
  }

  /** The stroke in progress ends where it is. */
  end(): void {
    this.#stopPacing();
    const tool = this.#active;
    if (!tool) {
      return;
    }
    this.#rest();
    tool.end();
  }

  /** Ends the stroke in progress if the tree grows into it. */
  endGrowth(): void {
    if (descriptorOf(this.chosen.peek()).growsIntoStrokes === true) {
      this.end();
    }
  }

  /** Takes the stroke in progress back. */
  cancel(): void {
    const tool = this.#active;
    if (tool?.cancel) {
      tool.cancel();
      this.#rest();
    } else {
      this.abandon();
    }
  }

  /** Forgets the stroke in progress, for the server no longer knows it. */
  abandon(): void {
    this.#stopPacing();
    this.hold.value = null;
    this.#untouch();
    const tool = this.#active;
    this.#rest();
    tool?.abandon();
  }

  /** Another session is opened: what all tools hold and have marked is of the old one. */
  clear(): void {
    this.abandon();
    for (const tool of this.#all) {
      tool.abandon();
      tool.release?.();
    }
  }

  #gripBegin(gesture: Extract<Gesture, { kind: "grip-begin" }>): void {
    const tool = this.#tool;
    if (!tool || !("takes" in tool) || !this.#options.ready()) {
      return;
    }
    if (this.#active !== tool) {
      this.end();
      this.#work(tool);
    }
    this.#grips.add(gesture.id);
    this.#touch(gesture.x, gesture.y);
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

  #work(tool: AnyTool): void {
    this.#active = tool;
    this.drawing.value = true;
    this.#letGo = this.#options.hold();
    this.#stopPacing = pace(TICK, () => tool.tick?.());
  }

  /** Nothing is in progress any more. */
  #rest(): void {
    this.#stopPacing();
    this.#grips.clear();
    if (this.#active) {
      this.#active = null;
      this.#untouch();
      this.#letGo();
      this.drawing.value = false;
      this.centre.value = null;
    }
  }

  #begin(point: StrokePoint): void {
    const tool = this.#moves(point) ? this.#mover : this.#tool;
    if (!tool || !("begin" in tool) || !this.#options.ready()) {
      return;
    }
    this.end();
    this.#work(tool);
    this.#touch(point.x, point.y);
    tool.begin(point);
  }

  /** A finger lies at a place, be it on a branch or not. */
  #touch(x: number, y: number): void {
    const view = this.#kit?.view;
    // Picking looks at the whole tree; where no wind blows it is to no purpose.
    const row = view?.air?.blowing ? view.pick(x, y, PICK_TOLERANCE)?.row : undefined;
    const rows = [...(this.touched.peek()?.rows ?? []), ...(row === undefined ? [] : [row])];
    this.touched.value = { rows, elsewhere: descriptorOf(this.chosen.peek()).stillsTree ? 0 : ELSEWHERE };
  }

  #untouch(): void {
    if (this.#active === null) {
      this.touched.value = null;
    }
  }

  #moves(point: StrokePoint): boolean {
    const moving = this.#options.arranging() && descriptorOf(this.chosen.peek()).keepsObstacles !== true;
    return moving && this.#mover?.grips(point) === true;
  }

  /** The tool that is chosen. */
  get #tool(): AnyTool | undefined {
    return this.made.peek()?.[this.chosen.peek()];
  }

  get #all(): readonly AnyTool[] {
    return Object.values(this.made.peek() ?? {});
  }
}

/** Code that does not come is no reason to end the page: the tool is missing until it is chosen again. */
function lost(error: unknown): null {
  console.warn("A tool could not be loaded:", error);
  return null;
}
