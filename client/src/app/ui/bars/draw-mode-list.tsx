import type { Signal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { DRAW_MODES, type DrawMode, TRAITS } from "../../../scene/mode/draw-mode";
import { css } from "../../../scene/mode/ramps";
import { isUsual, keyOf, SHOWN_NAMES, type Shown, switched, USUAL } from "../../../scene/mode/shown";
import { say } from "../../words/say";

interface DrawModeListProps {
  readonly mode: DrawMode;
  readonly choose: (mode: DrawMode) => void;
  readonly shown: Signal<Shown>;
}

/** The draw modes to choose from, and what of any of them is left out. */
export function DrawModeList({ mode, choose, shown }: DrawModeListProps) {
  return (
    <div class="panel menu draw-modes">
      <ul aria-label={say("drawmode.menu")}>
        {DRAW_MODES.map((name) => (
          <li key={name}>
            <button type="button" aria-pressed={name === mode} onClick={() => choose(name)}>
              <DrawModePicture mode={name} />
              {say(`drawmode.${name}`)}
            </button>
          </li>
        ))}
      </ul>
      <Switches shown={shown} />
    </div>
  );
}

function Switches({ shown }: Pick<DrawModeListProps, "shown">) {
  return (
    <ul class="shown" aria-label={say("shown.menu")}>
      {SHOWN_NAMES.map((name) => (
        <li key={name}>
          <label title={say("shown.key", { what: say(`shown.${name}`), key: keyOf(name) })}>
            <input
              type="checkbox"
              aria-label={say(`shown.${name}`)}
              checked={shown.value[name]}
              onChange={() => {
                shown.value = switched(shown.peek(), name);
              }}
            />
            <span>{say(`shown.${name}`)}</span>
            <kbd>{keyOf(name)}</kbd>
          </label>
        </li>
      ))}
      <li>
        <button
          type="button"
          disabled={isUsual(shown.value)}
          onClick={() => {
            shown.value = USUAL;
          }}
        >
          {say("shown.reset")}
        </button>
      </li>
    </ul>
  );
}

/** A little tree as a mode shows it. */
function DrawModePicture({ mode }: { mode: DrawMode }) {
  const ramp = TRAITS[mode]?.ramp;
  // From the trunk outwards, as far apart as the ramp's colours are.
  const at = (place: number) => css(ramp?.[Math.round(place * (ramp.length - 1))] ?? [0.5, 0.5, 0.5]);
  return (
    <svg class="draw-mode-picture" viewBox="0 0 32 32" aria-hidden="true">
      {mode === "lit" && (
        <Tree trunk="#7d6a55" limbs="#7d6a55">
          <circle cx="11" cy="13" r="7" fill="#3f7a39" />
          <circle cx="21" cy="13" r="7" fill="#57954a" />
          <circle cx="16" cy="8" r="6.5" fill="#7cb968" />
        </Tree>
      )}
      {mode === "skeleton" && <Tree trunk="currentColor" limbs="currentColor" thin />}
      {mode === "wireframe" && (
        <g fill="none" stroke="currentColor" stroke-width="1.1" stroke-linejoin="round">
          <path d="M13 30V18h6v12ZM13 30l6-6M13 24l6-6" />
          <path d="M6 14 11 4h10l5 10-10 6ZM6 14h20M11 4l5 16 5-16M6 14l15-10M26 14 11 4" />
        </g>
      )}
      {ramp && <Tree trunk={at(0.05)} limbs={at(0.5)} tips={at(0.95)} />}
    </svg>
  );
}

interface TreeProps {
  readonly trunk: string;
  readonly limbs: string;
  readonly tips?: string;
  readonly thin?: boolean;
  readonly children?: ComponentChildren;
}

function Tree({ trunk, limbs, tips, thin = false, children }: TreeProps) {
  return (
    <g fill="none" stroke-linecap="round" stroke-linejoin="round">
      <path d="M16 30V16" stroke={trunk} stroke-width={thin ? 1.6 : 4} />
      <path d="M16 20 8 12M16 18l8-7M16 16V8" stroke={limbs} stroke-width={thin ? 1.4 : 3} />
      {(tips || thin) && (
        <path
          d="M8 12 4 11M8 12 8 7M24 11l4.5-1M24 11V6M16 8l-3-5M16 8l3.5-5"
          stroke={tips ?? limbs}
          stroke-width={thin ? 1.2 : 2.4}
        />
      )}
      {children}
    </g>
  );
}
