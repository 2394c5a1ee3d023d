const STORE_KEY = "espalier.reloaded";
/** A second mismatch within this time means that loading again does not help. */
const PATIENCE = 60_000;

/** Whether a version mismatch may be answered by loading the page again; not where nobody can remember that it was. */
export function mayReload(store: Storage, now: number): boolean {
  const last = Number(store.getItem(STORE_KEY));
  if (last > 0 && now - last < PATIENCE) {
    return false;
  }
  try {
    store.setItem(STORE_KEY, String(now));
    return true;
  } catch {
    return false;
  }
}
