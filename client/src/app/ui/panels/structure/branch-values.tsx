import type { ComponentChildren } from "preact";
import type { DesignEditing } from "../../../document/design/design-editing";
import {
  bearerOf,
  type DesignKey,
  type DesignModel,
  isPoints,
  type KeyName,
  keysOf,
  type Resolved,
  ROOT,
  type Status,
  wayTo,
} from "../../../document/design/design-model";
import { type Key, say } from "../../../words/say";
import { Slider } from "../../controls/slider";
import { Switch } from "../../controls/switch";
import type { Scale } from "../../controls/travel";
import { titleOf } from "./branch-list";
import { FunctionEditor } from "./function-editor";
import { type EnvelopeValue, OutlineEditor } from "./outline-editor";

interface ValuesProps {
  readonly editing: DesignEditing;
  readonly model: DesignModel;
}

/** Kinds of values that hands set, or files, and no editor here. */
const BY_HAND = new Set(["curve", "material"]);

/** The part of a wide range that trees have, which gets most of a slider. */
const TRAVEL: Partial<Record<KeyName, readonly [number, number]>> = {
  height: [10, 150],
  stem: [0.2, 5],
  reach: [0.3, 1.7],
  turn: [-90, 90],
  roll: [-90, 90],
  pull: [-2, 2],
  leaf_size: [0.2, 3],
};

/** All parameters of the chosen branch, and what can be done with it as a whole. */
export function BranchValues({ editing, model }: ValuesProps) {
  const path = editing.chosen.value;
  const copied = editing.copied.value;
  return (
    <>
      <nav class="structure-way" aria-label={say("structure.way")}>
        {wayTo(path).map((step) => (
          <button type="button" key={step} aria-current={step === path} onClick={() => editing.choose(step)}>
            {titleOf(model, step)}
          </button>
        ))}
      </nav>
      <div class="structure-row">
        <button type="button" onClick={() => editing.copy()}>
          {say("structure.copy")}
        </button>
        <button type="button" disabled={copied === null || copied === path} onClick={() => editing.paste()}>
          {say("structure.paste")}
        </button>
        <button
          type="button"
          disabled={path === ROOT || model.ownValues(path) === 0}
          onClick={() => editing.forget(path)}
        >
          {say("structure.forget")}
        </button>
      </div>
      {keysOf(path)
        .filter((key) => !BY_HAND.has(key.kind))
        .map((key) => (
          <ValueRow key={key.name} editing={editing} model={model} path={path} of={key} />
        ))}
    </>
  );
}

interface ValueRowProps extends ValuesProps {
  readonly path: string;
  readonly of: DesignKey;
}

/** One parameter: its editor, how the branch has it, and where it comes from. */
function ValueRow({ editing, model, path, of }: ValueRowProps) {
  const resolved = model.resolve(path, of);
  const isShown = editing.key.value === of.name;
  return (
    <div class="structure-value" data-status={resolved.status}>
      <Editor editing={editing} model={model} path={path} of={of} resolved={resolved} />
      <button
        type="button"
        class="structure-status"
        aria-expanded={isShown}
        onClick={() => {
          editing.key.value = isShown ? null : of.name;
        }}
      >
        <StatusMark resolved={resolved} />
        {say(resolved.origin === null ? "structure.status.standard" : `structure.status.${resolved.status}`)}
        {resolved.isPrivate && <span title={say("structure.private")}> 🔒</span>}
      </button>
      {isShown && (
        <>
          <PathStrip model={model} path={path} of={of} editing={editing} />
          <StatusMenu editing={editing} path={path} of={of} resolved={resolved} />
        </>
      )}
    </div>
  );
}

/** Filled where the value is said, a ring where it is inherited, half where it is relative. */
function StatusMark({ resolved }: { resolved: Resolved }) {
  return <i class="structure-mark" data-status={resolved.status} aria-hidden="true" />;
}

