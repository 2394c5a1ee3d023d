import type { Signal } from "@preact/signals";
import type { Studio } from "../../studio";
import { type Language, say } from "../../words/say";
import { Check } from "../controls/check";
import { AccountSection } from "./account-section";
import { ServerSection } from "./server-section";

/** Languages by their own names, which need no translation. */
const LANGUAGE_NAMES: Record<Language, string> = { en: "English", de: "Deutsch" };

/** What a person chooses for this device. */
export function SettingsSheet({ studio }: { studio: Studio }) {
  const { language, theme, side, pressureWidens, namesShown, followsGrowth, thorough } = studio.settings;
  return (
    <div class="options">
      <Segments
        legend={say("settings.language")}
        name="language"
        chosen={language}
        choices={[
          [null, say("settings.language.system")],
          ["en", LANGUAGE_NAMES.en],
          ["de", LANGUAGE_NAMES.de],
        ]}
      />
      <Segments
        legend={say("settings.theme")}
        name="theme"
        chosen={theme}
        choices={[
          [null, say("settings.theme.system")],
          ["light", say("settings.theme.light")],
          ["dark", say("settings.theme.dark")],
        ]}
      />
      <Segments
        legend={say("settings.side")}
        name="side"
        chosen={side}
        choices={[
          ["left", say("settings.side.left")],
          ["right", say("settings.side.right")],
        ]}
      />
      <Check label={say("settings.names")} chosen={namesShown} />
      <Check label={say("settings.pressure")} chosen={pressureWidens} />
      <Check label={say("settings.follow")} chosen={followsGrowth} />
      <Check label={say("settings.thorough")} chosen={thorough} />
      <AccountSection studio={studio} />
      <ServerSection studio={studio} />
    </div>
  );
}

interface SegmentsProps<Value> {
  readonly legend: string;
  readonly name: string;
  readonly chosen: Signal<Value>;
  readonly choices: readonly (readonly [Value, string])[];
}

/** A choice of one among a few, side by side. */
function Segments<Value>({ legend, name, chosen, choices }: SegmentsProps<Value>) {
  return (
    <fieldset class="segments stacked">
      <legend>{legend}</legend>
      {choices.map(([value, label]) => (
        <label key={label}>
          <input
            type="radio"
            name={name}
            checked={chosen.value === value}
            onChange={() => {
              chosen.value = value;
            }}
          />
          <span>{label}</span>
        </label>
      ))}
    </fieldset>
  );
}
