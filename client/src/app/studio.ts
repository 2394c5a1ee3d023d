import { signal } from "@preact/signals";
import { viewIn, WHOLE } from "../scene/camera/view";
import type { DrawMode } from "../scene/mode/draw-mode";
import { axisStart } from "../scene/table/branch-rows";
import { TreeTable } from "../scene/table/tree-table";
import { FrameKind } from "../wire/envelope";
import type { AppearancePatch, Command, DocumentState, Parameters, ParametersPatch } from "../wire/generated";
import { rowStore } from "./connection/row-store";
import { type SessionEvents, SessionLink } from "./connection/session-link";
import { LookDraft } from "./document/appearance/look-draft";
import { Draft, type GrowthAhead } from "./document/draft";
import { GrowControl } from "./document/growth/grow-control";
import { ObstacleList } from "./document/obstacles/obstacle-list";
import { TimelineControl } from "./document/timeline/timeline-control";
import { Tour } from "./help/tour";
import { Exports, keepFile } from "./library/exports";
import { browserClock } from "./page/clock";
import type { Hindrance } from "./page/hindrance";
import { loadSettings } from "./page/settings";
import { Toasts } from "./page/toasts";
import { explained, plainWords } from "./problems/explained";
import { refused } from "./problems/refusals";
import { BranchWork } from "./tools/branch/branch-work";
import { ChosenBud } from "./tools/chosen-bud";
import { PICK_TOLERANCE } from "./tools/tool";
import { Toolbox } from "./tools/toolbox";
import { Stage } from "./view/stage";
import { say } from "./words/say";

/** Cards over the workspace, one at a time. */
export const SHEET_NAMES = ["save", "library", "share", "help", "settings"] as const;
export type SheetName = (typeof SHEET_NAMES)[number];

/** The panels, as they stand in the tool bar. */
export const PANEL_NAMES = ["architecture", "brush", "leaves", "branches", "background", "scene"] as const;
export type PanelName = (typeof PANEL_NAMES)[number];

/** An outline grows for so many steps at most. */
const OUTLINE_STEPS = 400;

/** One open page: the session it shows and the tools. */
export class Studio {
  readonly settings = loadSettings(localStorage);
  readonly toasts = new Toasts();
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
  readonly sheet = signal<SheetName | null>(null);
  readonly panel = signal<PanelName | null>(null);
  /** What is shown of the tree, on this device alone. */
  readonly drawMode = signal<DrawMode>("lit");
  /** Whether the sun keeps its place on the screen while the tree is turned. */
  readonly sunPinned = signal(false);
  /** Whether nothing but the workspace is shown. */
  readonly bare = signal(false);
  readonly table = new TreeTable();
  /** The session the page is in. */
  readonly link: SessionLink = new SessionLink({
    page: {
      location,
      history,
      store: sessionStorage,
      clock: browserClock,
      openSocket: (address) => new WebSocket(address),
    },
    rows: rowStore(this.table),
    hindrance: this.hindrance,
    dark: () => this.stage.dark,
    lastSession: this.settings.lastSession,
    begun: () => this.document.peek() !== null,
    events: this.#events(),
  });
  readonly bud = new ChosenBud(this.table);
  readonly obstacles = new ObstacleList({
    submit: (command) => this.submit(command),
    newGesture: () => this.newGesture(),
    ahead: () => this.#ahead(),
    clock: browserClock,
    session: () => this.link.session.peek(),
    failed: (error) => void this.#explain(error),
  });
  readonly exports = new Exports({
    session: () => this.link.session.peek(),
    give: keepFile,
    failed: (error) => void this.#explain(error),
  });
  readonly growth = new GrowControl({
    submit: (command) => this.submit(command),
    ready: () => this.link.connected,
    newGesture: () => this.newGesture(),
    unsettled: () => this.link.unsettled("grow") + this.link.unsettled("ungrow"),
    pendingSteps: () => this.document.peek()?.pending_steps ?? 0,
    bud: () => this.bud.row.peek(),
    hold: () => this.stage.hold(),
  });
  readonly time = new TimelineControl({
    goTo: (step) => this.submit({ kind: "go_to", step }),
    takeFuture: (future) => this.submit({ kind: "take_future", future }),
    ready: () => this.link.connected,
    unsettled: () => this.link.unsettled("go_to"),
    revision: () => this.revision.peek(),
    hold: () => this.stage.hold(),
  });
  readonly branches: BranchWork = new BranchWork({
    table: this.table,
    submit: (command) => this.submit(command),
    newGesture: () => this.newGesture(),
    predict: (rows, steps) => this.link.predict(rows, steps),
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
    branch: this.branches.held,
    submit: (command) => this.submit(command),
    next: () => this.link.next,
    // What is durable may still have to grow: a heavy tree must not fall behind the finger.
    unsettledMoves: () => Math.max(this.link.unsettled("stroke_move"), this.document.peek()?.pending_steps ?? 0),
    // What is durable may have to wait for growth that was asked for before; until then its preview stays.
    unsettled: (kind) => this.link.unsettled(kind) + (this.#busy() ? 1 : 0),
    girth: () => {
      const { girth_exponent: exponent = 2.5, twig_diameter: twigDiameter = 0.07 } = this.parameters.peek() ?? {};
      return { exponent, twigDiameter };
    },
    predict: (rows) => this.branches.predict(rows),
    hold: () => this.stage.hold(),
    ready: () => this.link.open && this.hindrance.peek() === null,
    arranging: () => this.panel.peek() === "scene",
    choose: (x, y) => this.chooseBud(x, y),
  });

  readonly tour = new Tour({
    settings: this.settings,
    ready: () => this.link.phase.value === "connected" && this.rows.value > 0 && this.hindrance.value === null,
    drawn: () => (this.tools.drawing.value ? 0 : (this.document.value?.metamers ?? 0)),
    turned: () => this.stage.turned,
    growing: () => this.growth.deflection.value !== 0,
  });

  readonly stage: Stage = new Stage(this.table, this.settings, () => this.tools.drawing.peek());

  #fitted = false;
  /** The view is no longer that of a fresh page. */
  #moved = false;

  /** Leaves this session for a new one, empty or from a saved tree. */
  async newSession(tree?: string): Promise<void> {
    const from = this.sheet.peek();
    // The user may have closed the sheet meanwhile and opened another one.
    if ((await this.link.change(tree)) && this.sheet.peek() === from) {
      this.sheet.value = null;
    }
  }

  undo(): void {
    this.submit({ kind: "undo" });
  }

  redo(): void {
    this.submit({ kind: "redo" });
  }

  /** Ends growth that is in progress; what has grown stays. */
  stop(): void {
    this.submit({ kind: "stop" });
  }

  /** Sets parameters of growth; with a gesture they are one operation for undo with what else has it. */
  setParameters(parameters: ParametersPatch, gesture?: number): void {
    this.growing.commit(parameters, gesture);
  }

  /** Sets fields of the appearance; with a gesture as above. */
  setAppearance(appearance: AppearancePatch, gesture?: number): void {
    this.looks.commit(appearance, gesture);
  }

  /** A number that no other operation of this client has. */
  newGesture(): number {
    return this.link.next;
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
    // Where the device can, the user feels that the hold is over.
    navigator.vibrate?.(12);
  }

  /** Steps back from what is nearest: a drawing, a tool, a choice, a panel. */
  escape(): void {
    if (this.bare.peek()) {
      this.bare.value = false;
    } else if (this.branches.prediction.rows.peek() !== null) {
      this.branches.prediction.discard();
    } else if (this.tools.drawing.peek()) {
      this.tools.cancel();
    } else if (this.tools.release()) {
      // What the tool had marked was nearest.
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
    return this.link.submit(command);
  }

  async #explain(error: unknown): Promise<void> {
    this.toasts.show(await explained(error));
  }

  /** Whether the server still grows what was asked for before. */
  #busy(): boolean {
    return (this.document.peek()?.pending_steps ?? 0) > 0;
  }

