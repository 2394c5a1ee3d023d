import { computed, effect, type ReadonlySignal, signal } from "@preact/signals";
import {
  type CheckGrammar,
  type Command,
  type GrammarDiagnostic,
  type GrammarInForce,
  type GrammarReport,
  type GrammarSlider,
  type GrammarValue,
  MAX_STEPS_PER_COMMAND,
} from "../../../wire/generated";
import type { Clock } from "../../page/clock";
import { NewestOnly } from "../../requests/newest-only";
import { Draft, type GrowthAhead } from "../draft";
import type { Drafts } from "./drafts";
import { LiveText } from "./live-text";
import { saysDepth } from "./typed";

/** How long after the last key the text is looked at, in milliseconds. */
export const CHECK_AFTER = 300;
/** How deep a text is derived that does not say it. */
const UNSAID = 4;
/** How long after the last key a bout of typing is over: what is typed then is a deed of its own. */
export const BOUT = 10_000;

/** What a grammar's sliders are set to, by their names. */
export type Values = Readonly<Record<string, number>>;

type Place = readonly [number, number, number];

/** What somebody is told who loses a text of their own to another one. */
export interface SetAside {
  readonly text: string;
}

/** A text that could not be planted, and how deep it was to be. */
export interface Refused {
  readonly of: string;
  readonly depth: number;
}

export interface GrammarPage {
  readonly inForce: ReadonlySignal<GrammarInForce | null>;
  readonly submit: (command: Command) => number;
  /** A number that no other gesture of this client has, if it is sent at once. */
  readonly newGesture: () => number;
  /** Whether anything that was sent is not answered, or still grows. */
  readonly busy: ReadonlySignal<boolean>;
  readonly ahead: () => GrowthAhead;
  /** Where a plant has room beside what stands here; null where nothing does. */
  readonly room: () => Place | null;
  /** Another plant is on its way than the one that was looked at. */
  readonly planting: () => void;
  /** The session that the page is in; null until it is known. */
  readonly session: ReadonlySignal<string | null>;
  readonly drafts: Drafts;
  readonly check: (check: CheckGrammar) => Promise<GrammarReport>;
  readonly clock: Clock;
  readonly failed: (error: unknown) => void;
}

