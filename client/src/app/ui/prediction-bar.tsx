import { useMemo, useRef } from "preact/hooks";
import type { Point } from "../ports";
import { MOST_STEPS } from "../prediction";
import type { Studio } from "../studio";
import { stepsOf } from "./timeline-strip";
import { useFrames } from "./use-frames";

/** Branches and twigs of a cut that are marked; of a hundred branches each still gets its mark. */
const MOST_MARKED = 64;

/** What would become of the tree without some branches: how far to look, and whether to do it. */
export function PredictionBar({ studio }: { studio: Studio }) {
  const { prediction } = studio.branches;
  const rows = prediction.rows.value;
  if (rows === null) {
    return null;
  }
  const steps = prediction.steps.value;
  const grown = prediction.grown.value;
  const waiting = grown !== steps;
  return (
    <section class="panel prediction" aria-label="Prediction">
      <label class="prediction-steps">
        <span class="number-head">
          <span>
            {rows.length === 1 ? "Without this branch" : `Without these ${rows.length} branches`}, {stepsOf(steps)} on
          </span>
          {waiting && <i class="spinner" role="status" aria-label="Growing the prediction" />}
        </span>
        <input
          type="range"
          aria-label="Steps to look ahead"
          min={1}
          max={MOST_STEPS}
          step={1}
          value={steps}
          style={{ "--place": `${(100 * (steps - 1)) / (MOST_STEPS - 1)}%` }}
          onInput={(event) => prediction.look(Number(event.currentTarget.value))}
        />
      </label>
      <div class="prediction-choice">
        <button type="button" class="small" title="Discard (Esc)" onClick={() => prediction.discard()}>
          Discard
        </button>
        <button type="button" class="primary" disabled={grown === null} onClick={() => prediction.keep()}>
          Keep this
        </button>
      </div>
    </section>
  );
}

/** Where the prediction is cut: a mark on the tree, and its like on the ghost beside it. */
export function PredictionMarks({ studio }: { studio: Studio }) {
  const marks = useRef<SVGGElement>(null);
  const { table } = studio;
  const cuts = studio.branches.prediction.cuts.value;
  const beside = studio.branches.ghosts.beside.value;
  // Each frame of rows may have moved them.
  const revision = studio.revision.value;
  const places = useMemo(() => cuts.slice(0, MOST_MARKED).map((row) => borneAt(studio, row)), [cuts, revision]);
  useFrames(cuts.length > 0, () => {
    const project = studio.stage.projector();
    for (const [i, place] of places.entries()) {
      const [here, there] = [marks.current?.children[2 * i], marks.current?.children[2 * i + 1]];
      put(here, project?.(place));
      put(there, beside && project?.([place[0] + beside[0], place[1] + beside[1], place[2] + beside[2]]));
    }
  });
  if (cuts.length === 0 || table.rows === 0) {
    return null;
  }
  return (
    <svg class="overlay cut-marks" aria-hidden="true">
      <g ref={marks}>
        {places.flatMap((place, i) => [
          <CutMark key={`here ${i} ${place.join()}`} />,
          <CutMark key={`there ${i} ${place.join()}`} />,
        ])}
      </g>
    </svg>
  );
}

function CutMark() {
  return (
    <g transform="translate(-99 -99)">
      <circle class="cut-casing" r="11" />
      <circle class="cut-ring" r="11" />
      <path class="cut-line" d="M-6 6 6-6" />
    </g>
  );
}

function put(mark: Element | undefined, place: readonly [number, number] | null | undefined): void {
  mark?.setAttribute("transform", place ? `translate(${place[0]} ${place[1]})` : "translate(-99 -99)");
}

/** Where the branch that begins with a row is borne. */
function borneAt({ table }: Studio, row: number): Point {
  const at = table.parent[row] ?? row;
  return [table.position[3 * at] ?? 0, table.position[3 * at + 1] ?? 0, table.position[3 * at + 2] ?? 0];
}
