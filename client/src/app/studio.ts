import { batch, signal } from "@preact/signals";
import { viewIn, WHOLE } from "../scene/camera/view";
import type { DrawMode } from "../scene/mode/draw-mode";
import { axisStart } from "../scene/table/branch-rows";
import { TreeTable } from "../scene/table/tree-table";
import { FrameKind } from "../wire/envelope";
import type { Frame } from "../wire/frame";
import type { AppearancePatch, Command, DocumentState, Parameters, ParametersPatch } from "../wire/generated";
import { decodeServerFrame } from "../wire/server-frame";
import { BranchWork } from "./branch-work";
import { ChosenBud } from "./chosen-bud";
import { leaveRecord, newClientKey, takeRecord } from "./client-record";
import { browserClock, Connection } from "./connection";
import type { Phase, StopReason } from "./connection-core";
import { Draft, type GrowthAhead } from "./draft";
import { Exports, keepFile } from "./exports";
import { GrowControl } from "./grow-control";
import { createSession, sessionExists, socketAddress } from "./library-api";
import { LookDraft } from "./look-draft";
import { ObstacleList } from "./obstacle-list";
import { followPageLife } from "./page-life";
import { PartedSessions } from "./parted-sessions";
import { sentence } from "./plain-words";
import { refused } from "./refusals";
import { mayReload } from "./reload-guard";
import { type AsideServerFrame, rowStore } from "./scene-link";
import { pathOf, sessionInPath } from "./session-address";
import { loadSettings } from "./settings";
import { Stage } from "./stage";
import { TimelineControl } from "./timeline-control";
import { Toasts } from "./toasts";
import { PICK_TOLERANCE } from "./tools/tool";
import { Toolbox } from "./tools/toolbox";
import { Tour } from "./tour";
import { say } from "./words";

/** Cards over the workspace, one at a time. */
export const SHEET_NAMES = ["save", "library", "share", "help", "settings"] as const;
export type SheetName = (typeof SHEET_NAMES)[number];

/** The panels, as they stand in the tool bar. */
export const PANEL_NAMES = ["architecture", "brush", "leaves", "branches", "background", "scene"] as const;
export type PanelName = (typeof PANEL_NAMES)[number];

/** What keeps the workspace from being used, with a way on. */
export type Hindrance = "unknown-session" | "version" | "no-server" | "no-webgl" | "no-picture";

const RETRY_START = 2000;
/** So many attempts at a first connection are quietly made. */
const SILENT_AFTER = 2;

/** An outline grows for so many steps at most. */
const OUTLINE_STEPS = 400;

/** One open page: the session it shows and the tools at hand. */
export class Studio {
  readonly settings = loadSettings(localStorage);
  readonly toasts = new Toasts();
  readonly session = signal<string | null>(null);
  readonly phase = signal<Phase>("idle");
  readonly attempts = signal(0);
  /** How often of late what the server sent could not be read. */
  readonly garbled = signal(0);
  readonly hindrance = signal<Hindrance | null>(null);
  readonly document = signal<DocumentState | null>(null);
  /** What trees grow by, as it is set here and by others. */
  readonly growing = new Draft<Parameters, null>({
    none: null,
    submit: (parameters, gesture) => this.submit({ kind: "set_parameters", parameters, ...joined(gesture) }),
    newGesture: () => this.newGesture(),
    ahead: () => this.#ahead(),
    clock: browserClock,
  });
  readonly parameters = this.growing.value;
  /** How the tree looks, as it is set here and by others. */
  readonly looks = new LookDraft({
    submit: (appearance, gesture) => this.submit({ kind: "set_appearance", appearance, ...joined(gesture) }),
    newGesture: () => this.newGesture(),
    ahead: () => this.#ahead(),
    clock: browserClock,
  });
  readonly appearance = this.looks.value;
  readonly rows = signal(0);
  /** Counts the frames of rows that came in. */
  readonly revision = signal(0);
  readonly sent = signal(0);
  readonly settled = signal(0);
  readonly sheet = signal<SheetName | null>(null);
  readonly panel = signal<PanelName | null>(null);
  /** What is shown of the tree, on this device alone. */
  readonly drawMode = signal<DrawMode>("lit");
  /** Whether the sun keeps its place on the glass while the tree is turned. */
  readonly sunPinned = signal(false);
  /** Whether nothing but the workspace is shown. */
  readonly bare = signal(false);
  readonly table = new TreeTable();
  readonly bud = new ChosenBud(this.table);
  readonly obstacles = new ObstacleList({
    submit: (command) => this.submit(command),
    newGesture: () => this.newGesture(),
    session: () => this.session.peek(),
    failed: (error) => this.toasts.show(sentence(error)),
  });
  readonly exports = new Exports({
    session: () => this.session.peek(),
    give: keepFile,
    failed: (error) => this.toasts.show(sentence(error)),
  });
  readonly growth = new GrowControl({
    submit: (command) => this.submit(command),
    ready: () => this.phase.peek() === "connected",
    newGesture: () => this.#next(),
    unsettled: () => this.#unsettled("grow") + this.#unsettled("ungrow"),
    pendingSteps: () => this.document.peek()?.pending_steps ?? 0,
    bud: () => this.bud.row.peek(),
    hold: () => this.stage.hold(),
  });
  readonly time = new TimelineControl({
    goTo: (step) => this.submit({ kind: "go_to", step }),
    takeFuture: (future) => this.submit({ kind: "take_future", future }),
    ready: () => this.phase.peek() === "connected",
    unsettled: () => this.#unsettled("go_to"),
    revision: () => this.revision.peek(),
    hold: () => this.stage.hold(),
  });
  readonly branches: BranchWork = new BranchWork({
    table: this.table,
    submit: (command) => this.submit(command),
    newGesture: () => this.#next(),
    predict: (rows, steps) => this.#connection?.predict(rows, steps) ?? false,
    limits: () => this.tools.shaping.peek()?.width.limits.peek() ?? new Set(),
    cut: (rows) => this.tools.shaping.peek()?.prune.cut(rows),
    screen: () => this.stage.middle(),
    say: (text) => this.toasts.show(say(text)),
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
    hold: () => this.stage.hold(),
    ready: () => this.#connection !== null && this.hindrance.peek() === null,
    arranging: () => this.panel.peek() === "scene",
    choose: (x, y) => this.chooseBud(x, y),
  });

