import type { ReadonlySignal } from "@preact/signals";
import type { Command, Deed, DocumentState } from "../../../wire/generated";
import type { Toasts } from "../../page/toasts";
import type { PeopleHere } from "../../together/together";
import { say } from "../../words/say";

const UNDOING: ReadonlySet<Command["kind"]> = new Set(["undo", "redo", "take_back", "bring_back"]);

/** The parts of a page that undoing concerns. */
export interface UndoTargets {
  readonly document: ReadonlySignal<Pick<DocumentState, "can_undo" | "can_redo"> | null>;
  readonly together: { readonly people: ReadonlySignal<Pick<PeopleHere, "people"> | null> };
  readonly toasts: Pick<Toasts, "show">;
  submit(command: Command): void;
}

/**
 * Undo and redo. Who is alone goes through all that was done on the line; where others are here it is everyone's own:
 * what somebody takes back is theirs, and what others did stays (`UD`).
 */
export class OwnUndo {
  readonly #page: UndoTargets;
  /** Taps that have not been answered. */
  #taps = 0;

  constructor(page: UndoTargets) {
    this.#page = page;
  }

  /** Whether others are here. */
  get isShared(): boolean {
    return (this.#page.together.people.value?.people.length ?? 0) > 1;
  }

  /** Whether there may be something to undo, or redo; what is one's own the server knows. */
  may(kind: "undo" | "redo"): boolean {
    const document = this.#page.document.value;
    return document !== null && (document[`can_${kind}`] || (kind === "redo" && this.isShared));
  }

  undo(): void {
    this.#page.submit({ kind: this.isShared ? "take_back" : "undo" });
  }

  redo(): void {
    this.#page.submit({ kind: this.isShared ? "bring_back" : "redo" });
  }

  /** Two fingers undo and three redo, as in drawing programs; a tap is easily made unawares, so it says what it did. */
  tapped(fingers: number): void {
    const kind = ({ 2: "undo", 3: "redo" } as const)[fingers];
    if (!kind || this.#page.document.peek() === null) {
      return;
    }
    if (!this.may(kind)) {
      this.#page.toasts.show(say(`operations.${kind}.none`));
      return;
    }
    this.#taps++;
    this[kind]();
  }

  /** Something was undone or redone that this page asked for. Buttons say so only where not all went, or others are here. */
  done({ kind, away, held, passed = 0 }: Deed): void {
    const isTapped = this.#taps > 0;
    this.#taps = Math.max(0, this.#taps - 1);
    if (isTapped || held > 0 || passed > 0 || this.isShared) {
      const what = say(`operations.kind.${kind}`);
      const done = say(away ? "operations.undone" : "operations.redone", { what });
      const said = passed > 0 ? say("operations.passed", { said: done, passed }) : done;
      this.#page.toasts.show(held > 0 ? say("operations.held", { said, held }) : said);
    }
  }

  /** The server has refused something: a tap may be answered with it. */
  refused(command?: Command): void {
    if (command && UNDOING.has(command.kind)) {
      this.#taps = Math.max(0, this.#taps - 1);
    }
  }

  /** The link is another one: nothing that was tapped is answered any more. */
  forget(): void {
    this.#taps = 0;
  }
}
