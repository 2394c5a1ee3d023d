import { batch, type Signal, signal } from "@preact/signals";
import type { Frame } from "../../wire/frame";
import type { Command, NewSession, Resume, SessionCreated } from "../../wire/generated";
import type { AsideServerFrame } from "../../wire/server-frame";
import { decodeServerFrame } from "../../wire/server-frame";
import { askToEnter } from "../entry/ask-to-enter";
import type { Clock } from "../page/clock";
import type { Hindrance } from "../page/hindrance";
import type { PageEvents } from "../page/page-life";
import { explained } from "../problems/explained";
import { RequestFailed, turnedAway } from "../requests/request";
import { leaveRecord, newClientKey, takeRecord } from "./client-record";
import { Connection, type ConnectionEvents, type Socket } from "./connection";
import type { ClientRecord, Phase, StopReason, Told } from "./connection-core";
import { PartedSessions } from "./parted-sessions";
import { mayReload } from "./reload-guard";
import type { RowStore } from "./row-store";
import { Seat } from "./seat";
import { pathOf, sessionInPath } from "./session-address";
import { createSession, findSession, socketAddress } from "./session-api";

const RETRY_START = 2000;
/** So many attempts at a first connection are quietly made. */
const SILENT_AFTER = 2;

/** How a session is opened. */
export interface Opening {
  /** Whether it is a copy in which it is played (`RP1`). */
  readonly isReplay: boolean;
  /** Whether the page was in this very session before. */
  readonly isSame: boolean;
}

/** The events of a session: those of its connection and its own. */
export interface SessionEvents
  extends Omit<ConnectionEvents<AsideServerFrame>, "phase" | "commands" | "heldUp" | "reload" | "rows" | "cannotOpen"> {
  /** Another session is opened, or this one again, to play it or after that: nothing of the one before counts any more. */
  opened(how: Opening): void;
  rows(): void;
  /** All commands up to a number are answered. */
  settled(settled: number): void;
  /** The server is out of reach for a while. */
  lost(): void;
  /** The session or the page is left: what is in progress ends now. */
  leaving(): void;
  /** A session was left that will only later have all that was done in it. */
  parted(): void;
  /** Another session could not be had. */
  failed(error: unknown): void;
  /** Whoever is here may begin no tree, and chooses one. */
  choosing(): void;
}

/** The part of the browser's page that is used; tests bring their own. */
export interface Page {
  readonly location: Pick<Location, "pathname" | "protocol" | "host" | "reload" | "replace">;
  readonly history: Pick<History, "pushState" | "replaceState">;
  /** What lives as long as the tab. */
  readonly store: Storage;
  readonly clock: Clock;
  openSocket(address: string): Socket;
}

export interface SessionLinkOptions {
  readonly page: Page;
  readonly rows: RowStore<Frame>;
  readonly hindrance: Signal<Hindrance | null>;
  /** Whether no picture can be drawn here, whatever the session. */
  readonly dark: () => boolean;
  /** The session to come back to. */
  readonly lastSession: Signal<string | null>;
  /** Whether whoever is here may begin trees, and the only one that they may see; fails where the server does not say. */
  readonly rights: () => Promise<{ readonly mayBegin: boolean; readonly onlyTree: string | null }>;
  /** Whether there is something on the page already. */
  readonly begun: () => boolean;
  readonly events: SessionEvents;
}

/** The session a page is in: found or begun, left for another, and kept through lost networks and closed pages. */
export class SessionLink implements PageEvents {
  readonly session = signal<string | null>(null);
  /** Why the server cannot open the session, if it cannot. */
  readonly refusal = signal("");
  /** Whether that is because the server did not outlive it, so that an owner may have it tried again (`OP5`). */
  readonly waits = signal(false);
  readonly phase = signal<Phase>("idle");
  readonly attempts = signal(0);
  /** How often of late what the server sent could not be read. */
  readonly garbled = signal(0);
  /** How much of the session the server has loaded, from 0 to 1, while it loads it. */
  readonly loading = signal<number | null>(null);
  readonly sent = signal(0);
  readonly settled = signal(0);
  /** Whether what was done has waited for long because the server has no room for it (`LM23`). */
  readonly heldUp = signal(false);
  /** Whether the page is in a copy of the session, to play it from its beginning. */
  readonly replaying = signal(false);
  /** Whether the session is told what this page says of itself; while it is replayed, that goes there by a way of its own. */
  readonly present = signal(false);
  #options: SessionLinkOptions;
  #connection: Connection<Frame, AsideServerFrame> | null = null;
  /** The page's place in the session while it plays a copy of it. */
  #seat: Seat | null = null;
  #parted = new PartedSessions();
  /** Whether another session is on its way. */
  #changing = false;

  constructor(options: SessionLinkOptions) {
    this.#options = options;
  }

