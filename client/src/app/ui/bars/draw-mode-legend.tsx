import { useState } from "preact/hooks";
import type { Legend } from "../../../scene/mode/draw-mode";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { CloseIcon } from "../icons";
import { useAnimationFrames } from "../use-animation-frames";

/** What is to be learnt from a draw mode, and what its colours mean; nothing while the tree is simply lit. */
export function DrawModeLegend({ studio }: { studio: Studio }) {
  const mode = studio.drawMode.value;
  const [legend, setLegend] = useState<Legend | null>(null);
  // The range follows the tree, which is brought up to date frame by frame.
  useAnimationFrames(mode !== "lit", () => {
    const now = studio.stage.legend();
    if (now?.mode !== legend?.mode || now?.range[0] !== legend?.range[0] || now?.range[1] !== legend?.range[1]) {
      setLegend(now);
    }
  });
  if (mode === "lit") {
    return null;
  }
  return (
    <section class="panel legend" aria-label={say(`drawmode.${mode}`)}>
      <header>
        <h2>{say(`drawmode.${mode}`)}</h2>
        <button
          type="button"
          class="tool"
          aria-label={say("drawmode.back")}
          title={say("drawmode.back")}
          onClick={() => {
            studio.drawMode.value = "lit";
          }}
        >
          <CloseIcon />
        </button>
      </header>
      {legend?.mode === mode && <Ramp legend={legend} />}
      <p>{say(`drawmode.${mode}.lesson`)}</p>
    </section>
  );
}

function Ramp({ legend }: { legend: Legend }) {
  const [low, high] = endsOf(legend);
  return (
    <div class="ramp">
      <i style={{ background: `linear-gradient(to right, ${legend.colours.join(", ")})` }} />
      <span>{low}</span>
      <span>{high}</span>
    </div>
  );
}

/** The ramp's ends in words. */
export function endsOf({ mode, range: [, high] }: Legend): readonly [low: string, high: string] {
  switch (mode) {
    case "exposure":
      return [say("drawmode.end.shade"), say("drawmode.end.light")];
    case "vigor":
      return [say("drawmode.end.weak"), say("drawmode.end.strong")];
    case "age":
      return [say("drawmode.end.young"), say(high === 1 ? "drawmode.end.step" : "drawmode.end.steps", { count: high })];
    default:
      return [say("drawmode.end.trunk"), String(high)];
  }
}
