import type { Signal } from "@preact/signals";
import { UNDYED } from "../scene/table/row-dyes";
import type { TreeTable } from "../scene/table/tree-table";
import type { DocumentState, Parameters } from "../wire/generated";
import { FrameKind } from "../wire/generated";
import type { Rights } from "./access/rights";
import type { Comments } from "./comments/comments";
import { handle, type MessageHandlers } from "./connection/page-message";
import type { ServerTime } from "./connection/server-time";
import type { Opening, SessionEvents } from "./connection/session-link";
import type { LookDraft } from "./document/appearance/look-draft";
import type { DesignSignal } from "./document/design/design-signal";
import type { Draft } from "./document/draft";
import type { GrammarSignal } from "./document/grammar/grammar-signal";
import type { GrowControl } from "./document/growth/grow-control";
import type { ProgrammeControl } from "./document/growth/programme-control";
import type { OwnUndo } from "./document/timeline/own-undo";
import type { WindTold } from "./document/wind/wind-control";
import type { UnsavedTrees } from "./library/unsaved-trees";
import type { Layout } from "./page/layout";
import { explained, plainWords } from "./problems/explained";
import { type RefusalTargets, refused } from "./problems/refusals";
import type { Together } from "./together/together";
import type { SharedBends } from "./tools/bend/shared-bends";
import type { StrokeTrail } from "./tools/brush/stroke-trail";
import type { DrawnInVain } from "./tools/drawn-in-vain";
import type { OutlineTrace } from "./tools/lasso/outline-trace";
import { toolFor } from "./tools/tools";
import type { WidthList } from "./tools/width/width-list";
import type { FirstView } from "./view/first-view";
import type { Stage } from "./view/stage";
import { say } from "./words/say";

/** The parts of a page that follow its session. */
export interface SessionTargets extends RefusalTargets {
  readonly document: Signal<DocumentState | null>;
  readonly growing: Draft<Parameters, null>;
  readonly programme: Pick<ProgrammeControl, "receive">;
  readonly looks: LookDraft;
  readonly windTold: Signal<WindTold | null>;
  readonly growth: GrowControl;
  readonly outline: OutlineTrace;
  readonly trail: StrokeTrail;
  readonly widths: WidthList;
  readonly design: DesignSignal;
  readonly grammar: GrammarSignal;
  readonly bends: SharedBends;
  readonly unsaved: UnsavedTrees;
  readonly layout: Pick<Layout, "sheet">;
  readonly table: TreeTable;
  readonly rows: Signal<number>;
  /** Counts the frames of rows that came in. */
  readonly revision: Signal<number>;
  /** The last command of which nothing is left to do (`CM11`). */
  readonly finished: Signal<number>;
  readonly stage: Pick<Stage, "changed" | "forget">;
  readonly firstView: FirstView;
  readonly drawnInVain: Pick<DrawnInVain, "show" | "clear">;
  readonly together: Together;
  readonly serverTime: Pick<ServerTime, "heard">;
  readonly comments: Pick<Comments, "place" | "change" | "leaving" | "clear">;
  readonly undo: Pick<OwnUndo, "done" | "refused" | "forget">;
  readonly rights: Pick<Rights, "grant" | "leave" | "mayChange">;
}

/** What a page does with the messages of the server: a row for each. */
export function messageHandlers(page: SessionTargets): MessageHandlers {
  return {
    problem: ({ problem }) => refused(page, problem),
    state: ({ state }) => {
      page.document.value = state;
      page.growth.reported();
      page.tools.changed();
    },
    authors: ({ authors }) => {
      page.together.authors.value = authors;
    },
    done: ({ id }) => {
      page.finished.value = id;
      page.outline.done(id);
      page.trail.done(id);
      page.growth.done(id);
    },
    parameters: ({ parameters }) => page.growing.receive(parameters),
    programme: ({ programme, by_hand }) => page.programme.receive(programme, by_hand),
    appearance: ({ appearance, wind_since: since }) => {
      page.windTold.value = { settings: appearance.wind, since };
      page.looks.receive(appearance);
    },
    // An empty list may also mean a welcome, after which ids mean what they now mean (`OB5`).
    obstacles: ({ obstacles }) => (obstacles.length === 0 ? page.obstacles.clear() : page.obstacles.receive(obstacles)),
    timeline: (timeline) => {
      page.time.receive(timeline);
      page.unsaved.follow(timeline);
    },
    timeline_changed: (change) => page.unsaved.follow(page.time.change(change)),
    widths: ({ widths }) => {
      page.widths.all.value = widths;
    },
    design: ({ design }) => page.design.receive(design),
    dyes: ({ dyes, blocks }) => {
      page.design.dyed.value = { dyes, blocks };
    },
    branches: (placed) => {
      page.design.placed.value = placed;
    },
    limb: (told) => {
      page.design.limb.value = told;
    },
    grammar: ({ grammar }) => page.grammar.receive(grammar),
    deed: ({ deed }) => page.undo.done(deed),
    hint: ({ hint }) => {
      page.drawnInVain.show(hint);
      if (hint.stroke !== undefined) {
        page.trail.inVain(hint.stroke);
      }
    },
    people: (people) => page.together.meet(people),
    pong: ({ nonce, at }) => page.serverTime.heard(nonce, at),
    pins: ({ pins }) => page.comments.place(pins),
    threads_changed: ({ threads }) => page.comments.change(threads),
    gathered: (call) => page.together.listener?.gathered(call),
    role: ({ role }) => {
      const before = page.rights.mayChange.peek();
      page.rights.grant(role);
      const mayChange = page.rights.mayChange.peek();
      if (!mayChange) {
        // What was in progress, the server has ended where it was.
        page.tools.abandon();
      }
      // Tools that come and go under somebody's hand are spoken of.
      if (before !== mayChange && page.document.peek() !== null) {
        page.toasts.show(say(mayChange ? "notices.may-draw" : "notices.may-not-draw"));
      }
    },
    notice: async ({ notice }) => {
      const words = await plainWords().catch(() => null);
      page.toasts.show(words ? words.noticed(notice) : say("notices.unread"));
    },
  };
}

