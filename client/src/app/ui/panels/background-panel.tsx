import { DEFAULT_APPEARANCE } from "../../../wire/generated";
import { LOOKS } from "../../../wire/generated-tables";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { Choice } from "../controls/choice";
import { ColourField } from "../controls/colour-field";
import { Section } from "../controls/section";
import { Switch } from "../controls/switch";
import { ResetAll } from "./looks/reset-all";
import { GroundPicture, SkyPicture } from "./looks/scenery-pictures";
import { SunDial } from "./looks/sun-dial";
import { SWATCHES } from "./looks/swatches";
import { UnlitNote } from "./looks/unlit-note";

/** What surrounds the tree: sky, ground and sun. */
export function BackgroundPanel({ studio }: { studio: Studio }) {
  const { sky, ground, backdrop } = studio.appearance.value.background;
  const standard = DEFAULT_APPEARANCE.background;
  const patch = (fields: Partial<typeof standard>) => ({ background: fields });
  return (
    <>
      <UnlitNote studio={studio} />
      <Section name="background.sun" title={say("background.sun")} open>
        <SunDial studio={studio} />
        <Switch
          label={say("background.pin")}
          help={say("background.pin.help")}
          value={studio.sunPinned.value}
          standard={false}
          onCommit={(pinned) => {
            studio.sunPinned.value = pinned;
          }}
        />
      </Section>
      <Section name="background.surroundings" title={say("background.surroundings")} open>
        <Choice
          label={say("background.sky")}
          help={say("background.sky.help")}
          columns={4}
          value={sky}
          standard={standard.sky}
          options={LOOKS.background.sky.choices.map((value) => ({
            value,
            label: say(`background.sky.${value}`),
            picture: <SkyPicture sky={value} backdrop={backdrop} />,
          }))}
          onCommit={(value) => studio.looks.commit(patch({ sky: value }))}
        />
        {sky === "studio" && (
          <ColourField
            label={say("background.backdrop")}
            help={say("background.backdrop.help")}
            value={backdrop}
            standard={standard.backdrop}
            swatches={SWATCHES.backdrop()}
            onDrag={(colour) => studio.looks.drag(patch({ backdrop: colour }))}
            onCommit={(colour) => studio.looks.commit(patch({ backdrop: colour }))}
          />
        )}
        <Choice
          label={say("background.ground")}
          help={say("background.ground.help")}
          columns={5}
          value={ground}
          standard={standard.ground}
          options={LOOKS.background.ground.choices.map((value) => ({
            value,
            label: say(`background.ground.${value}`),
            picture: <GroundPicture ground={value} />,
          }))}
          onCommit={(value) => studio.looks.commit(patch({ ground: value }))}
        />
      </Section>
      <ResetAll studio={studio} parts={["background"]} />
    </>
  );
}
