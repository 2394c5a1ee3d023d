/** How a tree is looked at: what a link can ask for. */
export interface View {
  /** Turn around the tree, in degrees; 0 looks along −z. */
  readonly yaw: number;
  /** Height of the eye above the horizontal, in degrees. */
  readonly pitch: number;
  /** 1 shows the whole tree with some room around it, 2 is half as far away. */
  readonly zoom: number;
  /** How far the tree is moved to the right and up, in halves of the picture's height. */
  readonly right: number;
  readonly up: number;
}

/** The whole tree from its front. */
export const WHOLE: View = { yaw: 0, pitch: -4.6, zoom: 1, right: 0, up: 0 };
const LEAST_ZOOM = 0.2;
const MOST_ZOOM = 20;
const NAMES = Object.keys(WHOLE) as (keyof View)[];

/** The view that the query of an address asks for, as `?yaw=30&pitch=10&zoom=1.5`; null if it asks for none. */
export function viewIn(query: string): View | null {
  const asked = new URLSearchParams(query);
  if (!NAMES.some((name) => asked.has(name))) return null;
  const view: { -readonly [name in keyof View]: number } = { ...WHOLE };
  for (const name of NAMES) {
    const value = Number.parseFloat(asked.get(name) ?? "");
    if (Number.isFinite(value)) view[name] = value;
  }
  view.zoom = Math.min(Math.max(view.zoom, LEAST_ZOOM), MOST_ZOOM);
  return view;
}
