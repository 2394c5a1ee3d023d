import type { Studio } from "../../studio";
import { LEAST_AROUND, MOST_AROUND, OFF, SYMMETRY_KINDS, type Symmetry } from "../../tools/symmetry/symmetry";
import { say } from "../../words/say";
import { Choice } from "../controls/choice";
import { Slider } from "../controls/slider";
import { Switch } from "../controls/switch";

/** How strokes and outlines are repeated about the trunk. */
export function SymmetryFields({ studio }: { studio: Studio }) {
  const { symmetry } = studio.settings;
  const { kind, around, mirrored } = symmetry.value;
  const set = (change: Partial<Symmetry>) => {
    symmetry.value = { ...symmetry.peek(), ...change };
  };
  return (
    <>
      <Choice
        label={say("brush.symmetry")}
        help={say("brush.symmetry.help")}
        options={SYMMETRY_KINDS.map((value) => ({ value, label: say(`brush.symmetry.${value}`) }))}
        value={kind}
        standard={OFF.kind}
        onCommit={(kind) => set({ kind })}
      />
      {kind === "around" && (
        <>
          <Slider
            label={say("brush.around")}
            help={say("brush.around.help")}
            least={LEAST_AROUND}
            most={MOST_AROUND}
            step={1}
            value={around}
            standard={OFF.around}
            onDrag={(around) => set({ around })}
            onCommit={(around) => set({ around })}
          />
          <Switch
            label={say("brush.around-mirrored")}
            help={say("brush.around-mirrored.help")}
            value={mirrored}
            standard={OFF.mirrored}
            onCommit={(mirrored) => set({ mirrored })}
          />
        </>
      )}
    </>
  );
}
