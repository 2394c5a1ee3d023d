import { batch, effect, signal } from "@preact/signals";
import { axisStart } from "../scene/branch-rows";
import { TreeTable } from "../scene/tree-table";
import { Viewport } from "../scene/viewport";
import { FrameKind } from "../wire/envelope";
import type { Frame } from "../wire/frame";
import type { Command, DocumentState, Parameters, ParametersPatch, Problem } from "../wire/generated";
import { decodeServerFrame } from "../wire/server-frame";
import { BranchWork } from "./branch-work";
import { stepRadius } from "./brush-radius";
import { ChosenBud } from "./chosen-bud";
import { leaveRecord, newClientKey, takeRecord } from "./client-record";
import { browserClock, Connection } from "./connection";
import type { Phase, StopReason } from "./connection-core";
import { GrowControl } from "./grow-control";
import { deflectionFor, KEY_RATE } from "./grow-pacer";
import { listenToKeys } from "./keyboard";
import { createSession, sessionExists, socketAddress } from "./library-api";
import { ObstacleList } from "./obstacle-list";
import { publishFacts } from "./page-facts";
import { followPageLife } from "./page-life";
import { plainly } from "./plain-words";
import { listenToPointers } from "./pointer-source";
import { mayReload } from "./reload-guard";
import { type AsideServerFrame, rowStore } from "./scene-link";
import { loadSettings } from "./settings";
import { Stage } from "./stage";
import { TimelineControl } from "./timeline-control";
import { Toasts } from "./toasts";
import { PICK_TOLERANCE } from "./tools/tool";
import { Toolbox } from "./tools/toolbox";

export type SheetName = "save" | "library" | "share" | "help";
export type PanelName = "growth" | "scene";

/** What keeps the workspace from being used, with a way on. */
export type Hindrance = "unknown-session" | "version" | "no-server" | "no-webgl";

const RETRY_START = 2000;
const BUD_LOST = "The chosen branch is gone; every branch grows again.";

