import { BOUNDS } from "../../../wire/generated";
import { DEFAULTS, OF_THE_BRUSH } from "../../document/growth/growth-parameters";
import type { Studio } from "../../studio";
import { MAX_RADIUS, MIN_BRUSH, placeOf, radiusAt, radiusLabel } from "../../tools/brush/brush-radius";
import { say } from "../../words/say";
import { Field } from "../controls/field";
import { Section } from "../controls/section";
import { Slider } from "../controls/slider";
import { Switch } from "../controls/switch";
import { TypedNumber } from "../controls/typed-number";
import { useSpecies } from "./architecture/species-list";
import { BrushPicture } from "./brush-picture";
import { ParameterControl } from "./parameter-control";
import { SymmetryFields } from "./symmetry-fields";

/** What the brush is like, what its strokes do, and which branches follow it (TreeSketch §3.2). */
export function BrushPanel({ studio }: { studio: Studio }) {
  const { settings } = studio;
  // Its resets go back to what the species has.
  useSpecies(studio);
  const bud = studio.bud.row.value;
  return (
    <div class="brush-panel">
      <div class="brush-head">
        <BrushPicture studio={studio} />
        <p class="brush-does" role="status">
          {say(`brush.does.${deedOf(studio)}`)}
        </p>
      </div>
      <div>
        <RadiusField studio={studio} />
        <Switch
          label={say("brush.pressure")}
          help={say("brush.pressure.help")}
          value={settings.pressureWidens.value}
          standard={true}
          onCommit={(on) => {
            settings.pressureWidens.value = on;
          }}
        />
        <Section name="brush.stroke" title={say("brush.section.stroke")} open>
          {OF_THE_BRUSH.map((parameter) => (
            <ParameterControl studio={studio} parameter={parameter} key={parameter.name} />
          ))}
        </Section>
        <Section name="brush.branches" title={say("brush.section.branches")} open>
          <div class="brush-bud" data-chosen={bud !== null}>
            <p role="status">{say(bud === null ? "brush.all-grow" : "brush.one-grows")}</p>
            {bud === null ? (
              <p class="quiet">{say("brush.all-grow.how")}</p>
            ) : (
              <button type="button" class="primary" onClick={() => studio.bud.release()}>
                {say("brush.release")}
              </button>
            )}
          </div>
        </Section>
        <Section name="brush.symmetry" title={say("brush.section.symmetry")} open>
          <SymmetryFields studio={studio} />
        </Section>
        <Section name="brush.lasso" title={say("brush.section.lasso")} open>
          <Slider
            label={say("brush.lasso-depth")}
            help={say("brush.lasso-depth.help")}
            {...BOUNDS.Depth}
            step={0.05}
            value={settings.lassoDepth.value}
            standard={BOUNDS.Depth.most}
            onDrag={(depth) => {
              settings.lassoDepth.value = depth;
            }}
            onCommit={(depth) => {
              settings.lassoDepth.value = depth;
            }}
          />
        </Section>
      </div>
    </div>
  );
}

/** What a brush as wide as this does: as wide as a bud's own zone it still leads one limb. */
function deedOf(studio: Studio): "sketch" | "narrow" | "wide" {
  const { radius } = studio.stage;
  return radius === 0 ? "sketch" : radius <= zoneIn(studio) ? "narrow" : "wide";
}

const zoneIn = (studio: Studio): number => (studio.parameters.value ?? DEFAULTS).occupancy_radius;

/** How many stops the slider has. */
const STOPS = 200;

function RadiusField({ studio }: { studio: Studio }) {
  const { radius } = studio.stage;
  const widest = studio.stage.widest.value;
  const [place, zone] = [placeOf(radius, widest), zoneIn(studio)];
  const label = say("brush.radius");
  const shown = radius === 0 ? say("bars.radius.sketch") : say("bars.radius.value", { radius: radiusLabel(radius) });
  return (
    <Field
      label={label}
      help={say("brush.radius.help")}
      onReset={radius === USUAL ? undefined : () => studio.stage.setRadius(USUAL)}
      end={
        <TypedNumber
          label={label}
          unit=""
          least={0}
          most={MAX_RADIUS}
          step={0.1}
          value={radius}
          // What is narrower than any brush sketches.
          onCommit={(to) => studio.stage.setRadius(to < MIN_BRUSH / 2 ? 0 : Math.max(MIN_BRUSH, to))}
        />
      }
    >
      {(description) => (
        <div class="slider">
          <input
            type="range"
            aria-label={label}
            aria-describedby={description}
            aria-valuetext={shown}
            min={0}
            max={STOPS}
            step={1}
            value={Math.round(place * STOPS)}
            style={{ "--place": place }}
            onInput={(event) => studio.stage.setRadius(radiusAt(Number(event.currentTarget.value) / STOPS, widest))}
          />
          <div
            class="brush-zones"
            aria-hidden="true"
            style={{ "--narrow": placeOf(MIN_BRUSH, widest), "--wide": placeOf(zone, widest) }}
          >
            {(["sketch", "narrow", "wide"] as const).map((deed) => (
              <span key={deed} data-now={deed === deedOf(studio)} />
            ))}
          </div>
          <div class="slider-marks" aria-hidden="true">
            <span>{say("brush.sketch")}</span>
            <span>{say("brush.brush")}</span>
          </div>
        </div>
      )}
    </Field>
  );
}

/** The radius a new page begins with, in internodes. */
const USUAL = 4;