/** The grammar that a person writes on this page: its text, what is wrong with it, and when it is planted. */
export class GrammarEditing {
  /** What stands in the editor. */
  readonly text = signal("");
  /** The text of somebody else that waits for a decision. */
  readonly theirs = signal<string | null>(null);
  /** What there is to say of a text, and of which. */
  readonly report = signal<{ readonly of: string; readonly report: GrammarReport } | null>(null);
  /** The same of the last text of which sizes are known. */
  readonly sized = signal<{ readonly of: string; readonly report: GrammarReport } | null>(null);
  /** Whether the plant follows the text while somebody types. */
  readonly live = signal(true);
  /** Whether somebody types here, or did a moment ago. */
  readonly typing = signal(false);
  /** What was last taken out of the editor for the sake of another text. */
  readonly setAside = signal<SetAside | null>(null);
  /** What the server would not plant, while it stands in the editor. */
  readonly refused = computed(() => (this.#refused.value?.of === this.text.value ? this.#refused.value : null));
  /** Whether the text that stands in the editor is the one in force. */
  readonly isPlanted = computed(() => this.#page.inForce.value?.text === this.text.value);
  readonly problems = computed<readonly GrammarDiagnostic[]>(() => {
    const said = this.report.value;
    // What is said of an older text stands at the wrong places.
    return said?.of === this.text.value ? said.report.diagnostics : [];
  });
  readonly hasErrors = computed(() => this.problems.value.some(({ severity }) => severity === "error"));
  /** What the sliders are set to, here and by others. */
  readonly values: Draft<Values>;

  readonly #page: GrammarPage;
  readonly #refused = signal<Refused | null>(null);
  readonly #live = new LiveText();
  readonly #checks: NewestOnly<CheckGrammar, { check: CheckGrammar; report: GrammarReport }>;
  readonly #stops: readonly (() => void)[];
  #cancelCheck: (() => void) | null = null;
  #cancelBout: (() => void) | null = null;
  #gesture: number | undefined;
  /** Whether the text is planted once it is known that nothing is wrong with it. */
  #plants = false;
  /** The text that is being looked at. */
  #asking: string | null = null;
  /** Whether a first text is on its way, so that the next one takes its place. */
  #isPlanting = false;
  #isRestored = false;
  /** How deep the text that was sent last is to be. */
  #sentDepth = 0;
  /** The depth that the last text without errors asks for; no number where another text was opened. */
  #asked: number | null = null;
  /** Whether somebody has chosen the depth since, which then stays while the text changes. */
  #isSteered = false;

  constructor(page: GrammarPage) {
    this.#page = page;
    this.values = new Draft<Values>({
      none: {},
      submit: (patch, gesture) =>
        page.submit({ kind: "set_grammar_values", values: valuesOf(patch), ...joined(gesture) }),
      newGesture: page.newGesture,
      ahead: page.ahead,
      clock: page.clock,
    });
    this.#checks = new NewestOnly(
      async (check) => ({ check, report: await page.check(check) }),
      ({ check, report }) => this.#checked(check, report),
      (error) => {
        this.#asking = null;
        page.failed(error);
      },
    );
    this.#stops = [
      effect(() => this.#restore(page.session.value)),
      effect(() => this.#told(page.inForce.value)),
      effect(() => this.#remember(page.session.value)),
    ];
  }

  /** Texts that were put aside, to be had again: not those that stand here anyway. */
  get aside(): readonly string[] {
    const here = [this.text.value, this.#page.inForce.value?.text];
    return this.#page.drafts.aside.value.filter((text) => !here.includes(text));
  }

  /** Opens a text that was put aside: it stands here then, and nowhere else. */
  takeUp(text: string): void {
    this.discard(text);
    this.open(text);
  }

  /** Puts a text aside. */
  keep(text: string): void {
    this.#page.drafts.keep(text);
  }

  /** Forgets a text that was put aside. */
  discard(text: string): void {
    this.#page.drafts.drop(text);
  }

  /** The page is left: what is not planted is kept. */
  leave(): void {
    if (!this.isPlanted.peek()) {
      this.#page.drafts.keep(this.text.peek());
    }
  }

  /** Somebody types. */
  type(text: string): void {
    if (text === this.text.peek()) {
      return;
    }
    this.#live.type(text);
    this.text.value = text;
    this.#lengthenBout();
    this.#checkSoon();
  }

  /** The bout of typing is over, as when the editor loses the focus. */
  endBout(): void {
    this.#cancelBout?.();
    this.#cancelBout = null;
    this.#gesture = undefined;
    this.typing.value = false;
  }

  /** Puts a whole text into the editor, as from a file, and plants it where it is clean. */
  open(text: string): void {
    this.endBout();
    this.#setAside(this.text.peek());
    this.#live.type(text);
    this.#live.keepMine();
    this.text.value = text;
    this.theirs.value = null;
    // Another plant is as deep as its own text asks for.
    this.#asked = Number.NaN;
    this.#ask(true);
  }

  /** Plants the text as it stands, however live the page is; as deep as is said, if anything is. */
  plant(depth?: number): void {
    if (!this.hasErrors.peek()) {
      if (depth !== undefined) {
        this.steer();
      }
      this.#send(depth);
    }
  }

  /** The greatest depth known to be within bounds at which a refused text was not tried yet; null if none is. */
  get possibleDepth(): number | null {
    const [refused, sized] = [this.refused.value, this.sized.value];
    const known = refused !== null && sized?.of === refused.of ? sized.report.sizes.length - 1 : 0;
    const depth = Math.min(known, (refused?.depth ?? 0) - 1);
    return depth > 0 ? depth : null;
  }

  /** The server took the text that was sent last and could not derive it. */
  refuseLast(): void {
    const text = this.#live.unanswered;
    if (text !== null) {
      this.refuse({ text, depth: this.#sentDepth });
    }
  }

  /** The server would not plant a text; what stands there stays. */
  refuse({ text, depth }: { readonly text: string; readonly depth?: number }): void {
    const inForce = this.#page.inForce.peek();
    this.#isPlanting = false;
    this.#live.refuse(text);
    if (text !== inForce?.text) {
      this.#refused.value = { of: text, depth: depth ?? inForce?.depth ?? 0 };
    }
  }

  /** Plants it with other chance. */
  sow(seed: number): void {
    const inForce = this.#page.inForce.peek();
    if (inForce !== null) {
      this.#page.submit({ kind: "set_grammar", text: inForce.text, values: inForce.values, seed });
    }
  }

  /** What somebody else has set goes. */
  takeTheirs(): void {
    this.endBout();
    this.#setAside(this.#live.takeTheirs());
    this.#show();
    this.#ask(false);
  }

  /** What stands in the editor goes, and is planted. */
  keepMine(): void {
    this.#live.keepMine();
    this.theirs.value = null;
    this.#ask(true);
  }

  /** Asks what there is to say of the text, as when the editor is opened. */
  look(): void {
    const text = this.text.peek();
    if (this.report.peek()?.of !== text && this.#asking !== text) {
      this.#ask(false);
    }
  }

  /** The server has answered all commands up to this one. */
  settle(settled: number): void {
    this.values.settle(settled);
  }

  /** The commands that were sent have other numbers now. */
  letGo(): void {
    this.endBout();
    this.values.letGo();
  }

  dispose(): void {
    for (const stop of this.#stops) {
      stop();
    }
    this.#checks.stop();
    this.#cancelCheck?.();
    this.#cancelBout?.();
  }

  #told(inForce: GrammarInForce | null): void {
    this.#isPlanting = false;
    if (inForce === null) {
      this.values.clear();
      this.#live.forget();
      this.theirs.value = null;
      return;
    }
    this.values.receive(valuesIn(inForce));
    this.#page.drafts.drop(inForce.text);
    if (this.#refused.peek()?.of === inForce.text) {
      this.#refused.value = null;
    }
    const unanswered = this.#live.unanswered;
    const told = this.#live.tell(inForce.text, { typing: this.typing.peek(), waiting: this.#page.busy.peek() });
    if (told === "adopt") {
      if (unanswered !== null) {
        this.#page.drafts.keep(unanswered);
      }
      this.endBout();
      this.#show();
      this.#checkSoon();
    }
    this.theirs.value = this.#live.theirs;
  }

  #show(): void {
    this.text.value = this.#live.text;
    this.theirs.value = this.#live.theirs;
  }

  #setAside(text: string): void {
    const isKept = text.trim() === "" || this.#page.inForce.peek()?.text === text;
    this.setAside.value = isKept ? null : { text };
    if (!isKept) {
      this.#page.drafts.keep(text);
    }
  }

  /** What stood here when the page was loaded before stands here again, once the session is known. */
  #restore(session: string | null): void {
    if (session === null || this.#isRestored) {
      return;
    }
    this.#isRestored = true;
    const left = this.#page.drafts.left(session);
    if (left !== null && this.text.peek() === "") {
      this.#live.restore(left.text, left.agreed);
      this.discard(left.text);
      this.text.value = left.text;
    }
  }

  /** What is not planted outlasts the page. */
  #remember(session: string | null): void {
    const text = this.text.value;
    const isSafe = this.isPlanted.value || text.trim() === "";
    if (session !== null) {
      this.#page.drafts.stands(isSafe ? null : { session, text, agreed: this.#live.agreed });
    }
  }

  #lengthenBout(): void {
    this.typing.value = true;
    this.#cancelBout?.();
    this.#cancelBout = this.#page.clock.after(BOUT, () => this.endBout());
  }

  #checkSoon(): void {
    this.#cancelCheck?.();
    this.#cancelCheck = this.#page.clock.after(CHECK_AFTER, () => this.#ask(this.live.peek() && this.typing.peek()));
  }

