import type { TreeVersion } from "../../wire/generated";
import { momentText } from "../words/date-text";
import { countText, metresText } from "../words/measure-text";
import { type Key, say } from "../words/say";
import { measuresOf, type Shape } from "./version-shape";

/** A version with how large it is, where that is known. */
export interface Seen {
  readonly version: TreeVersion;
  readonly shape: Shape | null;
  /** What its species is called. */
  readonly species: string | undefined;
}

interface Row {
  readonly label: Key;
  /** What it is of a version; null where nobody knows. */
  readonly of: (seen: Seen) => string | null;
}

/** What versions may differ in. */
const ROWS: readonly Row[] = [
  { label: "library.differ.metamers", of: ({ version }) => countText(version.metamers) },
  { label: "library.differ.height", of: ({ shape }) => shape && metresText(measuresOf(shape).height) },
  { label: "library.differ.spread", of: ({ shape }) => shape && metresText(measuresOf(shape).spread) },
  { label: "library.differ.species", of: ({ species }) => species ?? say("library.differ.none") },
  { label: "library.differ.author", of: ({ version }) => version.author ?? say("library.differ.none") },
  { label: "library.differ.saved", of: ({ version }) => momentText(version.saved_at) },
  { label: "library.differ.note", of: ({ version }) => version.note || say("library.differ.none") },
];

/** A line of what is another in one version than in the other. */
export interface Difference {
  readonly label: Key;
  readonly older: string;
  readonly newer: string;
}

/** What differs between two versions, as people read it. */
export function differencesOf(older: Seen, newer: Seen): readonly Difference[] {
  return ROWS.flatMap(({ label, of }) => {
    const [before, after] = [of(older), of(newer)];
    return before === null || after === null || before === after ? [] : [{ label, older: before, newer: after }];
  });
}