/** One open page: the session it shows and the tools at hand. */
export class Studio {
  readonly settings = loadSettings(localStorage);
  readonly toasts = new Toasts();
  readonly session = signal<string | null>(null);
  readonly phase = signal<Phase>("idle");
  readonly attempts = signal(0);
  readonly hindrance = signal<Hindrance | null>(null);
  readonly document = signal<DocumentState | null>(null);
  readonly parameters = signal<Parameters | null>(null);
  readonly rows = signal(0);
  /** Counts the frames of rows that came in. */
  readonly revision = signal(0);
  readonly sent = signal(0);
  readonly settled = signal(0);
  readonly sheet = signal<SheetName | null>(null);
  readonly panel = signal<PanelName | null>(null);
  readonly table = new TreeTable();
  readonly bud = new ChosenBud(this.table);
  readonly obstacles = new ObstacleList({
    submit: (command) => this.submit(command),
    session: () => this.session.peek(),
    failed: (error) => this.toasts.show(sentence(error)),
  });
  readonly growth = new GrowControl({
    submit: (command) => this.submit(command),
    ready: () => this.phase.peek() === "connected",
    newGesture: () => this.#next(),
    unsettled: () => this.#unsettled("grow") + this.#unsettled("ungrow"),
    pendingSteps: () => this.document.peek()?.pending_steps ?? 0,
    bud: () => this.bud.row.peek(),
    held: (held) => this.stage.hold(held),
  });
  readonly time = new TimelineControl({
    goTo: (step) => this.submit({ kind: "go_to", step }),
    takeFuture: (future) => this.submit({ kind: "take_future", future }),
    ready: () => this.phase.peek() === "connected",
    unsettled: () => this.#unsettled("go_to"),
    revision: () => this.revision.peek(),
    held: (held) => this.stage.hold(held),
  });
  readonly branches: BranchWork = new BranchWork({
    table: this.table,
    submit: (command) => this.submit(command),
    newGesture: () => this.#next(),
    predict: (rows, steps) => this.#connection?.predict(rows, steps) ?? false,
    limits: () => this.tools.shaping.peek()?.width.limits.peek() ?? new Set(),
    cut: (rows) => this.tools.shaping.peek()?.prune.cut(rows),
    screen: () => this.stage.middle(),
    say: (sentence) => this.toasts.show(sentence),
    busy: () => this.#busy(),
  });
  readonly tools = new Toolbox({
    table: this.table,
    settings: this.settings,
    toasts: this.toasts,
    bud: this.bud,
    obstacles: this.obstacles,
    branch: this.branches.hand,
    submit: (command) => this.submit(command),
    next: () => this.#next(),
    // What is durable may still have to grow: a heavy tree must not fall behind the finger.
    unsettledMoves: () => Math.max(this.#unsettled("stroke_move"), this.document.peek()?.pending_steps ?? 0),
    // What is durable may have to wait for growth that was asked for before; until then its preview stays.
    unsettled: (kind) => this.#unsettled(kind) + (this.#busy() ? 1 : 0),
    girth: () => {
      const { girth_exponent: exponent = 2.5, twig_diameter: twigDiameter = 0.07 } = this.parameters.peek() ?? {};
      return { exponent, twigDiameter };
    },
    predict: (rows) => this.branches.predict(rows),
    ready: () => this.#connection !== null && this.hindrance.peek() === null,
    arranging: () => this.panel.peek() === "scene",
    choose: (x, y) => this.chooseBud(x, y),
  });

  readonly stage = new Stage(this.table, this.settings, () => this.tools.drawing.peek());

  #connection: Connection<Frame, AsideServerFrame> | null = null;
  #framed = false;
  /** The view is no longer that of a fresh page. */
  #moved = false;

  /** Takes the canvas into use; returns what gives it back. */
  attach(canvas: HTMLCanvasElement): () => void {
    let viewport: Viewport;
    try {
      viewport = new Viewport(canvas, this.table);
    } catch (error) {
      console.error(error);
      this.hindrance.value = "no-webgl";
      return () => {};
    }
    this.stage.attach(viewport, canvas);
    this.branches.attach(viewport);
    this.tools.attach(viewport);
    const keys = listenToKeys({
      undo: () => this.undo(),
      redo: () => this.redo(),
      frame: () => this.stage.frameTree(),
      help: () => {
        this.sheet.value = "help";
      },
      tool: (tool) => this.tools.choose(tool),
      escape: () => this.escape(),
      widen: (notches) => this.stage.setRadius(stepRadius(this.settings.radius.peek(), notches)),
      turn: (right, up, twist) => this.branches.step(right, up, twist),
      travel: (direction, edge) => (edge ? this.time.toEdge(direction) : this.time.by(direction)),
      grow: (direction) =>
        direction === 0 ? this.growth.release() : this.growth.to(direction * deflectionFor(KEY_RATE)),
      busy: () => this.sheet.peek() !== null,
    });
    const stopPointers = listenToPointers(canvas, {
      gesture: (gesture) => {
        this.stage.radiusSeen();
        this.tools.gesture(gesture);
      },
      doubles: () => this.tools.doubles(),
      grip: (x, y) => this.tools.grip(x, y),
      hover: (place) => this.tools.hover(place),
      widen: (factor) => {
        if (!this.branches.step(0, 0, Math.log(factor) * 8)) {
          this.stage.setRadius(stepRadius(this.settings.radius.peek(), Math.log(factor) * 8));
        }
      },
      handHeld: keys.handHeld,
      holdable: (x, y) => this.tools.holdable(x, y),
    });
    const stopPublishing = effect(() => publishFacts(this));
    const stopScene = effect(() => {
      const chosen = this.panel.value === "scene" ? this.obstacles.chosen.value : null;
      viewport.showObstacles(this.obstacles.drawn.value, chosen);
    });
    const stopLife = this.#followPageLife();
    return () => {
      stopLife();
      stopScene();
      stopPublishing();
      stopPointers();
      keys.stop();
      this.#leave();
      this.tools.detach();
      this.branches.detach();
      this.stage.detach();
      viewport.dispose();
    };
  }

  /** Opens what the address names, or the session of last time, or a new one. */
  async start(): Promise<void> {
    const named = sessionInPath(location.pathname);
    if (named !== null) {
      this.#open(named);
      return;
    }
    try {
      const last = this.settings.lastSession.peek();
      const session = last !== null && (await sessionExists(last)) ? last : await createSession();
      history.replaceState(null, "", `/s/${session}`);
      this.#open(session);
    } catch {
      this.hindrance.value = "no-server";
      setTimeout(() => {
        if (this.session.peek() === null) {
          void this.start();
        }
      }, RETRY_START);
    }
  }

  /** Leaves this session for a new one, empty or from a saved tree. */
  async newSession(tree?: string): Promise<void> {
    try {
      const session = await createSession(tree === undefined ? {} : { tree });
      history.pushState(null, "", `/s/${session}`);
      this.#open(session);
      this.sheet.value = null;
    } catch (error) {
      this.toasts.show(sentence(error));
    }
  }

  undo(): void {
    this.submit({ kind: "undo" });
  }

  redo(): void {
    this.submit({ kind: "redo" });
  }

  /** Ends growth that is under way; what has grown stays. */
  stop(): void {
    this.submit({ kind: "stop" });
  }

  setParameters(parameters: ParametersPatch): void {
    this.submit({ kind: "set_parameters", parameters });
  }

  /** Chooses the branch at a place, so that it alone grows; where there is none, or the same, every branch grows. */
  chooseBud(x: number, y: number): void {
    const picked = this.stage.pickRow(x, y, PICK_TOLERANCE);
    const before = this.bud.row.peek();
    const axis = (row: number) => axisStart(this.table, row);
    if (picked === null || (before !== null && axis(picked) === axis(before))) {
      this.bud.release();
      return;
    }
    this.bud.choose(picked);
    this.stage.hideBrush();
    // Where the device can, the hand feels that it may let go.
    navigator.vibrate?.(12);
  }

  /** Steps back from what is most at hand: a drawing, a tool, a choice, a panel. */
  escape(): void {
    if (this.branches.prediction.rows.peek() !== null) {
      this.branches.prediction.discard();
    } else if (this.tools.drawing.peek()) {
      this.tools.cancel();
    } else if (this.tools.release()) {
      // What the tool had marked was most at hand.
    } else if (this.tools.chosen.peek() !== "brush") {
      this.tools.choose("brush");
    } else if (this.bud.row.peek() !== null) {
      this.bud.release();
    } else {
      this.panel.value = null;
    }
  }

  togglePanel(panel: PanelName): void {
    this.panel.value = this.panel.peek() === panel ? null : panel;
  }

  submit(command: Command): void {
    // The server gives up what it was asked to predict and does not always say so (`PD2`).
    this.branches.prediction.lost();
    this.#connection?.submit(command);
  }

  #next(): number {
    return this.#connection?.next ?? 1;
  }