  readonly tour = new Tour({
    settings: this.settings,
    ready: () => this.phase.value === "connected" && this.rows.value > 0 && this.hindrance.value === null,
    drawn: () => (this.tools.drawing.value ? 0 : (this.document.value?.metamers ?? 0)),
    turned: () => this.stage.turned,
    growing: () => this.growth.deflection.value !== 0,
  });

  readonly stage: Stage = new Stage(this.table, this.settings, () => this.tools.drawing.peek());

  #connection: Connection<Frame, AsideServerFrame> | null = null;
  #parted = new PartedSessions();
  #framed = false;
  /** The view is no longer that of a fresh page. */
  #moved = false;

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
      history.replaceState(null, "", pathOf(session));
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
      history.pushState(null, "", pathOf(session));
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

  /** Sets parameters of growth; with a gesture they are one operation for undo with what else has it. */
  setParameters(parameters: ParametersPatch, gesture?: number): void {
    this.growing.commit(parameters, gesture);
  }

  /** Sets fields of the appearance; with a gesture as above. */
  dress(appearance: AppearancePatch, gesture?: number): void {
    this.looks.commit(appearance, gesture);
  }

  /** A number that no other operation of this client has. */
  newGesture(): number {
    return this.#next();
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
    if (this.bare.peek()) {
      this.bare.value = false;
    } else if (this.branches.prediction.rows.peek() !== null) {
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

  /** Hides everything but the workspace, or brings it back. */
  setBare(bare: boolean): void {
    this.bare.value = bare;
  }

  /** Sends a command and gives its number; 0 while no session is open. */
  submit(command: Command): number {
    // The server gives up what it was asked to predict and does not always say so (`PD2`).
    this.branches.prediction.lost();
    return this.#connection?.submit(command) ?? 0;
  }

  #next(): number {
    return this.#connection?.next ?? 1;
  }

  /** Whether the server still grows what was asked for before. */
  #busy(): boolean {
    return (this.document.peek()?.pending_steps ?? 0) > 0;
  }

