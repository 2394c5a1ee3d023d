const STORE_KEY = "espalier.reloaded";
/** A second mismatch within this time means that loading again does not help. */
const PATIENCE = 60_000;

/** Whether a version mismatch may be answered by a reload; not where no storage can record that one was made. */
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
