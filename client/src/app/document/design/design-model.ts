import type { DesignInForce, DesignSetting } from "../../../wire/generated";
import { DESIGN_KEYS } from "./design-keys";

export type DesignKey = (typeof DESIGN_KEYS)[number];
export type KeyName = DesignKey["name"];
export type Points = readonly (readonly [number, number])[];

/** How a branch has a value. */
export type Status = "own" | "inherited" | "offset" | "factor" | "shared";

interface DesignRecord {
  readonly name?: string;
  readonly values?: Readonly<Partial<Record<KeyName, DesignSetting>>>;
}

/** What was said, as the server tells it. */
export interface DesignGraph {
  readonly nodes?: Readonly<Record<string, DesignRecord>>;
  readonly levels?: Readonly<Record<string, DesignRecord>>;
  readonly shares?: Readonly<Record<string, { readonly key: KeyName; readonly value: unknown }>>;
  /** The laterals of bearers of which something was said. */
  readonly laterals?: Readonly<Record<string, readonly { readonly number: number; readonly anchor?: number }[]>>;
}

/** A value of a branch, and where it comes from. */
export interface Resolved {
  readonly value: unknown;
  /** What it would inherit. */
  readonly inherited: unknown;
  readonly status: Status;
  readonly isPrivate: boolean;
  /** The branch or level that says it; null where nobody does. */
  readonly origin: string | null;
}

export const ROOT = "/";

/** The branch that bears another; null for the plant's own axis. */
export function bearerOf(path: string): string | null {
  return path === ROOT ? null : path.slice(0, path.lastIndexOf("/")) || ROOT;
}

/** A lateral of a branch. */
export function lateralOf(path: string, number: number): string {
  return path === ROOT ? `/${number}` : `${path}/${number}`;
}

/** The order of branching: 0 for the plant's own axis. */
export function orderOf(path: string): number {
  return path === ROOT ? 0 : path.split("/").length - 1;
}

/** The way to a branch from the plant's own axis, both included. */
export function wayTo(path: string): readonly string[] {
  const below = bearerOf(path);
  return below === null ? [path] : [...wayTo(below), path];
}

/** A design as the page shows it. */
export class DesignModel {
  readonly told: DesignInForce;
  readonly graph: DesignGraph;

  constructor(told: DesignInForce) {
    this.told = told;
    this.graph = told.graph as DesignGraph;
  }

  /** The laterals of a branch, as far as they are told. */
  laterals(path: string): readonly string[] {
    return (this.told.laterals[path] ?? []).map((number) => lateralOf(path, number));
  }

  nameOf(path: string): string | undefined {
    return this.graph.nodes?.[path]?.name;
  }

  /** Where a branch stands whatever stands beside it; null where that follows from its place among those. */
  anchorOf(path: string): number | null {
    const bearer = bearerOf(path);
    const slots = bearer === null ? [] : (this.graph.laterals?.[bearer] ?? []);
    const number = Number(path.slice(path.lastIndexOf("/") + 1));
    return slots.find((slot) => slot.number === number)?.anchor ?? null;
  }

  /** How many values a branch has of its own. */
  ownValues(path: string): number {
    return Object.keys(this.graph.nodes?.[path]?.values ?? {}).length;
  }

  /** What is said of a parameter for a branch itself, and by whom. */
  said(path: string, key: KeyName): { readonly by: string; readonly setting: DesignSetting } | null {
    const own = this.graph.nodes?.[path]?.values?.[key];
    if (own) {
      return { by: path, setting: own };
    }
    const level = this.graph.levels?.[orderOf(path)]?.values?.[key];
    return level ? { by: `level ${orderOf(path)}`, setting: level } : null;
  }

  resolve(path: string, key: DesignKey): Resolved {
    const said = this.said(path, key.name);
    const from = this.#heir(path, key.name, said?.setting.below === true);
    const below = from === null ? null : this.resolve(from, key);
    const inherited = below ? below.value : JSON.parse(key.standard);
    const isPrivate = said?.setting.private === true;
    const setting = said?.setting;
    const by = said?.by ?? null;
    if (setting?.own !== undefined) {
      return { value: setting.own, inherited, status: "own", isPrivate, origin: by };
    }
    if (setting?.shared !== undefined) {
      const value = this.graph.shares?.[setting.shared]?.value ?? inherited;
      return { value, inherited, status: "shared", isPrivate, origin: by };
    }
    if (setting?.add !== undefined) {
      const value = combined(inherited, setting.add, key, (a, b) => a + b);
      return { value, inherited, status: "offset", isPrivate, origin: by };
    }
    if (setting?.multiply !== undefined) {
      const value = combined(inherited, setting.multiply, key, (a, b) => a * b);
      return { value, inherited, status: "factor", isPrivate, origin: by };
    }
    return { value: inherited, inherited, status: "inherited", isPrivate, origin: below?.origin ?? null };
  }

  /** The branch that a parameter is inherited from; null for the plant's own axis. */
  #heir(path: string, key: KeyName, below: boolean): string | null {
    const bearer = bearerOf(path);
    if (bearer === null) {
      return null;
    }
    const isPublic = (one: string) => this.said(one, key)?.setting.private !== true;
    if (below) {
      const axis = this.laterals(bearer);
      const beneath = axis
        .slice(0, Math.max(axis.indexOf(path), 0))
        .reverse()
        .find(isPublic);
      if (beneath) {
        return beneath;
      }
    }
    for (let next: string | null = bearer; next !== null; next = bearerOf(next)) {
      if (isPublic(next)) {
        return next;
      }
    }
    return ROOT;
  }
}

/** A parameter by its name. */
export function keyNamed(name: KeyName): DesignKey {
  // Names are those of the table.
  return DESIGN_KEYS.find((key) => key.name === name) as DesignKey;
}

/** The parameters that a branch has. */
export function keysOf(path: string): readonly DesignKey[] {
  return DESIGN_KEYS.filter((key) => path === ROOT || !key.ofRoot);
}

export function isPoints(value: unknown): value is Points {
  return Array.isArray(value) && value.every((point) => Array.isArray(point) && point.length === 2);
}

/** The value of a function between its points; straight, where the server's is smooth. */
export function at(points: Points, t: number): number {
  const next = points.findIndex(([place]) => place >= t);
  const [after, before] = [points[next] ?? points.at(-1), points[next - 1]];
  if (!after) {
    return 0;
  }
  if (!before || next < 0) {
    return after[1];
  }
  const share = (t - before[0]) / Math.max(after[0] - before[0], 1e-6);
  return before[1] + (after[1] - before[1]) * share;
}

function combined(inherited: unknown, own: unknown, key: DesignKey, join: (a: number, b: number) => number): unknown {
  const within = (value: number) => Math.min(Math.max(value, key.least), key.most);
  if (typeof inherited === "number" && typeof own === "number") {
    return within(join(inherited, own));
  }
  if (isPoints(inherited) && isPoints(own)) {
    const places = [...new Set([...inherited, ...own].map(([t]) => t))].sort((a, b) => a - b);
    return places.map((t) => [t, within(join(at(inherited, t), at(own, t)))]);
  }
  return inherited;
}
