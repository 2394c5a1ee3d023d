import { useEffect } from "preact/hooks";
import type { GrammarBody } from "../../../../wire/generated";
import type { Grammars } from "../../../document/grammar/grammars-of";
import { outlineOf, surrounds } from "../../../document/grammar/space";
import { asksSpace } from "../../../document/grammar/typed";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { closedPath } from "../../use-animation-frames";

/** The space that a grammar may fill: drawn on the picture, shown, and taken away. */
export function SpaceField({ studio, grammars: { space } }: { studio: Studio; grammars: Grammars }) {
  const inForce = studio.grammar.inForce.value;
  useEffect(() => () => space.stop(), [space]);
  if (inForce === null) {
    return null;
  }
  const { within, text, at } = inForce;
  if (space.drawing.value) {
    return (
      <div class="grammar-space" data-drawing>
        <p class="grammar-space-how" role="status">
          {say("grammars.space.how")}
        </p>
        <button type="button" class="small" onClick={() => space.stop()}>
          {say("grammars.space.cancel")}
        </button>
      </div>
    );
  }
  const asks = asksSpace(text);
  return (
    <div class="grammar-space">
      {!asks && within === null && <p class="quiet advice">{say("grammars.space.unasked")}</p>}
      {!asks && within !== null && <p class="advice">{say("grammars.space.in-vain")}</p>}
      {asks && within !== null && !surrounds(within, at) && (
        <p class="advice" role="status">
          {say("grammars.space.seed-outside")}
        </p>
      )}
      {(asks || within !== null) && (
        <p class="grammar-acts">
          {asks && (
            <button type="button" class="small" title={say("grammars.space.help")} onClick={() => space.draw()}>
              {say(within === null ? "grammars.space.draw" : "grammars.space.again")}
            </button>
          )}
          {within !== null && (
            <button type="button" class="small" onClick={() => space.clear()}>
              {say("grammars.space.clear")}
            </button>
          )}
        </p>
      )}
    </div>
  );
}

/** Shows the space over the picture while the panel is open. */
export function useSpaceShown(studio: Studio): void {
  const within = studio.grammar.inForce.value?.within ?? null;
  useEffect(() => (within === null ? undefined : showSpace(studio, within)), [studio, within]);
}

const SVG = "http://www.w3.org/2000/svg";

function showSpace(studio: Studio, within: GrammarBody): () => void {
  const layer = document.createElementNS(SVG, "svg");
  layer.setAttribute("class", "overlay outline grammar-space-outline");
  layer.setAttribute("aria-hidden", "true");
  const path = layer.appendChild(document.createElementNS(SVG, "path"));
  path.setAttribute("class", "outline-closing");
  document.querySelector("main.workspace canvas")?.after(layer);
  const places = outlineOf(within);
  let frame = 0;
  const follow = () => {
    frame = requestAnimationFrame(follow);
    const project = studio.stage.projector();
    const seen = places.flatMap((place) => {
      const at = project?.(place);
      return at ? [at] : [];
    });
    path.setAttribute("d", closedPath(seen.length === places.length ? seen : []));
  };
  follow();
  return () => {
    cancelAnimationFrame(frame);
    layer.remove();
  };
}
