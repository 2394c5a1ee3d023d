import type { Command } from "../../wire/generated";

/** A command that is not yet known to be durable. */
interface PendingCommand {
  /** What the page calls it; the server's number for it is another one while something has overtaken it. */
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
  /** In the order of their numbers, the last of which is the one before `#next`. */
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

  /** The highest id up to which every command is durable or refused. */
  get settled(): number {
    return (
      lowestId(
        this.#pending.filter(({ refused }) => !refused),
        this.#next,
      ) - 1
    );
  }

  /** The highest number up to which every command is durable or refused. */
  get answered(): number {
    const open = this.#pending.findIndex((entry) => !entry.refused);
    return (open === -1 ? this.#next : this.#first + open) - 1;
  }

  /** The highest id up to which every command has a number that is no higher. */
  idThrough(number: number): number {
    return lowestId(this.#pending.slice(Math.max(0, number + 1 - this.#first)), number + 1) - 1;
  }

  /** How many commands of a kind the server has neither acknowledged nor refused. */
  unsettled(kind: Command["kind"]): number {
    return this.#pending.reduce((count, entry) => count + (entry.command.kind === kind && !entry.refused ? 1 : 0), 0);
  }

  /** What the server may not have yet, by its numbers: all of it goes out again after a welcome. */
  get pending(): readonly { readonly id: number; readonly command: Command }[] {
    return this.#pending.map(({ command }, index) => ({ id: this.#first + index, command }));
  }

  /** What a later page needs to go on. */
  record(): OutboxRecord {
    return { next: this.#next, acknowledged: this.#acknowledged, pending: this.pending };
  }

  /** Numbers a command and keeps it. */
  put(command: Command): number {
    const id = this.#next++;
    this.#pending.push({ id, command, refused: false });
    return id;
  }

  /** Has a command go before all from a number on, which the server has not taken; those get the next numbers. */
  overtake(number: number, command: Command): void {
    const index = number - this.#first;
    this.#pending.splice(index, 0, { id: this.#next++, command, refused: false });
  }

  /** Whether the kept commands continue those that the server has: it would refuse a gap every time (`CM1`). */
  follows(acknowledged: number): boolean {
    return acknowledged + 1 >= this.#first;
  }

  /** The server is known to have everything up to a number, perhaps more than this page knew. */
  acknowledge(id: number): void {
    this.#acknowledged = Math.max(this.#acknowledged, id);
    this.#pending.splice(0, Math.max(0, id + 1 - this.#first));
    this.#next = Math.max(this.#next, id + 1);
  }

  /** The command that has a number, while it is kept. */
  commandOf(id: number): Command | undefined {
    return this.#entry(id)?.command;
  }

  /** The server has said no to a number; false if it had said so before. */
  refuse(id: number): boolean {
    const entry = this.#entry(id);
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

  /** The number of the first that is kept. */
  get #first(): number {
    return this.#next - this.#pending.length;
  }

  #entry(number: number): PendingCommand | undefined {
    return this.#pending[number - this.#first];
  }
}

function lowestId(entries: readonly PendingCommand[], otherwise: number): number {
  return entries.reduce((lowest, { id }) => Math.min(lowest, id), otherwise);
}
