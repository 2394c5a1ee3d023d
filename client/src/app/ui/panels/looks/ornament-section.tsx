import type { ComponentChildren } from "preact";
import { LOOKS } from "../../../../wire/generated-tables";
import type { Studio } from "../../../studio";
import { numberText } from "../../../words/number-text";
import { say } from "../../../words/say";
import { Choice } from "../../controls/choice";
import { ColourField } from "../../controls/colour-field";
import { Section } from "../../controls/section";
import { standardLooks } from "../architecture/species-list";
import { LookSlider } from "./look-slider";
import { FlowerPicture, FruitPicture, PlacePicture } from "./ornament-pictures";
import { SWATCHES } from "./swatches";

/** The flowers: their kind and, if there are any, all about them. */
export function FlowerSection({ studio }: { studio: Studio }) {
  const { kind, tint } = studio.appearance.value.flowers;
  return (
    <Section name="leaves.flowers" title={say("leaves.flowers")}>
      <Choice
        label={say("flowers.kind")}
        help={say("flowers.kind.help")}
        columns={4}
        value={kind}
        standard={standardLooks(studio).flowers.kind}
        options={LOOKS.flowers.kind.choices.map((value) => ({
          value,
          label: say(`flowers.kind.${value}`),
          picture: <FlowerPicture kind={value} tint={tint} />,
        }))}
        onCommit={(value) => studio.looks.commit({ flowers: { kind: value } })}
      />
      {kind !== "none" && <Borne studio={studio} part="flowers" />}
    </Section>
  );
}

/** The fruits, as the flowers. */
export function FruitSection({ studio }: { studio: Studio }) {
  const { kind, tint } = studio.appearance.value.fruits;
  return (
    <Section name="leaves.fruits" title={say("leaves.fruits")}>
      <Choice
        label={say("fruits.kind")}
        help={say("fruits.kind.help")}
        columns={5}
        value={kind}
        standard={standardLooks(studio).fruits.kind}
        options={LOOKS.fruits.kind.choices.map((value) => ({
          value,
          label: say(`fruits.kind.${value}`),
          picture: <FruitPicture kind={value} tint={tint} />,
        }))}
        onCommit={(value) => studio.looks.commit({ fruits: { kind: value } })}
      />
      {kind !== "none" && <Borne studio={studio} part="fruits" />}
    </Section>
  );
}

/** What flowers and fruits have in common: colour, size, number, and where they are borne. */
function Borne({ studio, part }: { studio: Studio; part: "flowers" | "fruits" }) {
  const now = studio.appearance.value[part];
  const standard = standardLooks(studio)[part];
  const withTint = (tint: [number, number, number]) => ({ [part]: { tint } });
  return (
    <>
      <ColourField
        label={say(`${part}.tint`)}
        help={say(`${part}.tint.help`)}
        value={now.tint}
        standard={standard.tint}
        swatches={SWATCHES[part]()}
        onDrag={(tint) => studio.looks.drag(withTint(tint))}
        onCommit={(tint) => studio.looks.commit(withTint(tint))}
      />
      <LookSlider studio={studio} name={`${part}.size`} />
      <LookSlider studio={studio} name={`${part}.share`} />
      <Choice
        label={say(`${part}.place`)}
        help={say(`${part}.place.help`)}
        columns={3}
        value={now.place}
        standard={standard.place}
        options={LOOKS[part].place.choices.map((value) => ({
          value,
          label: say(`leaves.place.${value}`),
          picture: <PlacePicture place={value} tint={now.tint} />,
        }))}
        onCommit={(place) => studio.looks.commit({ [part]: { place } })}
      />
      <LookSlider
        studio={studio}
        name={`${part}.vigor`}
        middle
        inWords={vigorInWords}
        marks={<Ends ends={[say("leaves.vigor.weak"), say("leaves.vigor.all"), say("leaves.vigor.strong")]} />}
      />
    </>
  );
}

/** Words under a slider: its least end, its middle, its most. */
export function Ends({ ends }: { ends: readonly [string, string, string] }): ComponentChildren {
  return ends.map((end) => <span key={end}>{end}</span>);
}

function vigorInWords(vigor: number): string {
  if (Math.abs(vigor) < 0.05) {
    return say("leaves.vigor.all");
  }
  return `${say(vigor < 0 ? "leaves.vigor.weak" : "leaves.vigor.strong")}, ${numberText(vigor, 0.1)}`;
}