  /** What it has still to grow; of an outline nobody knows how many steps, only how many at most (`LA1`). */
  #ahead(): GrowthAhead {
    const { step = 0, pending_steps: pending = 0 } = this.document.peek() ?? {};
    const outlined = pending > 0 && this.tools.outline.shown.peek()?.stage === "growing";
    return { step, pending: outlined ? Math.max(pending, OUTLINE_STEPS) : pending };
  }

  #unsettled(kind: Command["kind"]): number {
    return this.#connection?.unsettled(kind) ?? 0;
  }

  #open(session: string): void {
    this.leave();
    batch(() => {
      this.session.value = session;
      this.settings.lastSession.value = session;
      // Another session does not make a browser draw that cannot.
      this.hindrance.value = this.stage.dark ? "no-webgl" : null;
      this.document.value = null;
      this.growing.clear();
      this.looks.clear();
      this.rows.value = 0;
      this.bud.release();
      this.tools.clear();
      this.obstacles.forget();
      this.time.clear();
      this.branches.clear();
    });
    this.#moved ||= this.#framed;
    this.#framed = false;
    this.table.clear();
    this.stage.changed();
    this.#parted.come(sessionStorage);
    const parted = this.#parted.take(session);
    const record = takeRecord(sessionStorage, session) ?? parted;
    this.#connection = new Connection<Frame, AsideServerFrame>({
      openSocket: () => new WebSocket(socketAddress(session, location)),
      clock: browserClock,
      rows: rowStore(this.table),
      decode: decodeServerFrame,
      newKey: newClientKey,
      ...(record ? { record } : {}),
      events: {
        phase: (phase, attempts, stopped, garbled) => {
          this.garbled.value = garbled;
          this.#onPhase(phase, attempts, stopped);
        },
        commands: (sent, settled) => {
          batch(() => {
            this.sent.value = sent;
            this.settled.value = settled;
          });
          this.growing.settle(settled);
          this.looks.settle(settled);
          this.tools.told();
          this.tools.outline.settled(settled);
        },
        state: (state) => {
          this.document.value = state;
          this.tools.told();
          this.tools.outline.told(this.#connection?.settled ?? 0, state.pending_steps);
        },
        parameters: (parameters) => this.growing.receive(parameters),
        appearance: (appearance) => this.looks.receive(appearance),
        obstacles: (obstacles) => {
          // An empty list may also mean a welcome, after which ids mean what they now mean (`OB5`).
          obstacles.length === 0 ? this.obstacles.clear() : this.obstacles.receive(obstacles);
        },
        aside: (aside) => {
          if (aside.kind === FrameKind.Ghost) {
            this.branches.prediction.receive(aside.frame);
          } else {
            this.tools.receivePose(aside.frame);
          }
        },
        widths: (widths) => this.tools.receiveWidths(widths),
        timeline: (timeline) => this.time.receive(timeline),
        problem: (problem, command) => refused(this, problem, command),
        rows: () => this.#onRows(),
        rekeyed: () => {
          this.growing.letGo();
          this.looks.letGo();
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
      this.tools.losePoses();
      this.branches.prediction.lost();
    }
    batch(() => {
      this.phase.value = phase;
      this.attempts.value = attempts;
      if (stopped !== null) {
        this.hindrance.value = stopped;
      } else if (phase === "connected" && this.hindrance.peek() === "no-server") {
        this.hindrance.value = null;
      } else if (attempts >= SILENT_AFTER && this.document.peek() === null) {
        // With nothing on the page yet there is nothing to do but wait.
        this.hindrance.value ??= "no-server";
      }
    });
    if (stopped === "unknown-session" && this.settings.lastSession.peek() === this.session.peek()) {
      this.settings.lastSession.value = null;
    }
  }

  #onRows(): void {
    this.rows.value = this.table.rows;
    this.revision.value += 1;
    this.branches.hand.keep();
    this.tools.told();
    if (!this.bud.keep()) {
      this.toasts.show(say("notices.bud-lost"));
    }
    this.stage.changed();
    if (!this.#framed && this.table.rows > 0) {
      this.#framed = true;
      // A page opens with a view that suits a seed; a tree that is there already is shown as a whole.
      const grown = this.table.parent.subarray(0, this.table.rows).some((parent) => parent >= 0);
      const view = viewIn(location.search) ?? (grown && !this.#moved ? WHOLE : null);
      if (view) {
        this.stage.look(view);
      } else if (this.#moved) {
        this.stage.frameTree();
      }
    }
  }

  /** The branch that was chosen is gone: it was shed, or someone went back to before it grew. */
  loseBud(): void {
    this.tools.abandon();
    if (this.bud.row.peek() !== null) {
      this.bud.release();
      this.toasts.show(say("notices.bud-lost"));
    }
  }

  /** Ends what is under way and lets the session go. */
  leave(): void {
    this.tools.end();
    this.growth.release();
    this.#part();
    this.#connection?.close();
    this.#connection = null;
  }

  /** Keeps what the server may not have got of the session that is left. */
  #part(): void {
    const [session, connection] = [this.session.peek(), this.#connection];
    const gone = this.hindrance.peek() === "unknown-session";
    if (session === null || connection === null || gone || connection.settled >= connection.next - 1) {
      return;
    }
    this.#parted.keep(session, connection.record());
    if (this.phase.peek() !== "connected") {
      this.toasts.show(say("sheets.parted"));
    }
  }

  /** Ends strokes and keeps what is unsent when the page goes, wakes the connection when it comes back. */
  followPageLife(): () => void {
    return followPageLife({
      leaving: () => {
        this.tools.end();
        this.growth.release();
        const session = this.session.peek();
        if (session !== null && this.#connection) {
          leaveRecord(sessionStorage, session, this.#connection.record());
        }
        this.#parted.leave(sessionStorage);
      },
      returning: () => {
        // This page still lives and has all of it; the copy was for a page after it.
        takeRecord(sessionStorage, this.session.peek() ?? "");
        this.#parted.come(sessionStorage);
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

/** A gesture as a command carries it. */
function joined(gesture: number | undefined): { gesture?: number } {
  return gesture === undefined ? {} : { gesture };
}
