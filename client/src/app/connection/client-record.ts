import type { ClientRecord } from "./connection-core";

const STORE_KEY = "espalier.client";
const KEY_ALPHABET = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

/** A random client key of 22 characters, 132 bits (`HS1`). */
export function newClientKey(): string {
  // `crypto.randomUUID` is missing on plain http, which is how a tablet in the same network arrives.
  const bytes = crypto.getRandomValues(new Uint8Array(22));
  return Array.from(bytes, (byte) => KEY_ALPHABET[byte % 64]).join("");
}

/** Keeps a record for the next page of this tab. */
export function leaveRecord(store: Storage, session: string, record: ClientRecord): void {
  try {
    store.setItem(STORE_KEY, JSON.stringify({ session, ...record }));
  } catch {
    // A full or forbidden storage costs only what was unsent at the very end.
    store.removeItem(STORE_KEY);
  }
}

/**
 * Takes the record an earlier page of this tab left, if it was for this session.
 *
 * Taking removes it: while a page lives nothing is stored, so a duplicated tab finds no key to share.
 */
export function takeRecord(store: Storage, session: string): ClientRecord | undefined {
  const text = store.getItem(STORE_KEY);
  store.removeItem(STORE_KEY);
  if (text === null) {
    return undefined;
  }
  try {
    const { session: left, ...record } = JSON.parse(text) as ClientRecord & { session: string };
    const whole = typeof record.key === "string" && Number.isInteger(record.next) && Array.isArray(record.pending);
    return whole && left === session ? record : undefined;
  } catch {
    return undefined;
  }
}
