import { colourBy, type Factors, factorsOf } from "../../../document/design/dyes";
import { type Key, say } from "../../../words/say";
import { type Colour, ColourField, type Swatch } from "../../controls/colour-field";

/** Colours of bark and leaves as multiples of the document's, in linear light. */
export interface MaterialValue {
  readonly bark: Factors;
  readonly leaves: Factors;
}

/** What the tree looks like without a material. */
export interface BaseColours {
  readonly bark: Readonly<Colour>;
  readonly leaves: Readonly<Colour>;
}

interface MaterialEditorProps {
  readonly label: string;
  readonly help: string;
  readonly value: MaterialValue;
  readonly inherited: MaterialValue;
  readonly base: BaseColours;
  readonly onDrag: (value: MaterialValue) => void;
  readonly onCommit: (value: MaterialValue) => void;
}

const DYES: readonly (readonly [Key, Factors])[] = [
  ["structure.dye.none", [1, 1, 1]],
  ["structure.dye.light", [1.7, 1.7, 1.7]],
  ["structure.dye.dark", [0.5, 0.5, 0.5]],
  ["structure.dye.red", [1.8, 0.7, 0.6]],
  ["structure.dye.golden", [1.8, 1.25, 0.5]],
  ["structure.dye.grey", [1, 1.05, 1.4]],
];

/** The colours of bark and leaves of a branch: dyes that suit, or any colour. */
export function MaterialEditor({ label, help, value, inherited, base, onDrag, onCommit }: MaterialEditorProps) {
  const field = (of: "bark" | "leaves") => {
    const put = (colour: Readonly<Colour>): MaterialValue => ({ ...value, [of]: factorsOf(base[of], colour) });
    const swatches: readonly Swatch[] = DYES.map(([name, factors]) => ({
      colour: colourBy(base[of], factors),
      label: say(name),
    }));
    return (
      <ColourField
        label={say(`structure.material.${of}`)}
        help={help}
        value={colourBy(base[of], value[of])}
        standard={colourBy(base[of], inherited[of])}
        swatches={swatches}
        onDrag={(colour) => onDrag(put(colour))}
        onCommit={(colour) => onCommit(put(colour))}
      />
    );
  };
  return (
    <div class="structure-material">
      <div class="structure-label" title={help}>
        {label}
      </div>
      {field("bark")}
      {field("leaves")}
    </div>
  );
}
