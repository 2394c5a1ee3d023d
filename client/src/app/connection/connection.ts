import type { ClientMessage, Command, Problem, ServerMessage } from "../../wire/generated";
import { FrameKind } from "../../wire/generated";
import type { Clock } from "../page/clock";
import {
  type AsideHead,
  type Checksum,
  type ClientRecord,
  ConnectionCore,
  type FrameHead,
  type Phase,
  type StopReason,
  type Told,
} from "./connection-core";
import type { PageMessage } from "./page-message";
import type { RowStore } from "./row-store";

/** The part of a WebSocket that is used; tests bring their own. */
export interface Socket {
  binaryType: string;
  onopen: ((event: Event) => void) | null;
  onmessage: ((event: MessageEvent) => void) | null;
  onclose: ((event: CloseEvent) => void) | null;
  send(text: string): void;
  close(): void;
}

/** A frame that is no change of the rows, under its kind. */
export interface AsideFrame {
  readonly kind: number;
  readonly frame: AsideHead;
}

/** The events of a connection. */
export interface ConnectionEvents<Aside> {
  phase(phase: Phase, attempts: number, stopped: StopReason | null, garbled: number, loading: number | null): void;
  commands(sent: number, settled: number): void;
  /** Whether commands have waited for long because the server has no room for them (`LM23`). */
  heldUp(isHeldUp: boolean): void;
  /** The server says what the page has to show. */
  message(message: PageMessage): void;
  /** A branch that is being bent, a prediction, or what others do. */
  aside(aside: Aside): void;
  /** The server cannot open the session, however often one asks; it says why. */
  cannotOpen(sentence: string): void;
  /** The server would not do a command, which is unknown where an earlier page sent it. */
  refused(problem: Problem, command?: Command): void;
  /** Rows have changed; draw. */
  rows(): void;
  /** The client goes on under another key: a stroke in progress is lost. */
  rekeyed(): void;
  /** The server has read the session anew (`RS2`), so that people have other numbers (`PS3`). */
  renumbered(): void;
  /** The server speaks another version of the protocol: load the page again. */
  reload(): void;
}

export interface ConnectionOptions<Frame, Aside> {
  readonly openSocket: () => Socket;
  readonly clock: Clock;
  readonly rows: RowStore<Frame>;
  readonly decode: (
    bytes: ArrayBuffer,
  ) => Promise<{ readonly kind: typeof FrameKind.MeshDelta; readonly frame: Frame } | Aside>;
  readonly newKey: () => string;
  readonly events: ConnectionEvents<Aside>;
  readonly random?: () => number;
  readonly record?: ClientRecord;
}

/** Keeps one session's socket alive and its commands and frames in order. */
export class Connection<Frame extends FrameHead, Aside extends AsideFrame> {
  #options: ConnectionOptions<Frame, Aside>;
  #core: ConnectionCore;
  #socket: Socket | null = null;
  #frames: Promise<void> = Promise.resolve();
  #cancelTimer: (() => void) | null = null;
  #timerAt: number | null = null;
  #closed = false;

