import { laminaPath } from "../../../scene/painting/lamina";
import { LOOKS } from "../../../wire/generated-tables";
import { withNumber } from "../../document/appearance/look-numbers";
import { OF_THE_LEAVES } from "../../document/growth/growth-parameters";
import type { Studio } from "../../studio";
import { numberText } from "../../words/number-text";
import { say } from "../../words/say";
import { Choice } from "../controls/choice";
import { ColourField, hexOf } from "../controls/colour-field";
import { Section } from "../controls/section";
import { standardLooks } from "./architecture/species-list";
import { LookSlider } from "./looks/look-slider";
import { Ends, FlowerSection, FruitSection } from "./looks/ornament-section";
import { ResetAll } from "./looks/reset-all";
import { SeasonButtons, seasonName } from "./looks/season-pictures";
import { SWATCHES } from "./looks/swatches";
import { UnlitNote } from "./looks/unlit-note";
import { ParameterControl } from "./parameter-control";

/** What leaves, flowers and fruits look like, and how many leaves there are. */
export function LeavesPanel({ studio }: { studio: Studio }) {
  const { leaves } = studio.appearance.value;
  const standard = standardLooks(studio).leaves;
  const withTint = (tint: [number, number, number]) => ({ leaves: { tint } });
  return (
    <>
      <UnlitNote studio={studio} />
      <LookSlider
        studio={studio}
        name="leaves.season"
        middle
        inWords={seasonName}
        marks={
          <SeasonButtons
            season={leaves.season}
            pick={(season) => studio.looks.commit(withNumber("leaves.season", season))}
          />
        }
      />
      <Section name="leaves.leaves" title={say("leaves.leaves")} open>
        <Choice
          label={say("leaves.shape")}
          help={say("leaves.shape.help")}
          columns={3}
          value={leaves.shape}
          standard={standard.shape}
          options={LOOKS.leaves.shape.choices.map((value) => ({
            value,
            label: say(`leaves.shape.${value}`),
            picture: (
              <svg viewBox="0 0 40 40" aria-hidden="true">
                <path
                  d={laminaPath(value, 40)}
                  fill={hexOf(leaves.tint)}
                  stroke={hexOf(leaves.tint)}
                  stroke-width="0.8"
                />
              </svg>
            ),
          }))}
          onCommit={(shape) => studio.looks.commit({ leaves: { shape } })}
        />
        <ColourField
          label={say("leaves.tint")}
          help={say("leaves.tint.help")}
          value={leaves.tint}
          standard={standard.tint}
          swatches={SWATCHES.leaves()}
          onDrag={(tint) => studio.looks.drag(withTint(tint))}
          onCommit={(tint) => studio.looks.commit(withTint(tint))}
        />
        {OF_THE_LEAVES.map((parameter) => (
          <ParameterControl key={parameter.name} studio={studio} parameter={parameter} />
        ))}
        <LookSlider studio={studio} name="leaves.vigor_shift" />
        <LookSlider
          studio={studio}
          name="leaves.orientation"
          middle
          inWords={bearingInWords}
          marks={
            <Ends
              ends={[
                say("leaves.orientation.hanging"),
                say("leaves.orientation.spread"),
                say("leaves.orientation.raised"),
              ]}
            />
          }
        />
        <LookSlider studio={studio} name="leaves.blades" />
      </Section>
      <FlowerSection studio={studio} />
      <FruitSection studio={studio} />
      <ResetAll
        studio={studio}
        parts={["leaves", "flowers", "fruits"]}
        parameters={OF_THE_LEAVES.map(({ name }) => name)}
      />
    </>
  );
}

function bearingInWords(orientation: number): string {
  if (Math.abs(orientation) < 0.05) {
    return say("leaves.orientation.spread");
  }
  const word = say(orientation < 0 ? "leaves.orientation.hanging" : "leaves.orientation.raised");
  return `${word}, ${numberText(orientation, 0.1)}`;
}
