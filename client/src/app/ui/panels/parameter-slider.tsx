import {
  DEFAULTS,
  helpOf,
  type NumberParameter,
  nameOf,
  patchFor,
  unitOf,
} from "../../document/growth/growth-parameters";
import type { Studio } from "../../studio";
import { Slider } from "../controls/slider";
import { standardOf } from "./architecture/species-list";

interface ParameterSliderProps {
  readonly studio: Studio;
  readonly parameter: NumberParameter;
}

/** A slider for one number that trees grow by. */
export function ParameterSlider({ studio, parameter }: ParameterSliderProps) {
  const { name, symbol, least, most, step, travel } = parameter;
  const now = studio.parameters.value;
  const patch = (value: number) => patchFor(name, value, now ?? DEFAULTS);
  return (
    <Slider
      label={nameOf(parameter)}
      symbol={symbol}
      unit={unitOf(parameter)}
      help={helpOf(parameter)}
      {...{ least, most, step, travel }}
      value={now?.[name] ?? DEFAULTS[name]}
      standard={standardOf(studio)[name]}
      disabled={now === null}
      onDrag={(value) => studio.growing.drag(patch(value))}
      onCommit={(value) => studio.growing.commit(patch(value))}
    />
  );
}
