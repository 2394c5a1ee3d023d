import { signal } from "@preact/signals";
import type { DrawMode } from "../scene/mode/draw-mode";
import { TreeTable } from "../scene/table/tree-table";
import { type Command, DEFAULT_PARAMETERS, type DocumentState, type Parameters } from "../wire/generated";
import { Rights } from "./access/rights";
import { Comments } from "./comments/comments";
import { rowStore } from "./connection/row-store";
import { ServerTime } from "./connection/server-time";
import { SessionLink } from "./connection/session-link";
import { LookDraft } from "./document/appearance/look-draft";
import { DesignSignal } from "./document/design/design-signal";
import { Draft, type GrowthAhead } from "./document/draft";
import { GrammarSignal } from "./document/grammar/grammar-signal";
import { GrowControl } from "./document/growth/grow-control";
import { growthAhead } from "./document/growth/growth-ahead";
import { ProgrammeControl } from "./document/growth/programme-control";
import { ObstacleList } from "./document/obstacles/obstacle-list";
import { OwnUndo } from "./document/timeline/own-undo";
import { TimelineControl } from "./document/timeline/timeline-control";
import type { WindTold } from "./document/wind/wind-control";
import { Tour } from "./help/tour";
import { Exports, keepFile } from "./library/exports";
import { Trees } from "./library/trees";
import { UnsavedTrees } from "./library/unsaved-trees";
import { browserClock } from "./page/clock";
import type { Hindrance } from "./page/hindrance";
import { Layout } from "./page/layout";
import { loadSettings } from "./page/settings";
import { Toasts } from "./page/toasts";
import { explained } from "./problems/explained";
import { askAs } from "./requests/principal";
import { sessionEvents } from "./session-events";
import { Together } from "./together/together";
import { SharedBends } from "./tools/bend/shared-bends";
import { BranchWork } from "./tools/branch/branch-work";
import { StrokeTrail } from "./tools/brush/stroke-trail";
import { chooseBud } from "./tools/bud-choice";
import { ChosenBud } from "./tools/chosen-bud";
import { DrawnInVain } from "./tools/drawn-in-vain";
import { OutlineTrace } from "./tools/lasso/outline-trace";
import { Toolbox } from "./tools/toolbox";
import { WidthList } from "./tools/width/width-list";
import { FirstView } from "./view/first-view";
import { Stage } from "./view/stage";
import { countText } from "./words/measure-text";
import { say } from "./words/say";

/** The side of the pictures of trees that were not saved, in pixels. */
const UNSAVED_PICTURE = 256;

