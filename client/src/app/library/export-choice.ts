import type { ExportFormat } from "../../wire/generated";

/** The format that the page makes itself. */
export const PICTURE = "picture";

/** What a person chose to download last. */
export interface ExportChoice {
  /** `PICTURE`, or the ending of a file that the server writes. */
  readonly format: string;
  readonly lod: string;
  readonly frames: string;
  /** Texels along a side of light maps; none, or missing in what was kept before there were any. */
  readonly lightmap?: string;
  /** The most bones of a plant that sways; none, or missing in what was kept before there were any. */
  readonly sway?: string;
  /** `seen`, for pictures that the server makes from where the page looks; missing in what was kept before there was that. */
  readonly camera?: string;
  /** Pixels of a picture across and down, as options have it; none for the usual ones, missing in what was kept before. */
  readonly size?: string;
  /** Points of a cloud; missing in what was kept before there was a choice. */
  readonly points?: string;
  /** Switches that are on, for all formats that have them. */
  readonly on: readonly string[];
  readonly author: string;
  readonly licence: string;
}

export const FIRST_CHOICE: ExportChoice = {
  format: PICTURE,
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
    [choice.lightmap, choice.sway, choice.camera, choice.size, choice.points].every((text) =>
      ["undefined", "string"].includes(typeof text),
    ) &&
    Array.isArray(choice.on) &&
    choice.on.every((name) => typeof name === "string")
  );
}

/** Whether leaves have to move in the file: those that are instances stand still. */
export function moves({ sway, on }: ExportChoice, { options }: ExportFormat): boolean {
  const sways = options.includes("sway") && (sway ?? "") !== "";
  return sways || (options.includes("wind_weights") && on.includes("wind_weights"));
}

const FRAMES = ["1", "24", "36", "72"] as const;

/** How many pictures a file may have: a turntable also one, a loop that moves several. */
export function framesOffered({ ending }: Pick<ExportFormat, "ending">): readonly string[] {
  return ending === "sway.png" ? FRAMES.filter((frames) => frames !== "1") : FRAMES;
}

/** How many are chosen, of those that are offered. */
export function framesOf({ frames }: ExportChoice, format: Pick<ExportFormat, "ending">): string {
  return framesOffered(format).includes(frames) ? frames : FIRST_CHOICE.frames;
}

/** Points of a cloud where nobody says more. */
export const POINTS = "1000000";

/** What of a choice the format can do, as the server is asked for it; `seen` is the page's own view, where it has one. */
export function optionsOf(
  choice: ExportChoice,
  format: ExportFormat,
  seen?: ReadonlyMap<string, string> | null,
): ReadonlyMap<string, string> {
  const still = moves(choice, format) ? "instanced" : null;
  const all: [string, string][] = [
    ["lod", choice.lod === "0" ? "" : choice.lod],
    ...choice.on.filter((name) => name !== still).map((name): [string, string] => [name, "true"]),
    ["lightmap", choice.lightmap ?? ""],
    ["sway", choice.sway ?? ""],
    ["frames", framesOf(choice, format)],
    ["points", choice.points ?? POINTS],
    ...(choice.camera === "seen" && seen ? seen : []),
    // After that of the page's own view.
    ["size", choice.size ?? ""],
    ["author", choice.author.trim()],
    ["licence", choice.licence.trim()],
  ];
  return new Map(all.filter(([name, value]) => value !== "" && format.options.includes(name)));
}
