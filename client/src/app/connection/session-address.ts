/** The session a page's path names, if any. */
export function sessionInPath(path: string): string | null {
  const name = /^\/s\/([^/]+)\/?$/.exec(path)?.[1];
  try {
    return name === undefined ? null : decodeURIComponent(name);
  } catch {
    return null;
  }
}

/** The path that names a session. */
export function pathOf(session: string): string {
  return `/s/${encodeURIComponent(session)}`;
}
