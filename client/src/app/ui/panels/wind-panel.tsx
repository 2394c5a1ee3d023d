import { useEffect } from "preact/hooks";
import { type AirName, CALM } from "../../../scene/motion/air-settings";
import type { WindMode } from "../../document/wind/wind-control";
import { windOf } from "../../document/wind/wind-of";
import { PRESET_NAMES, presetOf, WIND_PRESETS } from "../../document/wind/wind-presets";
import type { Studio } from "../../studio";
import { type Key, say } from "../../words/say";
import { ResetIcon } from "../controls/icons";
import { Section } from "../controls/section";
import { LookSlider } from "./looks/look-slider";
import { BreakOffer } from "./wind/break-offer";
import { WindDisc } from "./wind/wind-disc";

/** What the button that holds and lets go says in each mode. */
const MODES: Record<WindMode, Key> = { moving: "wind.hold", held: "wind.let-go", still: "wind.move" };

const AIR = ["speed", "direction", "rise", "turbulence", "flutter"] as const satisfies readonly AirName[];
const WOOD = ["sag", "suppleness", "damping"] as const satisfies readonly AirName[];
const WEATHER = ["snow", "rain"] as const satisfies readonly AirName[];

/** The wind in which trees sway. */
export function WindPanel({ studio }: { studio: Studio }) {
  const wind = windOf(studio);
  const settings = wind.settings.value;
  const preset = presetOf(settings);
  const mode = wind.mode.value;
  useEffect(() => wind.getReady(), [wind]);
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
        {AIR.map((name) => (
          <LookSlider key={name} studio={studio} name={`wind.${name}`} middle={name === "rise"} />
        ))}
        <button
          type="button"
          class="wind-hold"
          aria-pressed={mode === "held"}
          disabled={!wind.toggles}
          title={say("wind.hold.title")}
          onClick={() => wind.toggle()}
        >
          {say(MODES[mode])}
        </button>
        {mode === "still" && <p class="quiet">{say("wind.still")}</p>}
      </Section>
      <Section name="wind.wood" title={say("wind.wood")} open>
        {WOOD.map((name) => (
          <LookSlider key={name} studio={studio} name={`wind.${name}`} />
        ))}
      </Section>
      <Section name="wind.weather" title={say("wind.weather")} open>
        {WEATHER.map((name) => (
          <LookSlider key={name} studio={studio} name={`wind.${name}`} />
        ))}
      </Section>
      <Section name="wind.strength" title={say("wind.strength")} open>
        <BreakOffer studio={studio} />
      </Section>
      <p class="quiet">{say("wind.shared")}</p>
      <p class="quiet">{say("wind.fine")}</p>
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
