import { useMemo, useRef } from "preact/hooks";
import type { Vec3 } from "../../../scene/vector";
import type { Studio } from "../../studio";
import { FIRST_STEPS, MOST_STEPS } from "../../tools/branch/prediction";
import { say } from "../../words/say";
import { Slider } from "../controls/slider";
import { stepsOf } from "../timeline/step-count";
import { useAnimationFrames } from "../use-animation-frames";

/** Branches and twigs of a cut that are marked; of a hundred branches each still gets its mark. */
const MOST_MARKED = 64;
/** The radius of a mark, in pixels. */
const RING = 11;

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
  const look = (to: number) => {
    if (to !== steps) {
      prediction.look(to);
    }
  };
  return (
    <section class="panel prediction single-line" aria-label={say("tools.prediction")}>
      <div class="prediction-steps">
        <p class="prediction-what">
          <span>
            {say(rows.length === 1 ? "tools.prediction.one" : "tools.prediction.many", {
              count: rows.length,
              steps: stepsOf(steps),
            })}
          </span>
          {waiting && <i class="spinner" role="status" aria-label={say("tools.prediction.growing")} />}
        </p>
        <Slider
          label={say("tools.prediction.steps")}
          help={say("tools.prediction.steps.help")}
          least={1}
          most={MOST_STEPS}
          step={1}
          value={steps}
          standard={FIRST_STEPS}
          onDrag={look}
          onCommit={look}
        />
      </div>
      <div class="prediction-choice">
        <button
          type="button"
          class="small"
          title={say("tools.prediction.discard.title")}
          onClick={() => prediction.discard()}
        >
          {say("tools.prediction.discard")}
        </button>
        <button type="button" class="primary" disabled={grown === null} onClick={() => prediction.keep()}>
          {say("tools.prediction.keep")}
        </button>
      </div>
    </section>
  );
}

/** Where the prediction is cut: a mark on the tree, and its like on the ghost beside it. */
export function PredictionMarks({ studio }: { studio: Studio }) {
  const [casing, marks] = [useRef<SVGPathElement>(null), useRef<SVGPathElement>(null)];
  const { prediction, ghosts } = studio.branches;
  const cuts = prediction.cuts.value;
  const beside = ghosts.beside.value;
  // Each frame of rows may have moved them.
  const revision = studio.revision.value;
  const places = useMemo(() => cuts.slice(0, MOST_MARKED).map((row) => borneAt(studio, row)), [cuts, revision]);
  useAnimationFrames(cuts.length > 0, () => {
    const project = studio.stage.projector();
    let [rings, strokes] = ["", ""];
    for (const [x, y, z] of places) {
      const there = beside && project?.([x + beside[0], y + beside[1], z + beside[2]]);
      for (const place of [project?.([x, y, z]), there]) {
        if (place) {
          const [left, top] = [place[0].toFixed(1), place[1].toFixed(1)];
          rings += `M${left} ${top}m-${RING} 0a${RING} ${RING} 0 1 0 ${2 * RING} 0a${RING} ${RING} 0 1 0-${2 * RING} 0`;
          strokes += `M${left} ${top}m-6 6 12-12`;
        }
      }
    }
    casing.current?.setAttribute("d", rings);
    marks.current?.setAttribute("d", rings + strokes);
  });
  if (cuts.length === 0) {
    return null;
  }
  return (
    <svg class="overlay" aria-hidden="true">
      <path class="cut-casing" ref={casing} />
      <path class="cut-mark" ref={marks} />
    </svg>
  );
}

/** Where the branch that begins with a row is borne. */
function borneAt({ table }: Studio, row: number): Vec3 {
  const at = table.parent[row] ?? row;
  return [table.position[3 * at] ?? 0, table.position[3 * at + 1] ?? 0, table.position[3 * at + 2] ?? 0];
}
