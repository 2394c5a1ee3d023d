import type { DesignInForce, DesignSetting } from "../../../wire/generated";
import { DESIGN_KEYS } from "./design-keys";
import { combined } from "./relative-values";

export type DesignKey = (typeof DESIGN_KEYS)[number];
export type KeyName = DesignKey["name"];

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
  /** What is said of it here. */
  readonly setting: DesignSetting | undefined;
}

/** Of what something is said: of one branch, or of all of its order that say nothing themselves. */
export type Scope = "branch" | "order";

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

/** What all branches of the order of one are called where something is said of them. */
export function levelOf(path: string): string {
  return `level ${orderOf(path)}`;
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
    return this.saidOfOrder(path, key);
  }

  /** The same for all branches of its order. */
  saidOfOrder(path: string, key: KeyName): { readonly by: string; readonly setting: DesignSetting } | null {
    const level = this.graph.levels?.[orderOf(path)]?.values?.[key];
    return level ? { by: levelOf(path), setting: level } : null;
  }

  /** What is said of a parameter by a branch or a level, and by nobody else. */
  settingOf(owner: string, key: KeyName): DesignSetting | undefined {
    const [, level] = /^level (\d+)$/.exec(owner) ?? [];
    const record = level === undefined ? this.graph.nodes?.[owner] : this.graph.levels?.[level];
    return record?.values?.[key];
  }

  /** The branches of an order that say something of a parameter themselves. */
  exceptions(order: number, key: KeyName): readonly string[] {
    const nodes = Object.entries(this.graph.nodes ?? {});
    return nodes.filter(([path, { values }]) => orderOf(path) === order && values?.[key]).map(([path]) => path);
  }

  /** A value of a branch, or the one that all of its order have who say nothing themselves. */
  resolve(path: string, key: DesignKey, scope: Scope = "branch"): Resolved {
    const said = scope === "order" ? this.saidOfOrder(path, key.name) : this.said(path, key.name);
    const from = this.#heir(path, key.name, said?.setting.below === true);
    const below = from === null ? null : this.resolve(from, key);
    const inherited = below ? below.value : JSON.parse(key.standard);
    const isPrivate = said?.setting.private === true;
    const setting = said?.setting;
    const by = said?.by ?? null;
    if (setting?.own !== undefined) {
      return { value: setting.own, inherited, status: "own", isPrivate, origin: by, setting };
    }
    if (setting?.shared !== undefined) {
      const value = this.graph.shares?.[setting.shared]?.value ?? inherited;
      return { value, inherited, status: "shared", isPrivate, origin: by, setting };
    }
    if (setting?.add !== undefined) {
      const value = combined(inherited, setting.add, key, "offset");
      return { value, inherited, status: "offset", isPrivate, origin: by, setting };
    }
    if (setting?.multiply !== undefined) {
      const value = combined(inherited, setting.multiply, key, "factor");
      return { value, inherited, status: "factor", isPrivate, origin: by, setting };
    }
    return { value: inherited, inherited, status: "inherited", isPrivate, origin: below?.origin ?? null, setting };
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

/** What parameters are about, to find one among many. */
export const KEY_GROUPS = ["all", "size", "form", "branches", "looks"] as const;
export type KeyGroup = (typeof KEY_GROUPS)[number];

const GROUP_OF: Readonly<Record<KeyName, Exclude<KeyGroup, "all">>> = {
  height: "size",
  stem: "size",
  silhouette: "form",
  axis: "form",
  reach: "size",
  cut: "size",
  turn: "form",
  roll: "form",
  pull: "form",
  density: "branches",
  zone: "branches",
  whorl: "branches",
  phyllotaxis: "branches",
  azimuth: "branches",
  branching_angle: "branches",
  irregularity: "form",
  orders: "branches",
  internode: "size",
  girth: "size",
  taper: "size",
  leaves: "looks",
  leaf_size: "looks",
  material: "looks",
  shown: "branches",
};

/** The parameters that a branch has. */
export function keysOf(path: string, group: KeyGroup = "all"): readonly DesignKey[] {
  const isIn = (key: DesignKey) => group === "all" || GROUP_OF[key.name] === group;
  return DESIGN_KEYS.filter((key) => (path === ROOT || !key.ofRoot) && isIn(key));
}