/** One open page: the session it shows and the tools. */
export class Studio {
  readonly settings = loadSettings(localStorage);
  /** What whoever is here may do. */
  readonly rights = new Rights(localStorage);
  readonly toasts = new Toasts();
  readonly hindrance = signal<Hindrance | null>(null);
  /** Why the picture is slow however coarse it is: for want of a graphics card, or for the size of the tree. */
  readonly slowness = signal<"cardless" | "tree" | null>(null);
  readonly document = signal<DocumentState | null>(null);
  /** What trees grow by, as it is set here and by others. */
  readonly growing = new Draft<Parameters, null>({
    none: null,
    submit: (parameters, gesture) => this.submit({ ...this.programme.setting(parameters), ...joined(gesture) }),
    newGesture: () => this.link.next,
    ahead: () => this.#ahead(),
    clock: browserClock,
  });
  readonly parameters = this.growing.value;
  /** The programme that growth goes by. */
  readonly programme: ProgrammeControl = new ProgrammeControl({
    submit: (command) => this.submit(command),
    age: () => this.document.peek()?.age ?? null,
    grownUp: () => this.toasts.show(say("notices.grown-up")),
  });
  /** How the tree looks, as it is set here and by others. */
  readonly looks = new LookDraft({
    submit: (appearance, gesture) => this.submit({ kind: "set_appearance", appearance, ...joined(gesture) }),
    newGesture: () => this.link.next,
    ahead: () => this.#ahead(),
    clock: browserClock,
  });
  readonly appearance = this.looks.value;
  /** The wind among them as the server told it, and since when it blows. */
  readonly windTold = signal<WindTold | null>(null);
  readonly rows = signal(0);
  /** Counts the frames of rows that came in. */
  readonly revision = signal(0);
  /** The last command of which nothing is left to do (`CM11`). */
  readonly finished = signal(0);
  readonly layout = new Layout();
  /** What is shown of the tree, on this device alone. */
  readonly drawMode = signal<DrawMode>("lit");
  /** Whether the sun keeps its place on the screen while the tree is turned. */
  readonly sunPinned = signal(false);
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
    rights: async () => {
      await this.rights.ask();
      return { mayBegin: this.rights.mayBegin, onlyTree: this.rights.onlyTree.peek() };
    },
    begun: () => this.document.peek() !== null,
    events: sessionEvents(this),
  });
  /** The time that all in the session share. */
  readonly serverTime = new ServerTime((nonce) => this.link.tell({ type: "ping", nonce }), browserClock);
  readonly bud = new ChosenBud(this.table);
  readonly outline = new OutlineTrace();
  readonly trail = new StrokeTrail();
  readonly drawnInVain = new DrawnInVain(browserClock);
  readonly widths = new WidthList();
  readonly design = new DesignSignal();
  readonly grammar = new GrammarSignal();
  readonly bends = new SharedBends();
  /** Who else has the tree open. */
  readonly together = new Together();
  /** What people say of the tree. */
  readonly comments = new Comments();
  readonly undo = new OwnUndo(this);
  readonly obstacles = new ObstacleList({
    submit: (command) => this.submit(command),
    newGesture: () => this.link.next,
    ahead: () => this.#ahead(),
    clock: browserClock,
    session: () => this.link.session.peek(),
    simplified: (before, after) =>
      this.toasts.show(say("scene.simplified", { before: countText(before), after: countText(after) })),
    failed: (error) => void this.#explain(error),
  });
  readonly unsaved = new UnsavedTrees({
    list: this.settings.unsavedTrees,
    saved: this.settings.savedState,
    session: () => (this.rights.mayChange.peek() ? this.link.session.peek() : null),
    metamers: () => this.document.peek()?.metamers ?? 0,
    picture: () => this.stage.thumbnail(UNSAVED_PICTURE),
  });
  readonly trees = new Trees({
    link: this.link,
    unsaved: this.unsaved,
    names: this.settings.treeNames,
    sheet: this.layout.sheet,
    say: (text) => this.toasts.show(say(text)),
  });
  readonly exports = new Exports({
    session: () => this.link.session.peek(),
    photograph: (size, stop, tell) => this.stage.picture(size, stop, tell),
    give: keepFile,
    failed: (error) => void this.#explain(error),
  });
  readonly growth = new GrowControl({
    submit: (command) => this.submit(this.programme.paced(command)),
    ready: () => this.link.connected && this.rights.mayChange.peek(),
    newGesture: () => this.link.next,
    unsettled: () => this.link.unsettled("grow") + this.link.unsettled("ungrow"),
    pendingSteps: () => this.document.peek()?.pending_steps ?? 0,
    bud: () => this.bud.row.peek(),
    hold: () => this.stage.hold(),
  });
  readonly time = new TimelineControl({
    goTo: (step) => this.goTo(step),
    takeFuture: (future) => this.submit({ kind: "take_future", future }),
    ready: () => this.link.connected,
    unsettled: () => this.link.unsettled("go_to"),
    revision: () => this.revision.peek(),
    hold: () => this.stage.hold(),
  });
  readonly branches: BranchWork = new BranchWork({
    table: this.table,
    submit: (command) => this.submit(command),
    newGesture: () => this.link.next,
    predict: (rows, steps) => this.link.tell({ type: "predict", rows, steps }),
    limits: () => this.widths.rows.peek(),
    cut: (rows) => this.tools.toolFor("cut")?.cut?.(rows),
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
    outline: this.outline,
    trail: this.trail,
    widths: this.widths,
    bends: this.bends,
    submit: (command) => this.submit(command),
    next: () => this.link.next,
    // What is durable may still have to grow: a heavy tree must not fall behind the finger.
    unsettledMoves: () => Math.max(this.link.unsettled("stroke_move"), this.document.peek()?.pending_steps ?? 0),
    // What is durable may have to wait for growth that was asked for before; until then its preview stays.
    unsettled: (kind) => this.link.unsettled(kind) + (this.#busy() ? 1 : 0),
    girth: () => {
      const { girth_exponent: exponent, twig_diameter: twigDiameter } = this.parameters.peek() ?? DEFAULT_PARAMETERS;
      return { exponent, twigDiameter };
    },
    predict: (rows) => this.branches.predict(rows),
    hold: () => this.stage.hold(),
    ready: () => this.link.open && this.hindrance.peek() === null && this.rights.mayChange.peek(),
    arranging: () => this.layout.panel.peek() === "scene",
    choose: (x, y) => chooseBud(this, x, y),
    tapped: (fingers) => this.undo.tapped(fingers),
  });

  readonly tour = new Tour({
    settings: this.settings,
    ready: () =>
      this.link.phase.value === "connected" &&
      this.rows.value > 0 &&
      this.hindrance.value === null &&
      this.rights.mayChange.value,
    drawn: () => (this.tools.drawing.value ? 0 : (this.document.value?.metamers ?? 0)),
    turned: () => this.stage.turned,
    growing: () => this.growth.deflection.value !== 0,
  });

  readonly stage: Stage = new Stage({
    table: this.table,
    settings: this.settings,
    busy: () => this.tools.drawing.peek(),
    growing: () => this.#busy(),
    tooWide: () => this.toasts.show(say("bars.radius.too-wide")),
  });

  readonly firstView = new FirstView({ stage: this.stage, table: this.table, query: () => location.search });

  constructor() {
    askAs(() => this.link.key);
  }

  /** Sends a command and gives its number; 0 while no session is open. */
  submit(command: Command): number {
    if (!this.rights.mayChange.peek()) {
      this.toasts.show(say("notices.looking-only"));
      return 0;
    }
    // The server gives up what it was asked to predict and does not always say so (`PD2`).
    this.branches.prediction.lost();
    return this.link.submit(command);
  }

  /** Goes to a step of the line of time, for everybody, or in a replay for oneself; gives the number of the command. */
  goTo(step: number): number {
    const command = { kind: "go_to", step } as const;
    return this.link.replaying.peek() ? this.link.submit(command) : this.submit(command);
  }

  /** Whether the server still grows what was asked for before. */
  #busy(): boolean {
    return (this.document.peek()?.pending_steps ?? 0) > 0;
  }

  #ahead(): GrowthAhead {
    return growthAhead(this.document.peek(), this.outline.shown.peek()?.stage === "growing");
  }

  async #explain(error: unknown): Promise<void> {
    this.toasts.show(await explained(error));
  }
}

/** A gesture as a command carries it. */
function joined(gesture: number | undefined): { gesture?: number } {
  return gesture === undefined ? {} : { gesture };
}