  /** Whether the server still grows what was asked for before. */
  #busy(): boolean {
    return (this.document.peek()?.pending_steps ?? 0) > 0;
  }

  #unsettled(kind: Command["kind"]): number {
    return this.#connection?.unsettled(kind) ?? 0;
  }

  #open(session: string): void {
    this.#leave();
    batch(() => {
      this.session.value = session;
      this.settings.lastSession.value = session;
      // Another session does not make a browser draw that cannot.
      this.hindrance.value = this.stage.lit ? null : "no-webgl";
      this.document.value = null;
      this.rows.value = 0;
      this.bud.release();
      this.tools.clear();
      this.obstacles.clear();
      this.time.clear();
      this.branches.clear();
    });
    this.#moved ||= this.#framed;
    this.#framed = false;
    this.table.clear();
    this.stage.changed();
    const record = takeRecord(sessionStorage, session);
    this.#connection = new Connection<Frame, AsideServerFrame>({
      openSocket: () => new WebSocket(socketAddress(session, location)),
      clock: browserClock,
      rows: rowStore(this.table),
      decode: decodeServerFrame,
      newKey: newClientKey,
      ...(record ? { record } : {}),
      events: {
        phase: (phase, attempts, stopped) => this.#onPhase(phase, attempts, stopped),
        commands: (sent, settled) => {
          batch(() => {
            this.sent.value = sent;
            this.settled.value = settled;
          });
          this.tools.told();
          this.tools.outline.settled(settled);
        },
        state: (state) => {
          this.document.value = state;
          this.tools.told();
          this.tools.outline.told(this.#connection?.settled ?? 0, state.pending_steps);
        },
        parameters: (parameters) => {
          this.parameters.value = parameters;
          this.stage.setLeafSize(parameters.leaf_size);
        },
        obstacles: (obstacles) => {
          // An empty list may also mean a welcome, after which ids mean what they now mean (`OB5`).
          obstacles.length === 0 ? this.obstacles.clear() : this.obstacles.receive(obstacles);
        },
        aside: (aside) => {
          if (aside.kind === FrameKind.Ghost) {
            this.branches.prediction.receive(aside.frame);
          } else {
            this.tools.shaping.peek()?.poses.receive(aside.frame);
          }
        },
        widths: (widths) => this.tools.shaping.peek()?.width.receive(widths),
        timeline: (timeline) => this.time.receive(timeline),
        problem: (problem, command) => this.#onProblem(problem, command),
        rows: () => this.#onRows(),
        rekeyed: () => {
          this.tools.abandon();
          this.tools.outline.clear();
        },
        reload: () => {
          if (mayReload(sessionStorage, Date.now())) {
            location.reload();
          }
        },
      },
    });
  }

  #onPhase(phase: Phase, attempts: number, stopped: StopReason | null): void {
    if (phase !== "connected" && this.phase.peek() === "connected") {
      this.tools.shaping.peek()?.poses.clear();
      this.branches.prediction.lost();
    }
    batch(() => {
      this.phase.value = phase;
      this.attempts.value = attempts;
      if (stopped !== null) {
        this.hindrance.value = stopped;
      }
    });
    if (stopped === "unknown-session" && this.settings.lastSession.peek() === this.session.peek()) {
      this.settings.lastSession.value = null;
    }
  }

  #onProblem(problem: Problem, command?: Command): void {
    if (command?.kind === "lasso") {
      this.tools.outline.clear();
    }
    if (command?.kind === "go_to") {
      this.time.stop();
    }
    this.branches.refused(command);
    this.tools.refused(command);
    if (command?.kind.endsWith("_obstacle")) {
      this.obstacles.preview(null);
    }
    if (problem.code === "not_found" && problem.field === "bud") {
      this.#loseBud();
      return;
    }
    if (problem.code === "not_found" && problem.field === "stroke") {
      // Someone went back in time, which ends every stroke; what was still under way of this one is refused.
      if (this.tools.drawing.peek()) {
        this.toasts.show("The tree went back in time; your stroke ended there.");
      }
      this.tools.abandon();
      return;
    }
    if (problem.code === "not_found" && problem.field === "bend") {
      // What was still under way of a bend that was refused or given up says nothing new.
      return;
    }
    this.toasts.show(plainly(problem));
    console.warn("The server refused:", problem);
  }

  #onRows(): void {
    this.rows.value = this.table.rows;
    this.revision.value += 1;
    this.branches.hand.keep();
    this.tools.told();
    if (!this.bud.keep()) {
      this.toasts.show(BUD_LOST);
    }
    this.stage.changed();
    if (!this.#framed && this.table.rows > 0) {
      this.#framed = true;
      // A page opens with a view that suits a seed; a tree that is there already is shown as a whole.
      if (this.#moved || this.table.parent.subarray(0, this.table.rows).some((parent) => parent >= 0)) {
        this.stage.frameTree();
      }
    }
  }

  /** The server does not know the chosen branch: it was shed, or someone went back to before it grew. */
  #loseBud(): void {
    this.tools.abandon();
    if (this.bud.row.peek() !== null) {
      this.bud.release();
      this.toasts.show(BUD_LOST);
    }
  }

  #leave(): void {
    this.tools.end();
    this.growth.release();
    this.#connection?.close();
    this.#connection = null;
  }

  /** Ends strokes and keeps what is unsent when the page goes, wakes the connection when it comes back. */
  #followPageLife(): () => void {
    return followPageLife({
      leaving: () => {
        this.tools.end();
        this.growth.release();
        const session = this.session.peek();
        if (session !== null && this.#connection) {
          leaveRecord(sessionStorage, session, this.#connection.record());
        }
      },
      returning: () => {
        // This page still lives and has all of it; the copy was for a page after it.
        takeRecord(sessionStorage, this.session.peek() ?? "");
        this.#connection?.wake();
      },
      online: () => this.#connection?.wake(),
      navigated: () => {
        const session = sessionInPath(location.pathname);
        if (session !== null && session !== this.session.peek()) {
          this.#open(session);
        }
      },
    });
  }
}

/** What to tell a person about an error. */
export function sentence(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

function sessionInPath(path: string): string | null {
  const name = /^\/s\/([^/]+)\/?$/.exec(path)?.[1];
  try {
    return name === undefined ? null : decodeURIComponent(name);
  } catch {
    return null;
  }
}