  /** The growth that is left; of an outline only the greatest number of steps is known (`LA1`). */
  #ahead(): GrowthAhead {
    const { step = 0, pending_steps: pending = 0 } = this.document.peek() ?? {};
    const outlined = pending > 0 && this.tools.outline.shown.peek()?.stage === "growing";
    return { step, pending: outlined ? Math.max(pending, OUTLINE_STEPS) : pending };
  }

  /** Hands each event of the session to the parts that it concerns. */
  #events(): SessionEvents {
    return {
      opened: () => this.#onOpened(),
      rows: () => this.#onRows(),
      settled: (settled) => {
        this.growing.settle(settled);
        this.looks.settle(settled);
        this.obstacles.settle(settled);
        this.tools.changed();
        this.tools.outline.settled(settled);
      },
      state: (state) => {
        this.document.value = state;
        this.tools.changed();
        this.tools.outline.progressed(this.link.answered, state.pending_steps);
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
      notice: async (notice) => this.toasts.show((await plainWords()).noticed(notice)),
      problem: (problem, command) => refused(this, problem, command),
      rekeyed: () => {
        this.growing.letGo();
        this.looks.letGo();
        this.obstacles.letGo();
        this.tools.abandon();
        this.tools.outline.clear();
      },
      lost: () => {
        this.tools.losePoses();
        this.branches.prediction.lost();
      },
      leaving: () => {
        this.tools.end();
        this.growth.release();
      },
      parted: () => this.toasts.show(say("notices.parted")),
      failed: (error) => void this.#explain(error),
    };
  }

  #onOpened(): void {
    this.document.value = null;
    this.growing.clear();
    this.looks.clear();
    this.rows.value = 0;
    this.bud.release();
    this.tools.clear();
    this.obstacles.forget();
    this.time.clear();
    this.branches.clear();
    this.#moved ||= this.#fitted;
    this.#fitted = false;
    this.table.clear();
    this.stage.changed();
  }

  #onRows(): void {
    this.rows.value = this.table.rows;
    this.revision.value += 1;
    this.branches.held.keep();
    this.tools.changed();
    if (!this.bud.keep()) {
      this.toasts.show(say("notices.bud-lost"));
    }
    this.stage.changed();
    if (!this.#fitted && this.table.rows > 0) {
      this.#fitted = true;
      // A page opens with a view that suits a seed; a tree that is there already is shown as a whole.
      const grown = this.table.parent.subarray(0, this.table.rows).some((parent) => parent >= 0);
      const view = viewIn(location.search) ?? (grown && !this.#moved ? WHOLE : null);
      if (view) {
        this.stage.look(view);
      } else if (this.#moved) {
        this.stage.fitTree();
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
}

/** A gesture as a command carries it. */
function joined(gesture: number | undefined): { gesture?: number } {
  return gesture === undefined ? {} : { gesture };
}
