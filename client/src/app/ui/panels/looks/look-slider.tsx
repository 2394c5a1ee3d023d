import type { ComponentChildren } from "preact";
import { LOOK_NUMBERS, type LookNumber, numberIn, withNumber } from "../../../document/appearance/look-numbers";
import { unitOf } from "../../../document/growth/growth-parameters";
import type { Studio } from "../../../studio";
import { say } from "../../../words/say";
import { Slider } from "../../controls/slider";
import { standardLooks } from "../architecture/species-list";

interface LookSliderProps {
  readonly studio: Studio;
  readonly name: LookNumber;
  readonly inWords?: (value: number) => string;
  readonly marks?: ComponentChildren;
  /** A scale whose middle is where nothing is done has no part to fill. */
  readonly middle?: boolean;
}

/** A slider for one number of the appearance. */
export function LookSlider({ studio, name, inWords, marks, middle = false }: LookSliderProps) {
  const { least, most, step } = LOOK_NUMBERS[name];
  const patch = (value: number) => withNumber(name, value);
  return (
    <Slider
      label={say(`${name}`)}
      help={say(`${name}.help`)}
      {...{ least, most, step, marks }}
      unit={unitOf(LOOK_NUMBERS[name])}
      {...(inWords ? { inWords } : {})}
      {...(middle ? { track: "middle" } : {})}
      value={numberIn(studio.appearance.value, name)}
      standard={numberIn(standardLooks(studio), name)}
      onDrag={(value) => studio.looks.drag(patch(value))}
      onCommit={(value) => studio.looks.commit(patch(value))}
    />
  );
}
