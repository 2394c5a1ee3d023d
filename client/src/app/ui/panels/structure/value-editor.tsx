import type { ComponentChildren } from "preact";
import type { Curve } from "../../../document/design/curve-points";
import type { DesignEditing } from "../../../document/design/design-editing";
import type { DesignKey, KeyName, Resolved, Status } from "../../../document/design/design-model";
import { isPoints } from "../../../document/design/function-course";
import { isRelation, relativeRange } from "../../../document/design/relative-values";
import { type Key, say } from "../../../words/say";
import { Slider } from "../../controls/slider";
import { Switch } from "../../controls/switch";
import type { Scale } from "../../controls/travel";
import { CurveEditor } from "./curve-editor";
import { FunctionEditor } from "./function-editor";
import { type BaseColours, MaterialEditor, type MaterialValue } from "./material-editor";
import { type EnvelopeValue, OutlineEditor } from "./outline-editor";

/** The part of a wide range that trees have, which gets most of a slider. */
const TRAVEL: Partial<Record<KeyName, readonly [number, number]>> = {
  height: [10, 150],
  stem: [0.2, 5],
  reach: [0.3, 1.7],
  turn: [-90, 90],
  roll: [-90, 90],
  pull: [-2, 2],
  leaf_size: [0.2, 3],
  density: [0, 40],
  branching_angle: [0, 120],
  taper: [0, 1.1],
  leaves: [0, 10],
};

export interface ValueProps {
  readonly editing: DesignEditing;
  readonly of: DesignKey;
  readonly resolved: Resolved;
  /** The colours of the tree as a whole. */
  readonly colours: BaseColours;
}

/** What a slider moves of a value: the whole, or what is said relative to the inherited one. */
function ownOf({ status, setting, value }: Resolved): unknown {
  if (status === "offset") {
    return setting?.add;
  }
  return status === "factor" ? setting?.multiply : value;
}

function rangeOf(of: DesignKey, status: Status): Omit<Scale, "step"> {
  if (!isRelation(status)) {
    return { least: of.least, most: of.most, travel: TRAVEL[of.name] };
  }
  return { ...relativeRange(of, status), ...(status === "factor" ? { travel: [0, 2] } : {}) };
}

/** What changes one value of a branch, by its kind. */
export function ValueEditor({ editing, of, resolved, colours }: ValueProps) {
  const label = say(`structure.key.${of.name}`);
  const help = say(`structure.key.${of.name}.help`);
  const own = ownOf(resolved);
  const range = rangeOf(of, resolved.status);
  const back = () => editing.say(of, "inherited");
  const slider = (props: Part): ComponentChildren => (
    <Slider
      key={props.label}
      label={props.label}
      help={help}
      unit={unitOf(of)}
      {...range}
      step={of.kind === "whole" ? 1 : stepOf(range.most - range.least)}
      value={props.value}
      standard={props.standard}
      onDrag={(value) => editing.drag(of, props.whole(value))}
      onReset={back}
      onCommit={(value) => editing.commit(of, props.whole(value))}
    />
  );
  if (typeof own === "number") {
    const standard = typeof resolved.inherited === "number" ? resolved.inherited : own;
    if (of.kind === "whole" && of.most === 1) {
      return (
        <Switch
          label={label}
          help={help}
          value={own === 1}
          standard={standard === 1}
          onCommit={(value) => (value === (standard === 1) ? back() : editing.commit(of, value ? 1 : 0))}
        />
      );
    }
    return slider({ label, value: own, standard, whole: (value) => value });
  }
  if (of.kind === "function" && isPoints(own)) {
    const { inherited, status } = resolved;
    const relation = isRelation(status) ? status : null;
    const [least, most] = TRAVEL[of.name] ?? [0, 0];
    const usual = { least, most };
    return (
      <FunctionEditor
        label={label}
        help={help}
        unit={unitOf(of)}
        own={{ points: own, range, usual }}
        relative={relation && isPoints(inherited) ? { relation, inherited, of: { range: of, usual } } : null}
        onDrag={(points) => editing.drag(of, points)}
        onCommit={(points) => editing.commit(of, points)}
        onCancel={() => editing.undrag(of)}
      />
    );
  }
  if (of.kind === "curve") {
    return (
      <CurveEditor
        label={label}
        help={help}
        value={own as Curve}
        inherited={resolved.status === "inherited" ? null : (resolved.inherited as Curve)}
        onDrag={(points) => editing.drag(of, points)}
        onCommit={(points) => editing.commit(of, points)}
        onCancel={() => editing.undrag(of)}
      />
    );
  }
  if (of.kind === "material") {
    return (
      <MaterialEditor
        label={label}
        help={help}
        value={own as MaterialValue}
        inherited={resolved.inherited as MaterialValue}
        base={colours}
        onDrag={(value) => editing.drag(of, value)}
        onCommit={(value) => editing.commit(of, value)}
      />
    );
  }
  if (of.kind === "envelope") {
    return (
      <OutlineEditor
        label={label}
        help={help}
        value={own as EnvelopeValue | null}
        onDrag={(value) => editing.drag(of, value)}
        onCommit={(value) => editing.commit(of, value)}
        onCancel={() => editing.undrag(of)}
      />
    );
  }
  if (Array.isArray(own)) {
    const parts = own as readonly number[];
    const names: readonly Key[] =
      of.kind === "span" ? ["structure.first", "structure.last"] : ["structure.x", "structure.y", "structure.z"];
    return (
      <>
        {parts.map((value, index) =>
          slider({
            label: `${label}, ${say(names[index] ?? "structure.x")}`,
            value,
            standard: value,
            whole: (changed) => parts.map((part, at) => (at === index ? changed : part)),
          }),
        )}
      </>
    );
  }
  return null;
}

interface Part {
  readonly label: string;
  readonly value: number;
  readonly standard: number;
  readonly whole: (value: number) => unknown;
}

function unitOf(of: DesignKey): string {
  if (of.unit === "degrees") {
    return say("structure.unit.degrees");
  }
  return of.unit === "internodes" ? say("structure.unit.internodes") : "";
}

function stepOf(span: number): number {
  if (span > 100) {
    return 1;
  }
  return span > 10 ? 0.1 : 0.01;
}
