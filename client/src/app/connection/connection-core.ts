import {
  type ClientMessage,
  CloseCode,
  type Command,
  PROTOCOL_VERSION,
  type Problem,
  type Resume,
  type ServerMessage,
} from "../../wire/generated";
import { Backlog } from "./backlog";
import { Outbox, type OutboxRecord } from "./outbox";
import type { PageMessage } from "./page-message";
import type { RowSum } from "./row-store";

/** Silence after which the server is asked whether it is there, in milliseconds. */
export const PING_AFTER = 3000;
/** How long a ping may stay unanswered before the socket counts as dead. */
export const PONG_WITHIN = 5000;
/** Both, while others are shown: what is shown of them must be true (`PS3`). */
export const WATCHFUL = 2000;
/** Rows that frames have changed are compared with the server's so often, when it is quiet (`CK1`). */
export const CHECK_EVERY = 60_000;
/** Commands that have been held back for so long are spoken of (`LM23`). */
export const HELD_LONG = 3000;
/** How long a socket may take to open and greet. */
export const OPEN_WITHIN = 8000;
const BACKOFF_FIRST = 250;
const BACKOFF_LAST = 8000;
/** The longest wait after frames that could not be read: each attempt brings the whole tree. */
const BACKOFF_GARBLED = 60_000;
/** A connection that has lasted so long is as good as any, whatever came before it. */
const GARBLED_FOR = 120_000;

export type Phase = "idle" | "opening" | "greeting" | "connected" | "waiting" | "stopped";
export type StopReason = "unknown-session" | "cannot-open" | "version";

/** What outlives a page: the key, and what was sent under it. */
export interface ClientRecord extends OutboxRecord {
  readonly key: string;
}

/** What the shell must do, in order. */
export type Effect =
  | { readonly kind: "open" }
  | { readonly kind: "close" }
  | { readonly kind: "send"; readonly message: ClientMessage }
  | { readonly kind: "forget-rows" }
  | { readonly kind: "compare"; readonly sum: Checksum }
  | { readonly kind: "reload" }
  | { readonly kind: "rekeyed" }
  | { readonly kind: "renumbered" }
  | { readonly kind: "message"; readonly message: PageMessage }
  | { readonly kind: "cannot-open"; readonly sentence: string }
  | { readonly kind: "refused"; readonly problem: Problem; readonly command?: Command };

/** What a page says that is no command: it is not numbered, and not said again. */
export type Told = Extract<
  ClientMessage,
  { type: "predict" | "look_at_branch" | "look_at_limb" | "here" | "follow" | "gather" | "ping" }
>;

/** What rows must add up to (`CK1`). */
export type Checksum = Extract<ServerMessage, { type: "checksum" }>;

export interface CoreOptions {
  /** Draws a new client key. */
  readonly newKey: () => string;
  /** What is still held of the session (`RS1`). */
  readonly resume: () => Resume | undefined;
  /** A number in [0, 1) for the backoff's jitter. */
  readonly random: () => number;
  /** What an earlier page of this tab left behind. */
  readonly record?: ClientRecord;
}

/** The facts of a frame that order it. */
export interface FrameHead {
  readonly epoch: number;
  readonly sequence: number;
  readonly catchUp: boolean;
}

/** What is no change of the rows but something beside them, of which only the newest counts: a pose or a ghost. */
export interface AsideHead {
  readonly epoch: number;
  readonly sequence: number;
}

/** One client's side of the protocol, without socket or clock: call a method, then drain `effects()`. */
export class ConnectionCore {
  #options: CoreOptions;
  #key: string;
  #outbox: Outbox;
  #backlog = new Backlog();
  /** Whether a stop is to go before what is held back. */
  #stopsFirst = false;
  #phase: Phase = "idle";
  #stopReason: StopReason | null = null;
  #attempts = 0;
  #loading: number | null = null;
  #deadline: number | null = null;
  #pinged: number | null = null;
  #nonce = 0;
  #epoch: number | null = null;
  #sequence: number | null = null;
  #resumable = true;
  /** How many frames could not be read, each soon after the one before; and when the last of them came. */
  #garbled = 0;
  #garbledAt = 0;
  /** Whether frames came since rows were compared, and when that was. */
  #unchecked = false;
  #checkedAt = 0;
  #effects: Effect[] = [];
  /** Whether others are shown. */
  watchful = false;