  constructor(options: ConnectionOptions<Frame, Aside>) {
    this.#options = options;
    this.#core = new ConnectionCore({
      newKey: options.newKey,
      resume: () => options.rows.held(),
      random: options.random ?? Math.random,
      ...(options.record ? { record: options.record } : {}),
    });
    this.#core.start(this.#now());
    this.#settle();
  }

  /** Sends a command now or when there is a connection again. */
  submit(command: Command): number {
    const id = this.#core.submit(this.#now(), command);
    this.#settle();
    return id;
  }

  /** The key under which commands are sent. */
  get key(): string {
    return this.#core.key;
  }

  /** The number the next command gets: unique for this client, so strokes and gestures are named by it too. */
  get next(): number {
    return this.#core.next;
  }

  /** The highest number the server has answered for. */
  get settled(): number {
    return this.#core.settled;
  }

  /** Whether the server has answered for all that was submitted. */
  get isSettled(): boolean {
    return this.#core.settled >= this.#core.next - 1;
  }

  unsettled(kind: Command["kind"]): number {
    return this.#core.unsettled(kind);
  }

  /** Says something that is no command; false while no session is connected. */
  tell(message: Told): boolean {
    const heard = this.#core.tell(message);
    this.#settle();
    return heard;
  }

  /** Whether others are shown, so that it is to be noticed soon when the server is out of reach. */
  set watchful(watchful: boolean) {
    this.#core.watchful = watchful;
  }

  record(): ClientRecord {
    return this.#core.record();
  }

  /** The page or the network came back. */
  wake(): void {
    this.#core.wake(this.#now());
    this.#settle();
  }

  /** Leaves the session. */
  close(): void {
    this.#closed = true;
    this.#cancelTimer?.();
    this.#drop();
  }

  #now(): number {
    return this.#options.clock.now();
  }

  #open(): void {
    this.#drop();
    const socket = this.#options.openSocket();
    this.#socket = socket;
    socket.binaryType = "arraybuffer";
    const mine = (run: () => void) => {
      if (this.#socket === socket && !this.#closed) {
        run();
        this.#settle();
      }
    };
    socket.onopen = () => mine(() => this.#core.opened(this.#now()));
    socket.onclose = ({ code, reason }) =>
      mine(() => {
        this.#socket = null;
        this.#core.closed(this.#now(), code, reason);
      });
    socket.onmessage = ({ data }) =>
      mine(() => {
        if (typeof data === "string") {
          this.#core.message(this.#now(), JSON.parse(data) as ServerMessage);
        } else if (data instanceof ArrayBuffer) {
          this.#core.heard(this.#now());
          this.#take(socket, data);
        }
      });
  }

  /** Frames are decoded off the main path but applied strictly one after the other. */
  #take(socket: Socket, bytes: ArrayBuffer): void {
    this.#frames = this.#frames.then(async () => {
      const ours = () => this.#socket === socket && !this.#closed;
      if (!ours()) {
        return;
      }
      try {
        const incoming = await this.#options.decode(bytes);
        if (!ours()) {
          return;
        }
        if (!isDelta(incoming)) {
          if (this.#core.took(incoming.kind, incoming.frame)) {
            this.#options.events.aside(incoming);
          }
          this.#settle();
          return;
        }
        const { frame } = incoming;
        if (!this.#core.admits(frame)) {
          throw new Error(`frame ${frame.sequence} is out of order`);
        }
        this.#options.rows.apply(frame);
        this.#core.applied(frame);
        this.#options.events.rows();
      } catch (error) {
        if (ours()) {
          console.warn("A frame could not be taken in; connecting again.", error);
          this.#core.invalid(this.#now());
        }
      }
      this.#settle();
    });
  }

  /** Compares the rows with what they must add up to, once all frames before it are applied. */
  #compare(sum: Checksum): void {
    const socket = this.#socket;
    const ours = () => this.#socket === socket && !this.#closed;
    this.#frames = this.#frames.then(async () => {
      // What adds them up may not be loaded while the network fails; the next answer is compared again.
      const own = ours() ? await this.#options.rows.sum().catch(() => null) : null;
      if (own !== null && ours()) {
        this.#core.compared(this.#now(), sum, own);
        this.#settle();
      }
    });
  }

  #drop(): void {
    const socket = this.#socket;
    this.#socket = null;
    if (socket) {
      socket.onopen = null;
      socket.onmessage = null;
      socket.onclose = null;
      socket.close();
    }
  }

  #settle(): void {
    if (this.#closed) {
      return;
    }
    const { events } = this.#options;
    for (const effect of this.#core.effects()) {
      switch (effect.kind) {
        case "open":
          this.#open();
          break;
        case "close":
          this.#drop();
          break;
        case "send":
          this.#send(effect.message);
          break;
        case "forget-rows":
          this.#options.rows.clear();
          events.rows();
          break;
        case "compare":
          this.#compare(effect.sum);
          break;
        case "reload":
          events.reload();
          break;
        case "rekeyed":
          events.rekeyed();
          break;
        case "renumbered":
          events.renumbered();
          break;
        case "message":
          events.message(effect.message);
          break;
        case "cannot-open":
          events.cannotOpen(effect.sentence);
          break;
        case "refused":
          events.refused(effect.problem, effect.command);
          break;
      }
    }
    const { phase, attempts, stopReason, garbled, loading } = this.#core;
    events.phase(phase, attempts, stopReason, garbled, loading);
    events.commands(this.#core.next - 1, this.#core.settled);
    events.heldUp(this.#core.isHeldUp(this.#now()));
    this.#arm();
  }

  #send(message: ClientMessage): void {
    this.#socket?.send(JSON.stringify(message));
  }

  #arm(): void {
    const { deadline } = this.#core;
    if (deadline === this.#timerAt && this.#cancelTimer) {
      return;
    }
    this.#cancelTimer?.();
    this.#cancelTimer = null;
    this.#timerAt = deadline;
    if (deadline !== null) {
      this.#cancelTimer = this.#options.clock.after(Math.max(0, deadline - this.#now()), () => {
        this.#cancelTimer = null;
        this.#core.tick(this.#now());
        this.#settle();
      });
    }
  }
}

function isDelta<Frame, Aside extends AsideFrame>(
  incoming: { readonly kind: typeof FrameKind.MeshDelta; readonly frame: Frame } | Aside,
): incoming is { readonly kind: typeof FrameKind.MeshDelta; readonly frame: Frame } {
  return incoming.kind === FrameKind.MeshDelta;
}
