import { useEffect, useRef, useState } from "preact/hooks";
import type { TreeVersion } from "../../../../wire/generated";
import { speciesName } from "../../../document/species/species-choice";
import { pictureOfVersion, STOPS, sameCamera } from "../../../library/same-camera";
import { timeBetween } from "../../../library/time-between";
import { differencesOf, type Seen } from "../../../library/version-differences";
import { type Shape, shapeOfVersion } from "../../../library/version-shape";
import type { Studio } from "../../../studio";
import { language, say } from "../../../words/say";
import { useSpecies } from "../../panels/architecture/species-list";
import { TreePicture } from "../tree-picture";
import { useSameView } from "./use-same-view";
import type { VersionDeeds } from "./version-card";

/** A finger goes so far for the next picture, in widths of one. */
const STEP = 1 / STOPS;

interface ComparisonProps {
  readonly studio: Studio;
  /** Whose versions they are. */
  readonly tree: string;
  readonly older: TreeVersion;
  readonly newer: TreeVersion;
  readonly deeds: VersionDeeds;
}

/** Two versions side by side in one scale, turned together, and what lies between them. */
export function Comparison({ studio, tree, older, newer, deeds }: ComparisonProps) {
  const grown = newer.metamers - older.metamers;
  const species = useSpecies(studio);
  const shapes = useShapes(tree, older.number, newer.number);
  const [stop, setStop] = useState(0);
  const known = shapes.filter((shape) => shape !== null);
  const pictures = useSameView(
    known.length < 2
      ? null
      : [older, newer].map(({ number }) => pictureOfVersion(tree, number, sameCamera(known, stop))),
  );
  const [before, after] = [older, newer].map((version, i): Seen => {
    const found = species?.find(({ slug }) => slug === version.species);
    return { version, shape: shapes[i] ?? null, species: found ? speciesName(found) : version.species };
  }) as [Seen, Seen];
  const differences = differencesOf(before, after);
  const drag = useDrag(stop, setStop);
  return (
    <section class="comparison" aria-label={say("library.compare")}>
      <p class="comparison-between">
        {say("library.between", {
          time: timeBetween(older.saved_at, newer.saved_at),
          count: grown.toLocaleString(language.value, { signDisplay: "exceptZero" }),
        })}
      </p>
      {[older, newer].map((version, i) => (
        <figure key={version.number}>
          <div class="comparison-picture" data-turns={pictures !== null} {...(pictures ? drag : {})}>
            <TreePicture url={pictures?.[i] ?? version.thumbnail} />
          </div>
          <figcaption>
            <strong>{say("library.version", { number: version.number })}</strong>
            <button type="button" class="small" onClick={() => deeds.open(version)}>
              {say("library.open-version", { number: version.number })}
            </button>
          </figcaption>
        </figure>
      ))}
      <label class="comparison-turn">
        {say("library.turn-both")}
        <input
          type="range"
          min="0"
          max={STOPS - 1}
          value={stop}
          disabled={pictures === null}
          onInput={(event) => setStop(event.currentTarget.valueAsNumber)}
        />
      </label>
      <table class="differences">
        <tbody>
          {differences.map(({ label, older, newer }) => (
            <tr key={label}>
              <th scope="row">{say(label)}</th>
              <td>{older}</td>
              <td>{newer}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </section>
  );
}

/** How large both are; null where that is not known, or not yet. */
function useShapes(tree: string, older: number, newer: number): readonly [Shape | null, Shape | null] {
  const [shapes, setShapes] = useState<readonly [Shape | null, Shape | null]>([null, null]);
  useEffect(() => {
    const stop = new AbortController();
    const find = (number: number) => shapeOfVersion(tree, number, stop.signal).catch(() => null);
    void Promise.all([find(older), find(newer)]).then((found) => stop.signal.aborted || setShapes(found));
    return () => stop.abort();
  }, [tree, older, newer]);
  return shapes;
}

/** A finger on either picture turns both. */
function useDrag(stop: number, setStop: (stop: number) => void) {
  const from = useRef<{ readonly x: number; readonly stop: number } | null>(null);
  return {
    onPointerDown: (event: PointerEvent) => {
      (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
      from.current = { x: event.clientX, stop };
    },
    onPointerMove: (event: PointerEvent) => {
      if (from.current) {
        const width = (event.currentTarget as HTMLElement).clientWidth;
        const steps = Math.round((event.clientX - from.current.x) / width / STEP);
        // The eye goes the other way.
        setStop((((from.current.stop - steps) % STOPS) + STOPS) % STOPS);
      }
    },
    onPointerUp: () => {
      from.current = null;
    },
    onPointerCancel: () => {
      from.current = null;
    },
  };
}