  /** Opens what the address names, or the only tree there is, or the session of last time, or a new one. */
  async start(): Promise<void> {
    const { page, hindrance, rights } = this.#options;
    const named = sessionInPath(page.location.pathname);
    if (named !== null) {
      this.#open(named);
      return;
    }
    try {
      // Nothing is asked for that they may not have.
      const { mayBegin, onlyTree } = await rights();
      await (onlyTree === null ? this.#come(mayBegin) : this.#comeTo(onlyTree));
    } catch (error) {
      if (this.session.peek() !== null) {
        return;
      }
      if (error instanceof RequestFailed && askToEnter(error.problem, page.location)) {
        return;
      }
      hindrance.value = "no-server";
      page.clock.after(RETRY_START, () => {
        if (this.session.peek() === null) {
          void this.start();
        }
      });
    }
  }

  /** Leaves this session for a new one, empty or from a saved tree; null if there is none to be had now. */
  async change(request: NewSession = {}): Promise<SessionCreated | null> {
    // Two taps begin one session.
    if (this.#changing) {
      return null;
    }
    this.#changing = true;
    try {
      const created = await createSession(request);
      this.#options.page.history.pushState(null, "", pathOf(created.session));
      this.#open(created.session);
      return created;
    } catch (error) {
      this.#options.events.failed(error);
      return null;
    } finally {
      this.#changing = false;
    }
  }

  /** Plays the design of this session in a copy that nobody else sees, or comes back from there. */
  replay(isOn: boolean): void {
    const session = this.session.peek();
    if (session !== null && this.replaying.peek() !== isOn) {
      this.#open(session, isOn);
    }
  }

  /** Goes back to a session that was left, if the server still has it. */
  async reopen(session: string): Promise<"opened" | "gone" | "failed"> {
    try {
      if ((await findSession(session)) === null) {
        return "gone";
      }
    } catch (error) {
      this.#options.events.failed(error);
      return "failed";
    }
    this.#options.page.history.pushState(null, "", pathOf(session));
    this.#open(session);
    return "opened";
  }

  /** Comes into the session of last time, a new one, or where trees are chosen. */
  async #come(mayBegin: boolean): Promise<void> {
    const { lastSession, hindrance, events } = this.#options;
    const last = lastSession.peek();
    const found = last === null ? null : await findSession(last);
    if (found !== null || mayBegin) {
      this.#enter(found ?? (await createSession()));
    } else if (this.session.peek() === null) {
      hindrance.value = "only-look";
      events.choosing();
    }
  }