  constructor(options: CoreOptions) {
    this.#options = options;
    this.#key = options.record?.key ?? options.newKey();
    this.#outbox = new Outbox(options.record);
  }

  get phase(): Phase {
    return this.#phase;
  }

  get stopReason(): StopReason | null {
    return this.#stopReason;
  }

  /** Failed attempts since the last welcome. */
  get attempts(): number {
    return this.#attempts;
  }

  /** How much of the session the server has loaded, from 0 to 1, while it loads it (`HS8`). */
  get loading(): number | null {
    return this.#phase === "greeting" ? this.#loading : null;
  }

  /** How many times in a row the connection was closed because a frame could not be read. */
  get garbled(): number {
    return this.#garbled;
  }

  /** Whether commands have been held back for long. */
  isHeldUp(now: number): boolean {
    const { since } = this.#backlog;
    return since !== null && now - since >= HELD_LONG;
  }

  /** When `tick` is next due, in the clock of the calls. */
  get deadline(): number | null {
    const { again } = this.#backlog;
    return again === null || this.#deadline === null ? this.#deadline : Math.min(again, this.#deadline);
  }

  /** The key under which commands are sent (`HS1`). */
  get key(): string {
    return this.#key;
  }

  /** The number the next command gets. */
  get next(): number {
    return this.#outbox.next;
  }

  /** The highest number up to which every command is durable or refused. */
  get settled(): number {
    return this.#outbox.settled;
  }

  /** How many commands of a kind the server has neither acknowledged nor refused. */
  unsettled(kind: Command["kind"]): number {
    return this.#outbox.unsettled(kind);
  }

  /** What a later page of this tab needs to go on. */
  record(): ClientRecord {
    return { key: this.#key, ...this.#outbox.record() };
  }

  /** Takes the effects that have come up since the last call. */
  effects(): Effect[] {
    return this.#effects.splice(0);
  }

  start(now: number): void {
    if (this.#phase === "idle") {
      this.#open(now);
    }
  }

  /** Numbers a command and sends it as soon as there is a server to take it (`CM1`). */
  submit(now: number, command: Command): number {
    const id = this.#outbox.put(command);
    if (this.#phase !== "connected") {
      return id;
    }
    if (!this.#backlog.holds) {
      this.#sendNumbered(id, command);
    } else if (command.kind === "stop") {
      this.#stopsFirst = true;
      this.#backlog.hurry(now);
      this.#sendHeld(now);
    }
    return id;
  }

