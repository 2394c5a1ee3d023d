import { type ReadonlySignal, signal } from "@preact/signals";
import type { Clock } from "../page/clock";

/** How often the value of a moving control is sent, in milliseconds. */
const SEND_EVERY = 100;
/** Commands that may be unanswered before a moving control has to wait. */
const MAX_UNSETTLED = 2;
/** How long the user's own value stands after the server has come to its command and still has another value. */
const GRACE = 600;
/** How often a command that waits behind growth is checked, in milliseconds. */
const LOOK_EVERY = 100;

/** How far the server has come with growing, and how many steps it has still to do at most. */
export interface GrowthAhead {
  readonly step: number;
  readonly pending: number;
}

export interface DraftOptions<Whole extends object, None extends Whole | null> {
  /** What is shown before the server has said anything. */
  readonly none: None;
  /** Sends a change and gives the number of the command; 0 where no session is open. */
  readonly submit: (patch: Partial<Whole>, gesture: number | undefined) => number;
  /** A number that no other gesture of this client has. */
  readonly newGesture: () => number;
  /** What the server has still to grow, for what it has taken on is done only after that. */
  readonly ahead: () => GrowthAhead;
  readonly clock: Clock;
}

/** A value that the user has set, and the last command that carries it; 0 while it has not been sent. */
interface Own<Value> {
  readonly value: Value;
  readonly command: number;
  /** The steps within which its turn comes, as was known at its answer; growth asked for later is none of them. */
  turn: { readonly from: number; readonly to: number } | null;
  /** When the server's value counts again, whatever else happens; null before its turn has come. */
  deadline: number | null;
}

/**
 * Something shared that is set field by field: at once here, a little later for everybody. A field has the value that
 * the user set until the server has answered; from then on the value of the server counts, whoever set it.
 */
export class Draft<Whole extends object, None extends Whole | null = Whole> {
  readonly value: ReadonlySignal<Whole | None>;
  #value;
  #options: DraftOptions<Whole, None>;
  #received: Whole | None;
  #own = new Map<keyof Whole, Own<Whole[keyof Whole]>>();
  #queued: Partial<Whole> | null = null;
  /** That of the drag in progress, once something of it was sent. */
  #gesture: number | undefined;
  #sentAt = Number.NEGATIVE_INFINITY;
  #settled = 0;
  /** The commands that are not yet answered. */
  #underWay: number[] = [];
  #cancelSending: (() => void) | null = null;
  #cancelGrace: (() => void) | null = null;

  constructor(options: DraftOptions<Whole, None>) {
    this.#options = options;
    this.#received = options.none;
    this.#value = signal<Whole | None>(options.none);
    this.value = this.#value;
  }

  /** A control moves: shown at once, sent when it is time, and all of one drag is one operation for undo. */
  drag(patch: Partial<Whole>): void {
    this.#take(patch);
    this.#flush();
  }

  /** A control is let go, or something is picked: sent at once. With a gesture it joins what else has that gesture. */
  commit(patch: Partial<Whole> = {}, gesture?: number): void {
    // A drag that ends before anything of it was sent needs no gesture: it is sent as one command.
    this.#take(patch);
    this.#send(gesture ?? this.#gesture);
    this.#gesture = undefined;
  }

  /** The server has sent the present value. */
  receive(received: Whole): void {
    this.#received = received;
    this.#reconcile();
  }

  /** The server has answered all commands up to this one. */
  settle(settled: number): void {
    this.#settled = settled;
    this.#underWay = this.#underWay.filter((command) => command > settled);
    if (this.#own.size > 0) {
      this.#reconcile();
      this.#flush();
    }
  }

  /** Another session: nothing is known of it. */
  clear(): void {
    this.#received = this.#options.none;
    this.letGo();
  }

  /** Drops the user's own values: the commands that carried them have other numbers now. */
  letGo(): void {
    this.#cancelSending?.();
    this.#cancelGrace?.();
    this.#cancelSending = null;
    this.#cancelGrace = null;
    this.#own.clear();
    this.#queued = null;
    this.#gesture = undefined;
    this.#settled = 0;
    this.#underWay = [];
    this.#show();
  }

