import type { ComponentChildren } from "preact";
import { useId, useState } from "preact/hooks";
import type { Parameters, ParametersPatch } from "../../../../wire/generated";
import { alike } from "../../../document/draft";
import {
  type GrowthParameter,
  helpOf,
  isNumber,
  type NumberParameter,
  nameOf,
  patchFor,
  patchFrom,
  unitOf,
} from "../../../document/growth/growth-parameters";
import type { Studio } from "../../../studio";
import { softly } from "../../../words/joints";
import { ResetButton } from "../../controls/field";
import { TypedNumber } from "../../controls/typed-number";
import { ParameterControl } from "../parameter-control";
import { standardOf } from "./species-list";

/** What each widget of the panel is given. */
export interface WidgetProps {
  readonly studio: Studio;
}

interface FrameProps {
  readonly studio: Studio;
  readonly title: string;
  readonly help: string;
  /** What belongs to the widget: each number can be typed as well, all else has a control under it. */
  readonly parameters: readonly GrowthParameter[];
  /** What its values mean, in words. */
  readonly note?: string;
  /** The diagram. */
  readonly children?: ComponentChildren;
  /** What else belongs to it, under all else. */
  readonly more?: ComponentChildren;
}

/** A widget with its name, its values, its reset and its sentence. */
export function WidgetFrame({ studio, title, help, parameters, note, children, more }: FrameProps) {
  const now = studio.parameters.value;
  const standard = standardOf(studio);
  /** The value that is being explained. */
  const [asked, ask] = useState<NumberParameter | null>(null);
  const helpId = useId();
  if (now === null) {
    return null;
  }
  const differs = ({ name }: GrowthParameter) => !alike(now[name], standard[name]);
  const set = (patch: ParametersPatch) => studio.growing.commit(patch);
  return (
    <section class="widget" aria-label={title}>
      <header>
        <h3>{title}</h3>
        {parameters.length > 1 && parameters.some(differs) && (
          <ResetButton name={title} onReset={() => set(patchFrom(standard, parameters))} />
        )}
      </header>
      <div class="widget-body" data-bare={children === undefined}>
        {children}
        <div class="widget-values">
          {parameters.filter(isNumber).map((parameter) => (
            <Value
              key={parameter.name}
              parameter={parameter}
              now={now}
              helpId={helpId}
              asked={parameter === asked}
              onAsk={() => ask(parameter === asked ? null : parameter)}
              onReset={differs(parameter) ? () => set(patchFor(parameter.name, standard[parameter.name], now)) : null}
              onCommit={(value) => set(patchFor(parameter.name, value, now))}
            />
          ))}
        </div>
      </div>
      <p class="widget-help asked" id={helpId} hidden={asked === null}>
        {asked && (
          <>
            <b>{nameOf(asked)}:</b> {helpOf(asked)}
          </>
        )}
      </p>
      {note !== undefined && <p class="widget-note">{note}</p>}
      <p class="widget-help">{help}</p>
      {parameters
        .filter((parameter) => !isNumber(parameter))
        .map((parameter) => (
          <ParameterControl key={parameter.name} studio={studio} parameter={parameter} />
        ))}
      {more}
    </section>
  );
}

interface ValueProps {
  readonly parameter: NumberParameter;
  readonly now: Parameters;
  /** Where it is explained. */
  readonly helpId: string;
  readonly asked: boolean;
  readonly onAsk: () => void;
  readonly onReset: (() => void) | null;
  readonly onCommit: (value: number) => void;
}

/** One of a widget's values: its name, which asks for its help, a box to type in, its reset. */
function Value({ parameter, now, helpId, asked, onAsk, onReset, onCommit }: ValueProps) {
  const { name, symbol, least, most, step, applies } = parameter;
  const label = nameOf(parameter);
  return (
    <div class="widget-value">
      <button
        type="button"
        class="field-name"
        aria-expanded={asked}
        aria-controls={helpId}
        title={helpOf(parameter)}
        onClick={onAsk}
      >
        <span>
          {softly(label)} <i>{symbol}</i>
        </span>
        <b aria-hidden="true">?</b>
      </button>
      <div class="widget-number">
        <TypedNumber
          label={label}
          unit={unitOf(parameter)}
          {...{ least, most, step }}
          value={now[name]}
          disabled={applies?.(now) === false}
          onCommit={onCommit}
        />
        {onReset && <ResetButton name={label} onReset={onReset} />}
      </div>
    </div>
  );
}

interface DiagramProps {
  readonly width: number;
  readonly height: number;
  /** The drawing, in pixels. */
  readonly drawing: ComponentChildren;
  /** The grips on it. */
  readonly children: ComponentChildren;
}

/** A drawing with grips over it. */
export function Diagram({ width, height, drawing, children }: DiagramProps) {
  return (
    <div class="diagram" style={{ width: `${width}px`, height: `${height}px` }}>
      <svg width={width} height={height} viewBox={`0 0 ${width} ${height}`} aria-hidden="true">
        {drawing}
      </svg>
      {children}
    </div>
  );
}
