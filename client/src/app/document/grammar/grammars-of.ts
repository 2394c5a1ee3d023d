import { computed, effect, signal } from "@preact/signals";
import type { GrammarOrigins } from "../../../wire/generated";
import { browserClock } from "../../page/clock";
import { explained } from "../../problems/explained";
import type { Studio } from "../../studio";
import { growthAhead } from "../growth/growth-ahead";
import { DepthControl } from "./depth-control";
import { Drafts } from "./drafts";
import { Framing } from "./framing";
import { checkGrammar, originsIn } from "./grammar-api";
import { GrammarEditing } from "./grammar-editing";
import { Origins } from "./origins";
import { GrammarSpace } from "./space";

/** All that a page does with grammars. */
export interface Grammars {
  readonly editing: GrammarEditing;
  readonly depth: DepthControl;
  readonly origins: Origins;
  readonly space: GrammarSpace;
}

const KINDS = ["set_grammar", "set_grammar_body", "set_grammar_values", "derive", "go_to"] as const;
/** So far beside what stands there a grammar is planted, in internodes. */
const ASIDE = 20;
/** What has made nothing. */
const NOTHING: GrammarOrigins = { depth: 0, rules: [], rows: [], by: [] };
const MADE = new WeakMap<Studio, Grammars>();

/** The grammars of a page, from the first time that somebody asks for them on. */
export function grammarsOf(studio: Studio): Grammars {
  const known = MADE.get(studio);
  if (known) {
    return known;
  }
  const { inForce } = studio.grammar;
  /** Counts what was sent and answered. */
  const traffic = signal(0);
  const busy = computed(() => {
    traffic.value;
    const pending = studio.document.value?.pending_steps ?? 0;
    return pending > 0 || KINDS.some((kind) => studio.link.unsettled(kind) > 0);
  });
  const submit: Studio["submit"] = (command) => {
    const id = studio.submit(command);
    if (command.kind !== "set_grammar_values") {
      framing.changed();
    }
    traffic.value += 1;
    return id;
  };
  const failed = (error: unknown) => void explained(error).then((text) => studio.toasts.show(text));
  const page = { inForce, submit, newGesture: () => studio.link.next, busy, clock: browserClock };
  const framing = new Framing(studio);
  effect(() => {
    if (inForce.value !== null && !busy.value && studio.rows.value > 1) {
      framing.settled();
    }
  });
  const editing = new GrammarEditing({
    ...page,
    ahead: () => growthAhead(studio.document.peek(), false),
    room: () => {
      if ((studio.document.peek()?.metamers ?? 0) === 0) {
        return null;
      }
      const { max } = studio.table.bounds();
      return [Math.round(max[0]) + ASIDE, 0, 0];
    },
    planting: () => framing.planted(),
    session: studio.link.session,
    drafts: new Drafts(localStorage, sessionStorage),
    check: checkGrammar,
    failed,
  });
  const depth = new DepthControl({
    ...page,
    travel: (steps) => {
      studio.time.by(steps);
      framing.changed();
      traffic.value += 1;
    },
    steered: () => editing.steer(),
    stepsAhead: () => {
      const timeline = studio.time.timeline.peek();
      return timeline === null ? 0 : timeline.last_step - timeline.step;
    },
  });
  const origins = new Origins({
    ask: () => {
      const session = studio.link.session.peek();
      return session === null ? Promise.resolve(NOTHING) : originsIn(session);
    },
    inForce,
    revision: studio.revision,
    failed,
  });
  studio.grammar.listener = {
    settle: (settled) => {
      editing.values.settle(settled);
      traffic.value += 1;
    },
    refused: (command) => {
      if (command.kind === "set_grammar") {
        editing.refuse(command);
      }
      traffic.value += 1;
    },
    ended: () => editing.refuseLast(),
    letGo: () => {
      editing.letGo();
      depth.rest();
      traffic.value += 1;
    },
  };
  addEventListener("pagehide", () => editing.leave());
  editing.typing.subscribe((typing) => {
    studio.grammar.writing.value = typing;
  });
  const space = new GrammarSpace({
    inForce,
    outline: studio.outline,
    chosen: studio.tools.chosen,
    choose: (tool) => studio.tools.choose(tool),
    submit,
  });
  const made = { editing, depth, origins, space };
  MADE.set(studio, made);
  return made;
}