  #take(patch: Partial<Whole>): void {
    if (namesOf(patch).length === 0) {
      return;
    }
    for (const name of namesOf(patch)) {
      this.#own.set(name, { value: patch[name] as Whole[keyof Whole], command: 0, turn: null, deadline: null });
    }
    this.#queued = { ...this.#queued, ...patch };
    this.#show();
  }

  /** Sends what a moving control has set, now or when it is time. */
  #flush(): void {
    if (this.#queued === null || this.#cancelSending !== null) {
      return;
    }
    const wait = this.#sentAt + SEND_EVERY - this.#options.clock.now();
    if (wait > 0) {
      this.#cancelSending = this.#options.clock.after(wait, () => {
        this.#cancelSending = null;
        this.#flush();
      });
    } else if (this.#underWay.length < MAX_UNSETTLED) {
      this.#gesture ??= this.#options.newGesture();
      this.#send(this.#gesture);
    }
  }

  #send(gesture: number | undefined): void {
    this.#cancelSending?.();
    this.#cancelSending = null;
    const patch = this.#queued;
    if (patch === null) {
      return;
    }
    this.#queued = null;
    this.#sentAt = this.#options.clock.now();
    const command = this.#options.submit(patch, gesture);
    for (const name of namesOf(patch)) {
      const own = this.#own.get(name);
      if (own) {
        this.#own.set(name, { ...own, command });
      }
    }
    if (command > this.#settled) {
      this.#underWay.push(command);
    } else {
      // No session was open: after a while the old value returns.
      this.#reconcile();
    }
  }

  /** Drops the user's own values that the server has taken over, or has had time to. */
  #reconcile(): void {
    const now = this.#options.clock.now();
    let next = Number.POSITIVE_INFINITY;
    for (const [name, own] of this.#own) {
      if (!this.#answered(name, own.command)) {
        continue;
      }
      if (this.#received !== null && alike((this.#received as Whole)[name], own.value)) {
        this.#own.delete(name);
      } else if (this.#waits(own)) {
        next = Math.min(next, now + LOOK_EVERY);
      } else {
        // It is set once: messages that come meanwhile must not prolong a value that the server does not have.
        own.deadline ??= now + GRACE;
        if (own.deadline <= now) {
          this.#own.delete(name);
        } else {
          next = Math.min(next, own.deadline);
        }
      }
    }
    this.#cancelGrace?.();
    this.#cancelGrace = Number.isFinite(next) ? this.#options.clock.after(next - now, () => this.#reconcile()) : null;
    this.#show();
  }

  /** Whether growth that was asked for before it is still to be done. */
  #waits(own: Own<unknown>): boolean {
    if (own.deadline !== null) {
      return false;
    }
    const { step, pending } = this.#options.ahead();
    own.turn ??= { from: step, to: step + pending };
    return pending > 0 && step >= own.turn.from && step < own.turn.to;
  }

  #answered(name: keyof Whole, command: number): boolean {
    return command <= this.#settled && !(this.#queued !== null && name in this.#queued);
  }

  #show(): void {
    const received = this.#received;
    if (received === null || this.#own.size === 0) {
      this.#value.value = received;
      return;
    }
    const shown: Whole = { ...(received as Whole) };
    for (const [name, { value }] of this.#own) {
      shown[name] = value;
    }
    this.#value.value = shown;
  }
}

function namesOf<Whole extends object>(patch: Partial<Whole>): (keyof Whole)[] {
  return Object.keys(patch) as (keyof Whole)[];
}

/** Whether two values are the same but for what 32-bit floats lose on the way. */
export function alike(a: unknown, b: unknown): boolean {
  if (typeof a === "number" && typeof b === "number") {
    return Math.abs(a - b) <= 1e-5 * Math.max(1, Math.abs(a));
  }
  if (typeof a === "object" && typeof b === "object" && a !== null && b !== null) {
    const [ofA, ofB] = [new Map<string, unknown>(Object.entries(a)), new Map<string, unknown>(Object.entries(b))];
    return ofA.size === ofB.size && [...ofA].every(([name, value]) => ofB.has(name) && alike(value, ofB.get(name)));
  }
  return a === b;
}
