import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { WIND_PRESETS, type WindPreset } from "../../../client/src/app/document/wind/wind-presets";
import type { Appearance } from "../../../client/src/wire/generated";

/** Where sketches lie and pictures go. */
export const FOLDER = join(import.meta.dirname, "../../../docs/gallery");

/** How a picture is taken: as the page reads it from its address, and the size in pixels. */
export interface Shot {
  /** Turn around the tree, in degrees. */
  readonly yaw?: number;
  /** Height of the eye above the horizontal, in degrees. */
  readonly pitch?: number;
  /** 1 shows the whole tree with some room around it. */
  readonly zoom?: number;
  /** How far the tree is moved, in halves of the picture's height. */
  readonly right?: number;
  readonly up?: number;
  readonly width: number;
  readonly height: number;
}

/** A script and the seed it is played with. */
export interface Tree {
  readonly script: string;
  readonly seed: number;
}

/** A sketch of the gallery. */
export interface Entry {
  /** Of its picture `NAME.jpg`, and of its script `sketches/NAME.jsonl` unless `script` names another one. */
  readonly name: string;
  readonly script?: string;
  readonly seed: number;
  readonly shot: Shot;
  /** So many operations are taken back for a second picture, which is put on the left of the first. */
  readonly undone?: number;
  /** More trees, each grown by a script of its own, whose pictures follow the first one's in rows of so many. */
  readonly beside?: { readonly row: number; readonly trees: readonly Tree[] };
  /** Commands that are done once the camera stands: a wind, in which it stands where it did in the calm. */
  readonly afterwards?: readonly object[];
  /** A wind to pick from in the panel that blows then, and what is set besides. */
  readonly wind?: Partial<Appearance["wind"]> & { readonly preset: WindPreset };
}

/** All sketches, in the order of the gallery. */
export async function readCatalogue(): Promise<Entry[]> {
  const entries = JSON.parse(await readFile(join(FOLDER, "gallery.json"), "utf8")) as Entry[];
  return entries.map(blown);
}

/** An entry whose wind blows by a command. */
function blown(entry: Entry): Entry {
  if (!entry.wind) return entry;
  const { preset, ...besides } = entry.wind;
  const appearance = { wind: { ...WIND_PRESETS[preset], ...besides } };
  return { ...entry, afterwards: [...(entry.afterwards ?? []), { kind: "set_appearance", appearance }] };
}

/** The file of a sketch's script. */
export function scriptOf({ script }: Pick<Tree, "script">): string {
  return join(FOLDER, "sketches", `${script}.jsonl`);
}

/** The commands of a sketch's script, each as its line of JSON; empty lines are none. */
export async function readScript(tree: Pick<Tree, "script">): Promise<string[]> {
  const text = await readFile(scriptOf(tree), "utf8");
  return text.split("\n").filter((line) => line.trim() !== "");
}

/** What is grown for an entry's picture, each in a session of its own. */
export function treesOf({ name, script = name, seed, beside }: Entry): Tree[] {
  return [{ script, seed }, ...(beside?.trees ?? [])];
}

/** The entries with these names, or all if none are given; a name that is not there is an error. */
export function chosen(entries: readonly Entry[], names: readonly string[]): readonly Entry[] {
  const unknown = names.filter((name) => !entries.some((entry) => entry.name === name));
  if (unknown.length > 0) {
    const known = entries.map(({ name }) => name).join(", ");
    throw new Error(`no such sketch: ${unknown.join(", ")}; there are ${known}`);
  }
  return names.length === 0 ? entries : entries.filter(({ name }) => names.includes(name));
}

/** What a page's address ends with to show a shot and nothing else. */
export function query({ width: _, height: __, ...view }: Shot): string {
  return `?${new URLSearchParams(Object.entries(view).map(([key, value]) => [key, String(value)]))}`;
}
