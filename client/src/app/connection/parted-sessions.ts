import type { ClientRecord } from "./connection-core";

const STORE_KEY = "espalier.parted";

/** What servers have not yet got of sessions this page has left: it goes out when they are opened again. */
export class PartedSessions {
  #records = new Map<string, ClientRecord>();

  /** A session is left with commands that are not answered. */
  keep(session: string, record: ClientRecord): void {
    this.#records.set(session, record);
  }

  /** A session is opened: what was kept of it, which is then its connection's. */
  take(session: string): ClientRecord | undefined {
    const record = this.#records.get(session);
    this.#records.delete(session);
    return record;
  }

  /** The page is left: a later page of this tab continues with it. */
  leave(store: Storage): void {
    if (this.#records.size === 0) {
      store.removeItem(STORE_KEY);
      return;
    }
    try {
      store.setItem(STORE_KEY, JSON.stringify([...this.#records]));
    } catch {
      // A full or forbidden storage costs only what was unsent.
      store.removeItem(STORE_KEY);
    }
  }

  /** The page is there, or there again: while it lives nothing is stored, so a duplicated tab sends nothing twice. */
  come(store: Storage): void {
    const text = store.getItem(STORE_KEY);
    store.removeItem(STORE_KEY);
    if (text === null) {
      return;
    }
    try {
      for (const [session, record] of JSON.parse(text) as [string, ClientRecord][]) {
        const whole = typeof record.key === "string" && Number.isInteger(record.next) && Array.isArray(record.pending);
        if (whole && !this.#records.has(session)) {
          this.#records.set(session, record);
        }
      }
    } catch {
      // What is not readable is none of ours.
    }
  }
}
