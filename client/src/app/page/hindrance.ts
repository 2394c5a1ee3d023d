/** What keeps the workspace from being used, with a way on. */
export type Hindrance =
  | "unknown-session"
  | "cannot-open"
  | "only-look"
  | "version"
  | "no-server"
  | "no-webgl"
  | "no-picture";
