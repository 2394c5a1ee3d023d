/** A part of how the picture is drawn that can be switched by itself. */
interface Row {
  /** Whether it is on as long as nobody says otherwise. */
  readonly usual: boolean;
}

/** What can be switched, in the order of the menu and of the keys `1` and on. */
export const SHOWN_ROWS = {
  /** Sun and sky; without them colours are drawn as they are. */
  light: { usual: true },
  /** Rounded surfaces; without, each triangle is seen as a face. */
  smooth: { usual: true },
  /** What is painted on bark, blades, clay and ground; without, each has one colour. */
  texture: { usual: true },
  /** Shadows that are cast. */
  shadow: { usual: true },
  /** Sky and ground; without, bare paper. */
  background: { usual: true },
  /** The edges of triangles instead of their faces. */
  wireframe: { usual: false },
  /** The axes as lines, over the tree. */
  skeleton: { usual: false },
} as const satisfies Record<string, Row>;

export type ShownName = keyof typeof SHOWN_ROWS;
export const SHOWN_NAMES = Object.keys(SHOWN_ROWS) as readonly ShownName[];

/** Which of them are on. */
export type Shown = Readonly<Record<ShownName, boolean>>;

/** As it is when nobody has switched anything. */
export const USUAL = Object.fromEntries(SHOWN_NAMES.map((name) => [name, SHOWN_ROWS[name].usual])) as Shown;

/** The same with one of them switched over. */
export function switched(shown: Shown, name: ShownName): Shown {
  return { ...shown, [name]: !shown[name] };
}

export function isUsual(shown: Shown): boolean {
  return SHOWN_NAMES.every((name) => shown[name] === USUAL[name]);
}

/** The key that switches it. */
export function keyOf(name: ShownName): string {
  return String(SHOWN_NAMES.indexOf(name) + 1);
}

/** What a key switches, if any. */
export function shownOfKey(key: string): ShownName | null {
  return SHOWN_NAMES.find((name) => keyOf(name) === key) ?? null;
}

/** What was kept of it: what is missing there, or is none of it, is as usual. */
export function asShown(kept: unknown): Shown {
  const known = typeof kept === "object" && kept !== null ? (kept as Partial<Record<string, unknown>>) : {};
  const of = (name: ShownName) => (typeof known[name] === "boolean" ? known[name] : USUAL[name]);
  return Object.fromEntries(SHOWN_NAMES.map((name) => [name, of(name)])) as Shown;
}