  /** The socket is open: say hello (`HS1`). */
  opened(now: number): void {
    if (this.#phase !== "opening") {
      return;
    }
    this.#phase = "greeting";
    this.#loading = null;
    this.#deadline = now + OPEN_WITHIN;
    const resume = this.#resumable ? this.#options.resume() : undefined;
    const hello = { type: "hello", protocol: PROTOCOL_VERSION, client: this.#key } as const;
    this.#send(resume ? { ...hello, resume } : hello);
  }

  /** A control message arrived. */
  message(now: number, message: ServerMessage): void {
    this.#heard(now);
    switch (message.type) {
      case "welcome":
        this.#welcome(now, message);
        break;
      case "loading":
        this.#load(now, message.share);
        break;
      case "acknowledged":
        this.#outbox.acknowledge(message.id);
        this.#answered(now);
        break;
      case "refused":
        this.#refuse(now, message.id, message.problem);
        break;
      case "done":
        this.#effects.push({ kind: "message", message: { ...message, id: this.#outbox.idThrough(message.id) } });
        break;
      case "checksum":
        this.#effects.push({ kind: "compare", sum: message });
        break;
      default:
        this.#effects.push({ kind: "message", message });
    }
  }

  /** Bytes arrived; they show that the server lives, before they are decoded. */
  heard(now: number): void {
    this.#heard(now);
  }

  /** Whether a decoded frame may be applied: right epoch, right place in the order (`FR4`). */
  admits(frame: FrameHead): boolean {
    if (this.#phase !== "connected" || frame.epoch !== this.#epoch) {
      return false;
    }
    return frame.catchUp || this.#sequence === null || frame.sequence === this.#sequence + 1;
  }

  /** A frame has been applied: say so (`FL1`). */
  applied(frame: FrameHead): void {
    this.#sequence = frame.sequence;
    this.#resumable = true;
    this.#unchecked = true;
    this.#send({ type: "received", sequence: frame.sequence });
  }

  /** What the rows add up to: where that differs from what the server says of the same frame, they are loaded anew. */
  compared(now: number, sum: Checksum, own: RowSum): void {
    if (sum.sequence === this.#sequence && (sum.rows !== own.rows || sum.crc32 !== own.crc32)) {
      this.invalid(now);
    }
  }

  /** Takes a frame that does not change rows; false if it belongs to another epoch and does not count. */
  took(kind: number, { epoch, sequence }: AsideHead): boolean {
    if (this.#phase !== "connected") {
      return false;
    }
    this.#send({ type: "received", sequence, kind });
    return epoch === this.#epoch;
  }

  /** Tells or asks the server something that is no command; false if there is none to hear it. */
  tell(message: Told): boolean {
    if (this.#phase !== "connected") {
      return false;
    }
    this.#send(message);
    return true;
  }

  /** A frame was invalid or out of order: connect again and forget what is held (`FR1`). */
  invalid(now: number): void {
    if (this.#phase === "connected") {
      this.#resumable = false;
      this.#effects.push({ kind: "close" });
      // A welcome does not make it good: what comes after it may be as wrong as before.
      this.#garbled = now - this.#garbledAt > GARBLED_FOR ? 1 : this.#garbled + 1;
      this.#garbledAt = now;
      this.#retry(now, BACKOFF_FIRST * 2 ** (2 * Math.min(this.#garbled - 1, 10)), BACKOFF_GARBLED);
    }
  }

  /** The socket closed, by whichever side; a server says why in a sentence. */
  closed(now: number, code: number, sentence = ""): void {
    if (this.#phase === "stopped" || this.#phase === "waiting" || this.#phase === "idle") {
      return;
    }
    switch (code) {
      case CloseCode.UnknownSession:
        this.#stop("unknown-session");
        break;
      case CloseCode.CannotOpen:
      case CloseCode.Removed:
        this.#stop("cannot-open");
        this.#effects.push({ kind: "cannot-open", sentence });
        break;
      case CloseCode.VersionMismatch:
        this.#stop("version");
        this.#effects.push({ kind: "reload" });
        break;
      case CloseCode.Replaced:
        // Another page holds our key (a duplicated tab): this one goes on under a key of its own.
        this.#rekey();
        this.#retry(now);
        break;
      default:
        this.#retry(now);
    }
  }

  /** The network or the page came back: do not wait out the backoff. */
  wake(now: number): void {
    if (this.#phase === "waiting") {
      this.#open(now);
    } else if (this.#phase === "connected" && this.#pinged === null) {
      this.#ping(now);
    }
  }

  /** Time has passed; call when `deadline` is reached, or later. */
  tick(now: number): void {
    this.#sendHeld(now);
    if (this.#deadline === null || now < this.#deadline) {
      return;
    }
    if (this.#phase === "waiting") {
      this.#open(now);
    } else if (this.#phase === "connected" && this.#pinged === null) {
      this.#ping(now);
    } else if (this.#phase === "connected" || this.#phase === "opening" || this.#phase === "greeting") {
      this.#effects.push({ kind: "close" });
      this.#retry(now);
    }
  }

  #open(now: number): void {
    this.#phase = "opening";
    this.#deadline = now + OPEN_WITHIN;
    this.#effects.push({ kind: "open" });
  }

  #retry(now: number, wait = BACKOFF_FIRST * 2 ** Math.min(this.#attempts, 10), longest = BACKOFF_LAST): void {
    const delay = Math.min(longest, wait);
    this.#attempts += 1;
    this.#phase = "waiting";
    this.#holdNothing();
    this.#pinged = null;
    // Half of the delay is chance, so that a room full of tablets does not return in one instant.
    this.#deadline = now + delay * (0.5 + 0.5 * this.#options.random());
  }

