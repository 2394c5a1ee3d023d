import { type GrowthParameter, helpOf, nameOf } from "../../document/growth/growth-parameters";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { Choice } from "../controls/choice";
import { Switch } from "../controls/switch";
import { standardOf } from "./architecture/species-list";
import { ParameterSlider } from "./parameter-slider";

interface ParameterControlProps {
  readonly studio: Studio;
  readonly parameter: GrowthParameter;
}

/** The control for one parameter of growth; nothing where it has no effect as things are. */
export function ParameterControl({ studio, parameter }: ParameterControlProps) {
  const now = studio.parameters.value;
  const standard = standardOf(studio);
  if (now === null || parameter.applies?.(now) === false) {
    return null;
  }
  switch (parameter.kind) {
    case "number":
      return <ParameterSlider studio={studio} parameter={parameter} />;
    case "switch":
      return (
        <Switch
          label={nameOf(parameter)}
          help={helpOf(parameter)}
          value={now[parameter.name]}
          standard={standard[parameter.name]}
          onCommit={(value) => studio.growing.commit({ [parameter.name]: value })}
        />
      );
    case "choice":
      return (
        <Choice
          label={nameOf(parameter)}
          help={helpOf(parameter)}
          options={parameter.choices.map((value) => ({ value, label: say(`parameters.${parameter.name}.${value}`) }))}
          value={now[parameter.name]}
          standard={standard[parameter.name]}
          onCommit={(value) => studio.growing.commit({ [parameter.name]: value })}
        />
      );
  }
}