  /** Comes in where a guest may. */
  async #comeTo(tree: string): Promise<void> {
    try {
      this.#enter(await createSession({ tree }));
    } catch (error) {
      if (!(error instanceof RequestFailed) || error.status === 0) {
        throw error;
      }
      const refusal = await explained(error);
      if (this.session.peek() === null) {
        this.refusal.value = refusal;
        this.#options.hindrance.value = "cannot-open";
      }
    }
  }

  /** Opens what was asked for, unless another session was opened meanwhile. */
  #enter({ session }: SessionCreated): void {
    if (this.session.peek() === null) {
      this.#options.page.history.replaceState(null, "", pathOf(session));
      this.#open(session);
    }
  }

  get connected(): boolean {
    return this.phase.peek() === "connected";
  }

  /** Whether a session is open, connected or not. */
  get open(): boolean {
    return this.#connection !== null;
  }

  /** The key of this page in the session that is open; null while none is. */
  get key(): string | null {
    return this.#connection?.key ?? null;
  }

  /** Sends a command and gives its number; 0 while no session is open. */
  submit(command: Command): number {
    return this.#connection?.submit(command) ?? 0;
  }

  /** The number the next command gets, which no other operation of this client has. */
  get next(): number {
    return this.#connection?.next ?? 1;
  }

  /** How many commands of a kind are not answered. */
  unsettled(kind: Command["kind"]): number {
    return this.#connection?.unsettled(kind) ?? 0;
  }

  /** Says something that is no command; false while no session is connected. */
  tell(message: Told): boolean {
    // A replay is nobody else's: who is there, is there in the session.
    const place = message.type === "here" ? (this.#seat ?? this.#connection) : this.#connection;
    return place?.tell(message) ?? false;
  }

  /** Whether others are shown (`PS3`). */
  set watchful(watchful: boolean) {
    const place = this.#seat ?? this.#connection;
    if (place) {
      place.watchful = watchful;
    }
  }

  /** Ends what is in progress and lets the session go. */
  leave(): void {
    this.#options.events.leaving();
    this.#part();
    this.#close();
  }

  /** The page may never come back: the next page of this tab continues with what is unsent. */
  leaving(): void {
    const { events, page } = this.#options;
    events.leaving();
    const [session, own] = [this.session.peek(), this.#seat ?? this.#connection];
    if (session !== null && own) {
      leaveRecord(page.store, session, own.record());
    }
    this.#parted.leave(page.store);
  }

  returning(): void {
    const { store } = this.#options.page;
    // This page still lives and has all of it; the copy was for a page after it.
    takeRecord(store, this.session.peek() ?? "");
    this.#parted.come(store);
    this.online();
  }

  online(): void {
    this.#connection?.wake();
    this.#seat?.wake();
  }

  navigated(): void {
    const session = sessionInPath(this.#options.page.location.pathname);
    if (session !== null && session !== this.session.peek()) {
      this.#open(session);
    }
  }

  #open(session: string, isReplay = false): void {
    const { page, rows, hindrance, dark, lastSession, events } = this.#options;
    const isSame = this.session.peek() === session;
    const held = isReplay ? rows.held() : undefined;
    events.leaving();
    // Who plays the session they are in stays the device that they are.
    const stays = isSame && (isReplay || this.#seat !== null);
    const kept = stays ? (this.#seat ?? this.#connection)?.record() : undefined;
    if (kept === undefined) {
      this.#part();
    }
    this.#close();
    batch(() => {
      this.replaying.value = isReplay;
      this.present.value = false;
      this.session.value = session;
      lastSession.value = session;
      // Another session does not make a browser draw that cannot.
      hindrance.value = dark() ? "no-webgl" : null;
      events.opened({ isReplay, isSame });
    });
    this.#parted.come(page.store);
    // What was done in the session itself goes there, and nowhere else.
    const record = isReplay ? null : (takeRecord(page.store, session) ?? kept ?? this.#parted.take(session));
    if (isReplay && kept) {
      this.#seat = this.#seatIn(session, kept, held);
    }
    const address = socketAddress(session, page.location, isReplay ? "replay" : "socket");
    this.#connection = new Connection<Frame, AsideServerFrame>({
      openSocket: () => page.openSocket(address),
      clock: page.clock,
      rows,
      decode: decodeServerFrame,
      newKey: newClientKey,
      ...(record ? { record } : {}),
      events: {
        ...events,
        phase: (phase, attempts, stopped, garbled, loading) => {
          batch(() => {
            this.#onPhase(phase, attempts, stopped, garbled);
            this.loading.value = loading;
          });
        },
        commands: (sent, settled) => {
          batch(() => {
            this.sent.value = sent;
            this.settled.value = settled;
          });
          events.settled(settled);
        },
        heldUp: (isHeldUp) => {
          this.heldUp.value = isHeldUp;
        },
        cannotOpen: async (text) => {
          const turned = turnedAway(text);
          if (!askToEnter(turned.problem, page.location)) {
            this.waits.value = turned.problem.reason === "session-waits";
            this.refusal.value = await explained(turned);
          }
        },
        reload: () => {
          if (mayReload(page.store, Date.now())) {
            page.location.reload();
          }
        },
      },
    });
  }

  /** Keeps the page's place in a session that it plays. */
  #seatIn(session: string, record: ClientRecord, held: Resume | undefined): Seat {
    const { page, events } = this.#options;
    const address = socketAddress(session, page.location);
    return new Seat({
      openSocket: () => page.openSocket(address),
      clock: page.clock,
      record,
      held,
      events: {
        message: events.message,
        refused: events.refused,
        phase: (phase) => {
          if (phase !== "connected" && this.present.peek()) {
            events.lost();
          }
          this.present.value = phase === "connected";
        },
      },
    });
  }

  #close(): void {
    this.#connection?.close();
    this.#seat?.close();
    [this.#connection, this.#seat] = [null, null];
  }

  #onPhase(phase: Phase, attempts: number, stopped: StopReason | null, garbled: number): void {
    const { hindrance, lastSession, begun, events } = this.#options;
    if (phase !== "connected" && this.connected) {
      events.lost();
    }
    batch(() => {
      this.phase.value = phase;
      if (!this.replaying.peek()) {
        this.present.value = phase === "connected";
      }
      this.attempts.value = attempts;
      this.garbled.value = garbled;
      if (stopped !== null) {
        hindrance.value = stopped;
      } else if (phase === "connected" && hindrance.peek() === "no-server") {
        hindrance.value = null;
      } else if (attempts >= SILENT_AFTER && !begun()) {
        // With nothing on the page yet there is nothing to do but wait.
        hindrance.value ??= "no-server";
      }
    });
    const isShut = stopped === "unknown-session" || stopped === "cannot-open";
    if (isShut && lastSession.peek() === this.session.peek()) {
      lastSession.value = null;
    }
  }

  /** Keeps what the server may not have got of the session that is left. */
  #part(): void {
    const [session, own] = [this.session.peek(), this.#seat ?? this.#connection];
    const gone = this.#options.hindrance.peek() === "unknown-session";
    if (session === null || own === null || gone || own.isSettled) {
      return;
    }
    this.#parted.keep(session, own.record());
    if (!this.present.peek()) {
      this.#options.events.parted();
    }
  }
}