  #stop(reason: StopReason): void {
    this.#phase = "stopped";
    this.#holdNothing();
    this.#stopReason = reason;
    this.#deadline = null;
  }

  #heard(now: number): void {
    if (this.#phase === "connected") {
      this.#pinged = null;
      this.#deadline = now + (this.watchful ? WATCHFUL : PING_AFTER);
    }
  }

  #ping(now: number): void {
    this.#pinged = now;
    this.#deadline = now + (this.watchful ? WATCHFUL : PONG_WITHIN);
    this.#nonce += 1;
    this.#send({ type: "ping", nonce: this.#nonce });
    if (this.#unchecked && now - this.#checkedAt >= CHECK_EVERY) {
      this.#check(now);
    }
  }

  #check(now: number): void {
    this.#unchecked = false;
    this.#checkedAt = now;
    this.#send({ type: "check" });
  }

  /** The server is at it: it may take as long as it takes. */
  #load(now: number, share: number): void {
    if (this.#phase === "greeting") {
      this.#loading = share;
      this.#deadline = now + OPEN_WITHIN;
    }
  }

  #welcome(now: number, welcome: Extract<ServerMessage, { type: "welcome" }>): void {
    if (this.#phase !== "greeting") {
      return;
    }
    if (welcome.protocol !== PROTOCOL_VERSION) {
      this.#stop("version");
      this.#effects.push({ kind: "close" }, { kind: "reload" });
      return;
    }
    if (!this.#outbox.follows(welcome.acknowledged)) {
      // The server knows less of this key than it once acknowledged; a gap would be refused for ever.
      this.#rekey();
      this.#effects.push({ kind: "close" });
      this.#retry(now);
      return;
    }
    this.#phase = "connected";
    this.#attempts = 0;
    if (this.#epoch !== null && this.#epoch !== welcome.epoch) {
      this.#effects.push({ kind: "renumbered" });
    }
    this.#epoch = welcome.epoch;
    this.#sequence = null;
    this.#heard(now);
    if (!welcome.resumed) {
      this.#effects.push({ kind: "forget-rows" });
    }
    this.#outbox.acknowledge(welcome.acknowledged);
    const messages: readonly PageMessage[] = [
      { type: "parameters", parameters: welcome.parameters },
      { type: "state", state: welcome.state },
      // These follow only if there is something to tell.
      { type: "programme", programme: null, by_hand: [] },
      { type: "obstacles", obstacles: [] },
      { type: "widths", widths: [] },
    ];
    this.#effects.push(...messages.map((message) => ({ kind: "message", message }) as const));
    for (const { id, command } of this.#outbox.pending) {
      this.#sendNumbered(id, command);
    }
    if (welcome.resumed) {
      // What is held is older than this connection.
      this.#check(now);
    }
  }

  #refuse(now: number, id: number, problem: Problem): void {
    const held = this.#backlog.holds;
    if (this.#backlog.refused(now, id, problem.reason)) {
      // One that was on its way is not to wait for what it would end.
      this.#stopsFirst ||= !held && this.#outbox.pending.some((one) => one.id >= id && one.command.kind === "stop");
      return;
    }
    const command = this.#outbox.commandOf(id);
    if (this.#outbox.refuse(id)) {
      this.#effects.push(command ? { kind: "refused", problem, command } : { kind: "refused", problem });
    }
    this.#answered(now);
  }

  #answered(now: number): void {
    this.#backlog.answered(now, this.#outbox.answered, this.#outbox.next - 1);
    this.#sendHeld(now);
  }

  /** Sends what was held back, as far as it is time for it. */
  #sendHeld(now: number): void {
    const run = this.#backlog.due(now, this.#outbox.next - 1);
    if (run === null) {
      return;
    }
    if (this.#stopsFirst) {
      // It also stays in its place, for what goes out before it grows as well.
      this.#stopsFirst = false;
      this.#outbox.overtake(run.from, { kind: "stop" });
    }
    for (const { id, command } of this.#outbox.pending) {
      if (id >= run.from && id <= run.to) {
        this.#sendNumbered(id, command);
      }
    }
  }

  #holdNothing(): void {
    this.#backlog.forget();
    this.#stopsFirst = false;
  }

  #sendNumbered(id: number, command: Command): void {
    this.#backlog.sent(id);
    this.#send({ type: "command", id, command });
  }

  /** Goes on under a new key. */
  #rekey(): void {
    this.#key = this.#options.newKey();
    this.#outbox.startAnew();
    this.#effects.push({ kind: "rekeyed" });
  }

  #send(message: ClientMessage): void {
    this.#effects.push({ kind: "send", message });
  }
}
