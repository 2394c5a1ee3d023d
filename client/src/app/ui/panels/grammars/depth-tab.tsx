import { useEffect } from "preact/hooks";
import type { GrammarSlider } from "../../../../wire/generated";
import type { Grammars } from "../../../document/grammar/grammars-of";
import { bars, deepest, internodesAt, type Sizes } from "../../../document/grammar/sizes";
import { stepFor } from "../../../document/grammar/slider-step";
import { hasChance, isName } from "../../../document/grammar/typed";
import type { Studio } from "../../../studio";
import { endText } from "../../../words/grammar-problems";
import { countText } from "../../../words/measure-text";
import { say } from "../../../words/say";
import { Slider } from "../../controls/slider";
import { Refusal } from "./refusal";
import { SpaceField } from "./space-field";

const NOTHING: Sizes = { sizes: [], ends: null, depth: null };
/** So many bars of sizes stand side by side at most. */
const BARS = 24;

interface DepthProps {
  readonly studio: Studio;
  readonly grammars: Grammars;
}

/** How deep the grammar in force is derived, how large it becomes, and its sliders. */
export function DepthTab({ studio, grammars }: DepthProps) {
  const { editing } = grammars;
  const inForce = studio.grammar.inForce.value;
  const refused = editing.refused.value;
  if (inForce === null) {
    return (
      <>
        <Refusal studio={studio} editing={editing} />
        <p class="quiet advice">{say("grammars.none")}</p>
      </>
    );
  }
  return (
    <>
      <Refusal studio={studio} editing={editing} />
      {refused === null && !editing.isPlanted.value && editing.text.value.trim() !== "" && (
        <p class="advice" role="status">
          {say("grammars.depth.ahead")}
        </p>
      )}
      {inForce.title && isName(inForce.title) && <h3 class="grammar-title">{inForce.title}</h3>}
      <DepthField studio={studio} grammars={grammars} />
      {inForce.ends !== null && refused === null && (
        <p class="advice" role="status">
          {say("grammars.depth.stopped", { depth: inForce.depth, why: endText(inForce.ends) })}
        </p>
      )}
      {inForce.edited && <p class="quiet advice">{say("grammars.depth.edited")}</p>}
      {inForce.sliders.map((slider) => (
        <ValueSlider key={slider.name} slider={slider} editing={editing} />
      ))}
      {inForce.sliders.length === 0 && <p class="quiet advice">{say("grammars.no-sliders")}</p>}
      <SpaceField studio={studio} grammars={grammars} />
      {hasChance(inForce.text) && (
        <button
          type="button"
          class="small"
          title={say("grammars.seed.title")}
          onClick={() => editing.sow(Math.floor(Math.random() * 2 ** 32))}
        >
          {say("grammars.seed")}
        </button>
      )}
    </>
  );
}

function DepthField({ studio, grammars: { editing, depth } }: DepthProps) {
  const sized = editing.sized.value;
  const sizes = sized !== null && sized.of === studio.grammar.inForce.value?.text ? sized.report : NOTHING;
  useEffect(() => editing.look(), [editing]);
  const shown = depth.shown.value;
  const most = deepest(sizes, shown);
  const known = sizes.sizes.length - 1;
  return (
    <div class="grammar-depth">
      <Slider
        label={say("grammars.depth")}
        help={say("grammars.depth.help")}
        least={0}
        most={most}
        step={1}
        value={shown}
        standard={Math.min(sizes.depth ?? shown, most)}
        inWords={(at) => sizeText(sizes, at)}
        marks={
          sizes.sizes.length > 0 && (
            <span class="grammar-bars">
              {bars(sizes, most, BARS).map(({ depth: at, height }) => (
                <button
                  type="button"
                  key={at}
                  aria-label={say("grammars.depth.bar", { depth: at })}
                  data-now={at === shown}
                  data-beyond={sizes.ends !== null && at > known}
                  onClick={() => depth.commit(at)}
                >
                  <i style={{ height: `${8 + 92 * height}%` }} />
                </button>
              ))}
            </span>
          )
        }
        onDrag={(to) => depth.drag(to)}
        onCommit={(to) => depth.commit(to)}
      />
      <p class="grammar-size" role="status">
        {sizeText(sizes, shown)}
        {sizes.ends !== null && most >= known && known >= 0 && (
          <span class="quiet"> {say("grammars.depth.ends", { depth: known, why: endText(sizes.ends) })}</span>
        )}
      </p>
    </div>
  );
}

function sizeText(sizes: Sizes, depth: number): string {
  const size = internodesAt(sizes, depth);
  return size === null
    ? say("grammars.depth.now", { depth })
    : say(size.isGuess ? "grammars.depth.guess" : "grammars.depth.size", { depth, count: countText(size.count) });
}

function ValueSlider({ slider, editing }: { slider: GrammarSlider; editing: Grammars["editing"] }) {
  const { name, from, to, value } = slider;
  return (
    <Slider
      label={name}
      help={say("grammars.slider.help", { name, from, to })}
      least={from}
      most={to}
      step={stepFor(from, to, value)}
      value={editing.values.value.value[name] ?? value}
      standard={value}
      onDrag={(to) => editing.values.drag({ [name]: to })}
      onCommit={(to) => editing.values.commit({ [name]: to })}
    />
  );
}
