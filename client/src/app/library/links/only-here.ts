/** Whether an address leads nowhere from another machine than the one it is opened on. */
export function isOnlyHere(address: string): boolean {
  const { hostname } = new URL(address);
  return /^(127\.\d+\.\d+\.\d+|\[::1\]|([^.]+\.)*localhost)$/.test(hostname);
}