/** How each branch on the way has a value, so that one sees where it comes from. */
function PathStrip({ model, path, of, editing }: ValueRowProps) {
  const { origin } = model.resolve(path, of);
  return (
    <ol class="structure-strip" aria-label={say("structure.strip")}>
      {wayTo(path).map((step) => {
        const resolved = model.resolve(step, of);
        const status = say(`structure.status.${resolved.status}`);
        return (
          <li key={step} data-origin={origin === step}>
            <button
              type="button"
              aria-label={`${titleOf(model, step)}: ${status}${resolved.isPrivate ? `, ${say("structure.private")}` : ""}`}
              onClick={() => editing.choose(step)}
            >
              <StatusMark resolved={resolved} />
              <span>{titleOf(model, step)}</span>
              {resolved.isPrivate && <span aria-hidden="true">🔒</span>}
            </button>
          </li>
        );
      })}
      <li class="quiet">
        {origin === null
          ? say("structure.origin.default")
          : say("structure.origin", { branch: origin.startsWith("level") ? origin : titleOf(model, origin) })}
      </li>
    </ol>
  );
}

interface StatusMenuProps {
  readonly editing: DesignEditing;
  readonly path: string;
  readonly of: DesignKey;
  readonly resolved: Resolved;
}

/** What can be changed about how a branch has a value. */
function StatusMenu({ editing, path, of, resolved }: StatusMenuProps) {
  if (path === ROOT) {
    return (
      <div class="structure-row">
        <button type="button" disabled={resolved.status === "inherited"} onClick={() => editing.say(of, "inherited")}>
          {say("structure.standard")}
        </button>
      </div>
    );
  }
  const canBeRelative = of.kind === "scalar" || of.kind === "function";
  const ways: readonly Status[] = canBeRelative
    ? ["inherited", "own", "offset", "factor", "shared"]
    : ["inherited", "own", "shared"];
  return (
    <div class="structure-menu">
      <fieldset class="structure-ways">
        <legend>{say("structure.status")}</legend>
        {ways.map((way) => (
          <button type="button" key={way} aria-pressed={resolved.status === way} onClick={() => editing.say(of, way)}>
            {say(`structure.status.${way}`)}
          </button>
        ))}
      </fieldset>
      <label class="structure-private">
        <input
          type="checkbox"
          checked={resolved.isPrivate}
          onChange={(event) => editing.hide(of, event.currentTarget.checked)}
        />
        {say("structure.hide")}
      </label>
      {bearerOf(path) !== null && resolved.status !== "inherited" && (
        <button type="button" onClick={() => editing.promote(of)}>
          {say("structure.promote")}
        </button>
      )}
    </div>
  );
}

/** What a slider moves of a value: the whole, or what is said relative to the inherited one. */
function ownOf(model: DesignModel, path: string, of: DesignKey, resolved: Resolved): unknown {
  const setting = model.said(path, of.name)?.setting;
  if (resolved.status === "offset") {
    return setting?.add;
  }
  return resolved.status === "factor" ? setting?.multiply : resolved.value;
}

function rangeOf(of: DesignKey, status: Status): Omit<Scale, "step"> {
  if (status === "offset") {
    return { least: of.least - of.most, most: of.most - of.least };
  }
  return status === "factor" ? { least: 0, most: 10 } : { least: of.least, most: of.most, travel: TRAVEL[of.name] };
}

function Editor({ editing, model, path, of, resolved }: ValueRowProps & { readonly resolved: Resolved }) {
  const label = say(`structure.key.${of.name}`);
  const help = say(`structure.key.${of.name}.help`);
  const own = ownOf(model, path, of, resolved);
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
    return (
      <FunctionEditor
        label={label}
        help={help}
        points={own}
        inherited={resolved.status === "own" || !isPoints(resolved.inherited) ? null : resolved.inherited}
        result={isPoints(resolved.value) ? resolved.value : own}
        least={range.least}
        most={range.most}
        onDrag={(points) => editing.drag(of, points)}
        onCommit={(points) => editing.commit(of, points)}
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
