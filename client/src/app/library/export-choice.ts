import type { ExportFormat } from "../../wire/generated";

/** What a person chose to download last. */
export interface ExportChoice {
  /** `picture`, which the page makes, or the ending of a file that the server writes. */
  readonly format: string;
  readonly lod: string;
  readonly frames: string;
  /** Switches that are on, for all formats that have them. */
  readonly on: readonly string[];
  readonly author: string;
  readonly licence: string;
}

export const FIRST_CHOICE: ExportChoice = {
  format: "picture",
  lod: "0",
  frames: "36",
  on: [],
  author: "",
  licence: "",
};

/** Whether what was kept is a choice. */
export function isExportChoice(value: unknown): boolean {
  const choice = value as Partial<ExportChoice> | null;
  return (
    typeof choice === "object" &&
    choice !== null &&
    [choice.format, choice.lod, choice.frames, choice.author, choice.licence].every(
      (text) => typeof text === "string",
    ) &&
    Array.isArray(choice.on) &&
    choice.on.every((name) => typeof name === "string")
  );
}

/** What of a choice the format can do, as the server is asked for it. */
export function optionsOf(choice: ExportChoice, format: ExportFormat): ReadonlyMap<string, string> {
  const all: [string, string][] = [
    ["lod", choice.lod === "0" ? "" : choice.lod],
    ...choice.on.map((name): [string, string] => [name, "true"]),
    ["frames", choice.frames],
    ["author", choice.author.trim()],
    ["licence", choice.licence.trim()],
  ];
  return new Map(all.filter(([name, value]) => value !== "" && format.options.includes(name)));
}

/** About how many bytes the file of a tree has. */
export function bytesExpected(
  format: ExportFormat,
  options: ReadonlyMap<string, string>,
  tree: { readonly metamers: number; readonly leaves: number },
): number {
  const [least, metamer, leaf] = format.bytes;
  const lod = options.get("lod") ?? "0";
  const level = lod === "set" ? format.levels.reduce((sum, share) => sum + share) : (format.levels[Number(lod)] ?? 1);
  let [wood, leaves] = [1, 1];
  for (const name of options.keys()) {
    const [ofWood, ofLeaves] = format.shares[name] ?? [1, 1];
    [wood, leaves] = [wood * ofWood, leaves * ofLeaves];
  }
  const frames = Number(options.get("frames") ?? 1);
  return least * frames + level * (tree.metamers * metamer * wood + tree.leaves * leaf * leaves);
}
