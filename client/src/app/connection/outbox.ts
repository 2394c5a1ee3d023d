import type { Command } from "../../wire/generated";

/** A command that is not yet known to be durable. */
interface PendingCommand {
  readonly id: number;
  readonly command: Command;
  /** The server has said no; the number stays taken until an acknowledgement passes it (`CM3`). */
  refused: boolean;
}

/** What outlives a page of the commands it sent: their numbering, and those the server may not have yet. */
export interface OutboxRecord {
  readonly next: number;
  readonly acknowledged: number;
  readonly pending: readonly { readonly id: number; readonly command: Command }[];
}

/** The commands of one client key, numbered from 1, each kept until the server is known to have it (`CM1`). */
export class Outbox {
  #next = 1;
  #acknowledged = 0;
  #pending: PendingCommand[] = [];

  constructor(record?: OutboxRecord) {
    if (record) {
      this.#next = record.next;
      this.#acknowledged = record.acknowledged;
      this.#pending = record.pending.map(({ id, command }) => ({ id, command, refused: false }));
    }
  }

  /** The number the next command gets. */
  get next(): number {
    return this.#next;
  }

  /** The highest number up to which every command is durable or refused. */
  get settled(): number {
    const open = this.#pending.find((entry) => !entry.refused);
    return (open?.id ?? this.#next) - 1;
  }

  /** How many commands of a kind the server has neither acknowledged nor refused. */
  unsettled(kind: Command["kind"]): number {
    return this.#pending.reduce((count, entry) => count + (entry.command.kind === kind && !entry.refused ? 1 : 0), 0);
  }

  /** What the server may not have yet, in order: all of it goes out again after a welcome. */
  get pending(): readonly { readonly id: number; readonly command: Command }[] {
    return this.#pending;
  }

  /** What a later page needs to go on. */
  record(): OutboxRecord {
    const pending = this.#pending.map(({ id, command }) => ({ id, command }));
    return { next: this.#next, acknowledged: this.#acknowledged, pending };
  }

  /** Numbers a command and keeps it. */
  put(command: Command): number {
    const id = this.#next++;
    this.#pending.push({ id, command, refused: false });
    return id;
  }

  /** Whether the kept commands continue those that the server has: it would refuse a gap every time (`CM1`). */
  follows(acknowledged: number): boolean {
    return acknowledged + 1 >= (this.#pending[0]?.id ?? this.#next);
  }

  /** The server is known to have everything up to a number, perhaps more than this page knew. */
  acknowledge(id: number): void {
    this.#acknowledged = Math.max(this.#acknowledged, id);
    this.#next = Math.max(this.#next, id + 1);
    const keep = this.#pending.findIndex((entry) => entry.id > id);
    this.#pending.splice(0, keep === -1 ? this.#pending.length : keep);
  }

  /** The command that has a number, while it is kept. */
  commandOf(id: number): Command | undefined {
    return this.#pending.find((entry) => entry.id === id)?.command;
  }

  /** The server has said no to a number; false if it had said so before. */
  refuse(id: number): boolean {
    const entry = this.#pending.find((candidate) => candidate.id === id);
    if (entry?.refused) {
      return false;
    }
    if (entry) {
      entry.refused = true;
    }
    return true;
  }

  /** Numbers what is left from 1, for another key; a stroke or bend whose beginning is gone cannot go on there. */
  startAnew(): void {
    const begun = new Set<string>();
    const kept = this.#pending.filter(({ command, refused }) => {
      const name = "stroke" in command ? `stroke ${command.stroke}` : "bend" in command ? `bend ${command.bend}` : null;
      if (name !== null && command.kind.endsWith("_begin")) {
        begun.add(name);
      }
      return !refused && (name === null || begun.has(name));
    });
    this.#acknowledged = 0;
    this.#pending = kept.map(({ command }, index) => ({ id: index + 1, command, refused: false }));
    this.#next = this.#pending.length + 1;
  }
}