  #ask(plants: boolean): void {
    this.#cancelCheck?.();
    this.#cancelCheck = null;
    this.#plants = plants;
    this.#asking = this.text.peek();
    this.#checks.ask({ text: this.#asking });
  }

  #checked(check: CheckGrammar, answer: GrammarReport): void {
    const { text } = check;
    const depth = depthFor(text, answer);
    const report = { ...answer, depth };
    this.#asking = null;
    if (text !== this.text.peek()) {
      return;
    }
    if (check.sizes !== true) {
      this.report.value = { of: text, report };
      const isClean = report.diagnostics.every(({ severity }) => severity !== "error");
      if (isClean) {
        if (this.#asked !== null && this.#asked !== depth) {
          this.#isSteered = false;
        }
        if (this.#plants) {
          this.#plants = false;
          this.#send();
        }
        this.#asked = depth;
        const seed = this.#page.inForce.peek()?.seed;
        this.#checks.ask({ text, sizes: true, ...(seed === undefined ? {} : { seed }) });
      }
      return;
    }
    this.report.value = { of: text, report };
    this.sized.value = { of: text, report };
  }

  /** Somebody has chosen a depth: it stays until the text asks for another one. */
  steer(): void {
    this.#isSteered = true;
  }

  /** Plants the text, or changes the plant to it; as deep as the text asks for, unless somebody has chosen the depth. */
  #send(at?: number): void {
    const inForce = this.#page.inForce.peek();
    // Somebody else's text may wait for a decision.
    if (this.theirs.peek() !== null || inForce?.text === this.text.peek()) {
      return;
    }
    if (this.typing.peek()) {
      this.#gesture ??= this.#page.newGesture();
    }
    this.#refused.value = null;
    const text = this.#live.send();
    const gesture = joined(this.typing.peek() ? this.#gesture : undefined);
    const report = this.report.peek()?.report;
    const asked = report?.depth ?? 0;
    const stays = inForce !== null && (this.#isSteered || inForce.later > 0);
    const depth: { depth?: number } = at !== undefined ? { depth: at } : asked > 0 && !stays ? { depth: asked } : {};
    const kept = inForce === null ? [] : keptValues(inForce, report?.sliders ?? []);
    const values = kept.length > 0 ? { values: kept } : {};
    const room = inForce === null && !this.#isPlanting ? this.#page.room() : null;
    const position = room === null ? {} : { position: [...room] as [number, number, number] };
    if (inForce === null || Number.isNaN(this.#asked)) {
      this.#page.planting();
    }
    this.#isPlanting = inForce === null;
    this.#sentDepth = depth.depth ?? inForce?.depth ?? 0;
    this.#page.submit({ kind: "set_grammar", text, ...values, ...depth, ...position, ...gesture });
  }
}

/** How deep a text is derived at first: as it says, or some steps where it says nothing, so that there is something to see. */
function depthFor(text: string, { depth }: Pick<GrammarReport, "depth">): number {
  return saysDepth(text) ? Math.min(depth ?? 0, MAX_STEPS_PER_COMMAND) : UNSAID;
}

/** The values of all sliders of a grammar in force. */
export function valuesIn({ sliders, values }: Pick<GrammarInForce, "sliders" | "values">): Values {
  const set = new Map(values.map(({ name, value }) => [name, value]));
  return Object.fromEntries(sliders.map(({ name, value }) => [name, set.get(name) ?? value]));
}

/**
 * What stays set when a text takes the place of another: sliders whose own value is the same in both. Who changes a
 * number in the text means that number, whatever its slider was set to before.
 */
export function keptValues(
  { sliders, values }: Pick<GrammarInForce, "sliders" | "values">,
  next: readonly GrammarSlider[],
): GrammarValue[] {
  return values.filter(({ name, value }) => {
    const [before, after] = [sliders, next].map((all) => all.find((slider) => slider.name === name));
    return after !== undefined && before?.value === after.value && after.from <= value && value <= after.to;
  });
}

function valuesOf(patch: Partial<Values>): GrammarValue[] {
  return Object.entries(patch).flatMap(([name, value]) => (value === undefined ? [] : [{ name, value }]));
}

/** A gesture as a command carries it. */
function joined(gesture: number | undefined): { gesture?: number } {
  return gesture === undefined ? {} : { gesture };
}
