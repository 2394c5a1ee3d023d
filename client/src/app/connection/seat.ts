import type { Frame } from "../../wire/frame";
import type { Resume } from "../../wire/generated";
import { type AsideServerFrame, decodeServerFrame } from "../../wire/server-frame";
import type { Clock } from "../page/clock";
import { newClientKey } from "./client-record";
import { Connection, type ConnectionEvents, type Socket } from "./connection";
import type { ClientRecord, Phase, Told } from "./connection-core";
import type { RowStore } from "./row-store";

export interface SeatOptions {
  readonly openSocket: () => Socket;
  readonly clock: Clock;
  /** What the page was there with, so that it stays the same device, and what it had not sent goes out. */
  readonly record: ClientRecord;
  /** The rows it held then: they need not be sent again. */
  readonly held: Resume | undefined;
  readonly events: Pick<ConnectionEvents<unknown>, "message" | "refused"> & { phase(phase: Phase): void };
}

/** A page's place in a session while it plays a copy of it: it says that it is there, and is told who else is. */
export class Seat {
  #connection: Connection<Frame, AsideServerFrame>;

  constructor({ openSocket, clock, record, held, events }: SeatOptions) {
    this.#connection = new Connection<Frame, AsideServerFrame>({
      openSocket,
      clock,
      rows: unseenRows(held),
      decode: decodeServerFrame,
      newKey: newClientKey,
      record,
      events: {
        phase: (phase) => events.phase(phase),
        // All else that is told of the session is told again when the page comes back.
        message: (message) => message.type === "people" && events.message(message),
        refused: events.refused,
        commands: () => {},
        heldUp: () => {},
        aside: () => {},
        rows: () => {},
        rekeyed: () => {},
        renumbered: () => {},
        // The socket of the replay is turned away as well, and speaks of it.
        cannotOpen: () => {},
        reload: () => {},
      },
    });
  }

  tell(message: Told): boolean {
    return this.#connection.tell(message);
  }

  set watchful(watchful: boolean) {
    this.#connection.watchful = watchful;
  }

  wake(): void {
    this.#connection.wake();
  }

  /** What the page goes on with when it comes back. */
  record(): ClientRecord {
    return this.#connection.record();
  }

  /** Whether the server has answered all that was sent. */
  get isSettled(): boolean {
    return this.#connection.isSettled;
  }

  close(): void {
    this.#connection.close();
  }
}

/** Rows that nobody looks at: none are kept, and only those that were held before are not sent again. */
function unseenRows(held: Resume | undefined): RowStore<Frame> {
  let known = held;
  return {
    held: () => known,
    apply: () => {},
    clear: () => {
      known = undefined;
    },
    sum: async () => null,
  };
}
