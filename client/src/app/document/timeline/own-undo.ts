import type { ReadonlySignal } from "@preact/signals";
import type { Command, Deed, DocumentState, Problem, Timeline, TimelineOperation } from "../../../wire/generated";
import type { Toasts } from "../../page/toasts";
import { personHere } from "../../together/person-here";
import type { Together } from "../../together/together";
import { language, say } from "../../words/say";
import { authorName, distinctParts } from "./authors";
import { type OwnDeeds, ownDeeds } from "./own-deeds";

const UNDOING: ReadonlySet<Command["kind"]> = new Set(["take_back", "bring_back"]);
/** So many of those who did what was done last are named. */
const NAMED = 3;

/** The parts of a page that undoing concerns. */
export interface UndoTargets {
  readonly document: ReadonlySignal<Pick<DocumentState, "can_undo" | "can_redo"> | null>;
  readonly time: { readonly timeline: ReadonlySignal<Pick<Timeline, "operations" | "done"> | null> };
  readonly together: Pick<Together, "people" | "authors">;
  readonly toasts: Pick<Toasts, "show">;
  submit(command: Command): void;
}

/** Undo and redo, which are everyone's own: what somebody takes back is theirs, and what others did stays (`UD`). */
export class OwnUndo {
  readonly #page: UndoTargets;
  /** Taps that have not been answered. */
  #taps = 0;

  constructor(page: UndoTargets) {
    this.#page = page;
  }

  /** Whether others are here, or have done something that is on the line of time. */
  get #isShared(): boolean {
    const { people } = this.#page.together;
    return (people.peek()?.people.length ?? 0) > 1 || this.#ofOthers.length > 0;
  }

  /** The operations in force that others did, or had a part in. */
  get #ofOthers(): readonly TimelineOperation[] {
    const you = this.#you;
    const { operations, done } = this.#page.time.timeline.peek() ?? { operations: [], done: 0 };
    const isOfOthers = (one: TimelineOperation) => distinctParts(one).some(({ author }) => author !== you);
    return you === null ? [] : operations.slice(0, done).filter(isOfOthers);
  }

  get #you(): number | null {
    return personHere(this.#page.together.people.peek());
  }

  /** Whether there may be something to undo, or redo; what of it is one's own the server knows, and says. */
  may(kind: "undo" | "redo"): boolean {
    const document = this.#page.document.value;
    const { isAlone, forth } = this.#own;
    return document !== null && (kind === "undo" || isAlone ? document[`can_${kind}`] : forth !== null);
  }

  get #own(): OwnDeeds {
    const timeline = this.#page.time.timeline.value ?? { operations: [], done: 0 };
    return ownDeeds(timeline, personHere(this.#page.together.people.value));
  }

  undo(): void {
    this.#page.submit({ kind: "take_back" });
  }

  redo(): void {
    this.#page.submit({ kind: "bring_back" });
  }

  /** Two fingers undo and three redo, as in drawing programs; a tap is easily made unawares, so it says what it did. */
  tapped(fingers: number): void {
    const kind = ({ 2: "undo", 3: "redo" } as const)[fingers];
    if (!kind || this.#page.document.peek() === null) {
      return;
    }
    if (!this.may(kind)) {
      const liesAhead = kind === "redo" && this.#page.document.peek()?.can_redo === true;
      this.#page.toasts.show(say(liesAhead ? "operations.redo.line" : `operations.${kind}.none`));
      return;
    }
    this.#taps++;
    this[kind]();
  }

  /** Something was undone or redone that this page asked for. Buttons say so only where not all went, or others take part. */
  done({ kind, away, held, passed = 0 }: Deed): void {
    const isTapped = this.#taps > 0;
    this.#taps = Math.max(0, this.#taps - 1);
    if (isTapped || held > 0 || passed > 0 || this.#isShared) {
      const what = say(`operations.kind.${kind}`);
      const done = say(away ? "operations.undone" : "operations.redone", { what });
      const said = passed > 0 ? say("operations.passed", { said: done, passed }) : done;
      this.#page.toasts.show(held > 0 ? say("operations.held", { said, held }) : said);
    }
  }

  /** The server has refused something: a tap may be answered with it. Whether that has been said in better words. */
  refused({ reason }: Pick<Problem, "reason">, command?: Command): boolean {
    if (!command || !UNDOING.has(command.kind)) {
      return false;
    }
    this.#taps = Math.max(0, this.#taps - 1);
    const who = this.#lastOthers();
    if (reason === "nothing-of-yours" && who !== "") {
      this.#page.toasts.show(say("operations.undo.theirs", { who }));
      return true;
    }
    if (reason === "nothing-to-redo" && this.#page.document.peek()?.can_redo) {
      this.#page.toasts.show(say("operations.redo.line"));
      return true;
    }
    return false;
  }

  /** Who else did what was done last and is in force. */
  #lastOthers(): string {
    const { together } = this.#page;
    const you = this.#you;
    const inForce = this.#ofOthers.filter(({ kind }) => kind !== "taken_back" && kind !== "brought_back");
    const authors = inForce.reverse().flatMap(distinctParts);
    const others = new Set(authors.filter((part) => part.author !== you && !part.away).map(({ author }) => author));
    const names = [...others].slice(0, NAMED).map((author) => authorName(author, together));
    return new Intl.ListFormat(language.value).format(names);
  }

  /** The link is another one: nothing that was tapped is answered any more. */
  forget(): void {
    this.#taps = 0;
  }
}
