import { AIR_NUMBERS, type AirName, blows, CALM } from "../../../scene/motion/air-settings";
import type { WindControl, WindMode } from "../../document/wind/wind-control";
import { windOf } from "../../document/wind/wind-of";
import { PRESET_NAMES, presetOf, WIND_PRESETS } from "../../document/wind/wind-presets";
import type { Studio } from "../../studio";
import { type Key, say } from "../../words/say";
import { ResetIcon } from "../controls/icons";
import { Section } from "../controls/section";
import { Slider } from "../controls/slider";
import { WindDisc } from "./wind/wind-disc";

/** What the button that holds and lets go says in each mode. */
const MODES: Record<WindMode, Key> = { moving: "wind.hold", held: "wind.let-go", still: "wind.move" };

/** The wind in which trees sway. */
export function WindPanel({ studio }: { studio: Studio }) {
  const wind = windOf(studio);
  const settings = wind.settings.value;
  const preset = presetOf(settings);
  const mode = wind.mode.value;
  return (
    <>
      <Section name="wind.air" title={say("wind.air")} open>
        <fieldset class="wind-presets">
          <legend>{say("wind.presets")}</legend>
          {PRESET_NAMES.map((name) => (
            <button
              type="button"
              key={name}
              aria-pressed={name === preset}
              onClick={() => wind.set(WIND_PRESETS[name])}
            >
              {say(`wind.presets.${name}`)}
            </button>
          ))}
        </fieldset>
        <WindDisc studio={studio} wind={wind} />
        <AirSlider wind={wind} name="speed" />
        <AirSlider wind={wind} name="direction" />
        <AirSlider wind={wind} name="turbulence" />
        <AirSlider wind={wind} name="flutter" />
        <button
          type="button"
          class="wind-hold"
          aria-pressed={mode === "held"}
          disabled={!blows(settings)}
          title={say("wind.hold.title")}
          onClick={() => wind.toggle()}
        >
          {say(MODES[mode])}
        </button>
        {mode === "still" && <p class="quiet">{say("wind.still")}</p>}
      </Section>
      <Section name="wind.wood" title={say("wind.wood")} open>
        <AirSlider wind={wind} name="sag" />
        <AirSlider wind={wind} name="suppleness" />
        <AirSlider wind={wind} name="damping" />
      </Section>
      <p class="quiet">{say("wind.local")}</p>
      <button
        type="button"
        class="reset-all"
        disabled={Object.entries(CALM).every(([name, value]) => settings[name as AirName] === value)}
        onClick={() => wind.set(CALM)}
      >
        <ResetIcon />
        {say("controls.reset-all")}
      </button>
    </>
  );
}

/** A slider for one number of the wind. */
function AirSlider({ wind, name }: { wind: WindControl; name: AirName }) {
  const { least, most, step, unit, standard } = AIR_NUMBERS[name];
  return (
    <Slider
      label={say(`wind.${name}`)}
      help={say(`wind.${name}.help`)}
      {...{ least, most, step, unit, standard }}
      value={wind.settings.value[name]}
      onDrag={(value) => wind.set({ [name]: value })}
      onCommit={(value) => wind.set({ [name]: value })}
    />
  );
}
