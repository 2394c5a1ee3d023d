import type { ComponentChildren } from "preact";
import type { ParametersPatch } from "../../../wire/generated";
import { alike } from "../../draft";
import { type NumberParameter, nameOf, patchFor, patchFrom, unitOf } from "../../growth-parameters";
import type { Studio } from "../../studio";
import { say } from "../../words";
import { ResetIcon } from "../controls/icons";
import { TypedNumber } from "../controls/typed-number";
import { standardOf } from "./species-list";

/** What each widget of the panel is given. */
export interface WidgetProps {
  readonly studio: Studio;
}

interface FrameProps {
  readonly studio: Studio;
  readonly title: string;
  readonly help: string;
  /** What the widget sets; each can be typed as well. */
  readonly parameters: readonly NumberParameter[];
  /** What its values come to, in words. */
  readonly told?: string;
  /** The diagram. */
  readonly children?: ComponentChildren;
  /** What else belongs to it, under all else. */
  readonly more?: ComponentChildren;
}

/** A widget with its name, its values, its reset and its sentence. */
export function WidgetFrame({ studio, title, help, parameters, told, children, more }: FrameProps) {
  const now = studio.parameters.value;
  const standard = standardOf(studio);
  if (now === null) {
    return null;
  }
  const changed = parameters.some(({ name }) => !alike(now[name], standard[name]));
  const set = (patch: ParametersPatch) => studio.growing.commit(patch);
  return (
    <section class="widget" aria-label={title}>
      <header>
        <h3>{title}</h3>
        {changed && (
          <button
            type="button"
            class="field-reset"
            aria-label={say("architecture.reset", { name: title })}
            title={say("architecture.reset", { name: title })}
            onClick={() => set(patchFrom(standard, parameters))}
          >
            <ResetIcon />
          </button>
        )}
      </header>
      <div class="widget-body" data-bare={children === undefined}>
        {children}
        <div class="widget-values">
          {parameters.map((parameter) => {
            const { name, symbol, least, most, step, applies } = parameter;
            return (
              <div class="widget-value" key={name}>
                <span>
                  {nameOf(parameter)} <i class="widget-symbol">{symbol}</i>
                </span>
                <TypedNumber
                  label={nameOf(parameter)}
                  unit={unitOf(parameter)}
                  {...{ least, most, step }}
                  value={now[name]}
                  disabled={applies?.(now) === false}
                  onCommit={(value) => set(patchFor(name, value, now))}
                />
              </div>
            );
          })}
        </div>
      </div>
      {told !== undefined && <p class="widget-told">{told}</p>}
      <p class="widget-help">{help}</p>
      {more}
    </section>
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
