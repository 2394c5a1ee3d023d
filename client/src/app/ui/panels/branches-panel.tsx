import { LOOKS } from "../../../wire/generated-tables";
import { NUMBERS } from "../../document/growth/growth-parameters";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { Choice } from "../controls/choice";
import { ColourField } from "../controls/colour-field";
import { Section } from "../controls/section";
import { standardLooks } from "./architecture/species-list";
import { BarkPicture } from "./looks/bark-picture";
import { LookSlider } from "./looks/look-slider";
import { ResetAll } from "./looks/reset-all";
import { SWATCHES } from "./looks/swatches";
import { UnlitNote } from "./looks/unlit-note";
import { ParameterSlider } from "./parameter-slider";

/** What wood looks like, and how thick it grows. */
export function BranchesPanel({ studio }: { studio: Studio }) {
  const { bark } = studio.appearance.value;
  const standard = standardLooks(studio).bark;
  const withTint = (tint: [number, number, number]) => ({ bark: { tint } });
  return (
    <>
      <UnlitNote studio={studio} />
      <Section name="branches.bark" title={say("branches.bark")} open>
        <Choice
          label={say("bark.kind")}
          help={say("bark.kind.help")}
          columns={4}
          value={bark.kind}
          standard={standard.kind}
          options={LOOKS.bark.kind.choices.map((value) => ({
            value,
            label: say(`bark.kind.${value}`),
            picture: <BarkPicture kind={value} tint={bark.tint} />,
          }))}
          onCommit={(kind) => studio.looks.commit({ bark: { kind } })}
        />
        <ColourField
          label={say("bark.tint")}
          help={say("bark.tint.help")}
          value={bark.tint}
          standard={standard.tint}
          swatches={SWATCHES.bark()}
          onDrag={(tint) => studio.looks.drag(withTint(tint))}
          onCommit={(tint) => studio.looks.commit(withTint(tint))}
        />
        <LookSlider studio={studio} name="bark.relief" />
      </Section>
      <Section name="branches.form" title={say("branches.form")} open>
        <LookSlider studio={studio} name="bark.root_flare" />
        <LookSlider studio={studio} name="bark.collar" />
        <LookSlider studio={studio} name="bark.smoothing" />
      </Section>
      <Section name="branches.girth" title={say("branches.girth")} open>
        <ParameterSlider studio={studio} parameter={NUMBERS.girth_exponent} />
        <ParameterSlider studio={studio} parameter={NUMBERS.twig_diameter} />
      </Section>
      <ResetAll studio={studio} parts={["bark"]} parameters={["girth_exponent", "twig_diameter"]} />
    </>
  );
}
