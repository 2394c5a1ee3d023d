/** The header that says who asks (`AU1`). */
const HEADER = "espalier-client";

let clientKey: () => string | null = () => null;

/** From now on requests come from the client whose key this gives; null for a visitor. */
export function askAs(key: () => string | null): void {
  clientKey = key;
}

/** What each request says of who asks. */
export function principal(): Record<string, string> {
  const key = clientKey();
  return key === null ? {} : { [HEADER]: key };
}