/** Hands each event of the session to the parts of a page that it concerns. */
export function sessionEvents(page: SessionTargets): SessionEvents {
  const handlers = messageHandlers(page);
  return {
    message: (message) => handle(handlers, message),
    refused: (problem, command) => {
      const isSaid = page.undo.refused(problem, command);
      if (command) {
        page.grammar.listener?.refused(command);
      } else if (problem.reason === "grammar-ends") {
        // That was found out after the command had been acknowledged.
        page.grammar.listener?.ended();
      }
      if (!isSaid) {
        refused(page, problem, command);
      }
    },
    opened: (how) => forget(page, how),
    rows: () => followRows(page),
    settled: (settled) => {
      page.growing.settle(settled);
      page.looks.settle(settled);
      page.obstacles.settle(settled);
      page.grammar.listener?.settle(settled);
      page.tools.changed();
    },
    aside: (aside) => {
      if (aside.kind === FrameKind.Ghost) {
        page.branches.prediction.receive(aside.frame);
      } else if (aside.kind === FrameKind.Presence) {
        page.together.listener?.receive(aside.frame);
      } else {
        // Someone else bends, so that the code which shows it is needed.
        void page.tools.load(toolFor("bend"));
        page.bends.receive(aside.frame);
      }
    },
    rekeyed: () => {
      page.growing.letGo();
      page.looks.letGo();
      page.obstacles.letGo();
      page.grammar.listener?.letGo();
      page.growth.forget();
      page.undo.forget();
      page.tools.abandon();
      page.outline.clear();
      page.trail.leave();
    },
    renumbered: () => page.together.renumbered(),
    lost: () => {
      page.bends.clear();
      page.together.lost();
      page.branches.prediction.lost();
    },
    leaving: () => {
      page.tools.end();
      page.growth.release();
      page.comments.leaving();
    },
    parted: () => page.toasts.show(say("notices.parted")),
    choosing: () => {
      page.layout.sheet.value = "library";
    },
    failed: (error) => void explained(error).then((text) => page.toasts.show(text)),
  };
}

/** Another session was opened: nothing of the one before counts. */
function forget(page: SessionTargets, { isReplay, isSame }: Opening): void {
  page.document.value = null;
  page.finished.value = 0;
  page.growing.clear();
  page.growth.forget();
  page.looks.clear();
  page.programme.receive(null, []);
  page.rows.value = 0;
  page.bud.release();
  page.tools.clear();
  page.outline.clear();
  page.trail.clear();
  page.bends.clear();
  page.together.forget();
  page.rights.leave(isReplay ? "viewer" : null);
  page.comments.clear();
  page.widths.all.value = [];
  page.design.receive(null);
  page.design.limb.value = null;
  page.design.dyed.value = UNDYED;
  page.grammar.receive(null);
  page.obstacles.forget();
  page.time.clear();
  page.unsaved.clear();
  page.branches.clear();
  page.drawnInVain.clear();
  // Who plays what they see goes on seeing it from where they are.
  if (!isSame) {
    page.firstView.forget();
    page.stage.forget();
  }
  page.table.clear();
  page.stage.changed();
}

function followRows(page: SessionTargets): void {
  page.rows.value = page.table.rows;
  page.revision.value += 1;
  page.trail.grown(page.table);
  page.branches.held.keep();
  page.tools.changed();
  if (!page.bud.keep()) {
    page.toasts.show(say("notices.bud-lost"));
  }
  page.stage.changed();
  page.firstView.follow();
}
