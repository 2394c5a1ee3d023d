import { signal } from "@preact/signals";
import type { Command, GrammarInForce } from "../../../wire/generated";

/** Follows the session once the code that edits grammars is there. */
export interface GrammarListener {
  /** The server has answered all commands up to this one. */
  settle(settled: number): void;
  /** The server would not do a command. */
  refused(command: Command): void;
  /** A grammar came to an end while it was derived; the command was answered before. */
  ended(): void;
  /** The commands that were sent have other numbers now. */
  letGo(): void;
}

/** The grammar in force, as the server told it last (`GR5`), and who on this page edits it. */
export class GrammarSignal {
  readonly inForce = signal<GrammarInForce | null>(null);
  /** Whether somebody writes one on this page. */
  readonly writing = signal(false);
  listener: GrammarListener | null = null;

  receive(grammar: GrammarInForce | null): void {
    this.inForce.value = grammar;
  }
}
