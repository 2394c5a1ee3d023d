import { useEffect, useRef, useState } from "preact/hooks";
import { MAX_DIAMETER, MIN_DIAMETER, type WidthConstraint } from "../../../wire/generated";
import type { ToolPage, ToolViewProps } from "../../tools/descriptor";
import type { WidthTool } from "../../tools/width/width-tool";
import { numberText } from "../../words/number-text";
import { say } from "../../words/say";
import { CloseIcon } from "../icons";
import { useAnimationFrames } from "../use-animation-frames";
import { type Ring, ringAt } from "./ring";
import { ringHandles } from "./ring-handles";

/** How near to a limb a ring that is dragged along it has to be kept, in pixels. */
const ALONG = 60;

/** Which way a key goes: to a thicker limb, or towards the limb's tip. */
const WAYS: Record<string, -1 | 1> = { ArrowUp: 1, ArrowRight: 1, ArrowDown: -1, ArrowLeft: -1 };

/** Rings around the limbs whose width is set, and the chosen one with its knobs. */
export function WidthRings({ tool: width, page }: ToolViewProps<WidthTool>) {
  const drawn = useRef<SVGGElement>(null);
  const labels = useRef<HTMLDivElement>(null);
  const chosen = width.chosen.value;
  const wanted = width.wanted.value;
  // Each frame of rows may have moved a limb.
  void page.revision.value;
  const set = width.widths.value;
  // The chosen one comes last, over the others, and keeps its element and the focus wherever it is moved.
  const others = set.filter(({ row }) => row !== chosen);
  const rings = [...others, ...(chosen === null ? [] : [{ row: chosen, diameter: 0, effective: 0 }])];
  const diameter = (row: number) => (row === chosen && wanted !== null ? wanted : width.diameterOf(row));
  useAnimationFrames(rings.length > 0, () => {
    for (const [i, { row }] of rings.entries()) {
      const ring = ringAt(page, row, diameter(row));
      const [back, casing, front] = [...(drawn.current?.children[i]?.children ?? [])];
      back?.setAttribute("d", ring?.back ?? "");
      casing?.setAttribute("d", ring?.front ?? "");
      front?.setAttribute("d", ring?.front ?? "");
      const label = labels.current?.children[i];
      if (label instanceof HTMLElement) {
        place(label, ring);
      }
    }
  });
  if (rings.length === 0) {
    return null;
  }
  return (
    <>
      <svg class="overlay width-rings" aria-hidden="true">
        <g ref={drawn}>
          {rings.map(({ row }) => (
            <g key={row} data-chosen={row === chosen}>
              <path class="ring-back" />
              <path class="ring-casing" />
              <path class="ring-front" />
            </g>
          ))}
        </g>
      </svg>
      <div class="width-labels" ref={labels}>
        {rings.map((constraint) =>
          constraint.row === chosen ? (
            <Widget key="chosen" page={page} width={width} row={chosen} diameter={diameter(chosen)} />
          ) : (
            <div key={constraint.row} class="width-widget">
              <button
                type="button"
                class="width-label"
                aria-label={say("tools.width.choose", { width: figure(constraint.diameter) })}
                onClick={() => width.choose(constraint.row)}
              >
                <Figure constraint={constraint} />
              </button>
            </div>
          ),
        )}
      </div>
    </>
  );
}

interface WidgetProps {
  readonly page: ToolPage;
  readonly width: WidthTool;
  readonly row: number;
  readonly diameter: number;
}

/** The held ring: a knob on either side, a dot to move it by, its width as a number, and a way to take it away. */
function Widget({ page, width, row, diameter }: WidgetProps) {
  const set = width.limits.value.has(row);
  const place = width.place();
  type Press = PointerEvent & { readonly currentTarget: HTMLElement };
  const pulls = {
    onPointerDown: (event: Press) => {
      if (event.button === 0) {
        event.currentTarget.setPointerCapture(event.pointerId);
        width.take(row, awayFrom(page, row, event));
      }
    },
    onPointerMove: (event: Press) => {
      if (event.currentTarget.hasPointerCapture(event.pointerId)) {
        width.pull(...onCanvas(event));
        width.tick();
      }
    },
    onPointerUp: () => width.letGo(),
    onPointerCancel: () => width.letGo(),
  };
  const to = useRef<number | null>(null);
  return (
    <div class="width-widget" data-chosen="true">
      {/* The right knob does the same, and is the one that keys reach. */}
      <div class="width-knob left" aria-hidden="true" {...pulls} />
      <div
        class="width-knob right"
        role="slider"
        tabIndex={0}
        aria-label={say("tools.width.diameter")}
        aria-valuemin={MIN_DIAMETER}
        aria-valuemax={MAX_DIAMETER}
        aria-valuenow={diameter}
        aria-valuetext={say("tools.width.value", { width: figure(diameter) })}
        onKeyDown={(event) => {
          const way = WAYS[event.key];
          if (way !== undefined) {
            event.preventDefault();
            width.type(diameter * 1.05 ** way);
          } else if (event.key === "Delete" || event.key === "Backspace") {
            width.remove();
          }
        }}
        {...pulls}
      />
      <div
        class="width-dot"
        role="slider"
        tabIndex={0}
        aria-label={say("tools.width.along")}
        aria-valuemin={1}
        aria-valuemax={place?.of ?? 1}
        aria-valuenow={place?.along ?? 1}
        onKeyDown={(event) => {
          const way = WAYS[event.key];
          if (way !== undefined) {
            event.preventDefault();
            width.step(way);
          }
        }}
        title={say("tools.width.along.title")}
        onPointerDown={(event) => {
          if (event.button === 0) {
            event.currentTarget.setPointerCapture(event.pointerId);
            to.current = null;
          }
        }}
        onPointerMove={(event) => {
          if (event.currentTarget.hasPointerCapture(event.pointerId)) {
            to.current = page.stage.pickRow(...onCanvas(event), ALONG);
            const at = to.current === null ? null : page.stage.seenAt(to.current);
            const spot = at && page.stage.projector()?.(at);
            if (spot) {
              event.currentTarget.style.setProperty("--to-x", `${spot[0]}px`);
              event.currentTarget.style.setProperty("--to-y", `${spot[1]}px`);
              event.currentTarget.dataset.moving = "true";
            }
          }
        }}
        onPointerUp={(event) => {
          delete event.currentTarget.dataset.moving;
          if (to.current !== null) {
            width.shift(to.current);
          }
        }}
        onPointerCancel={(event) => delete event.currentTarget.dataset.moving}
      />
      <form
        class="panel width-box"
        onSubmit={(event) => {
          event.preventDefault();
          if (document.activeElement instanceof HTMLElement) {
            document.activeElement.blur();
          }
        }}
      >
        <Entry key={row} width={width} diameter={diameter} />
        <button
          type="button"
          aria-label={say(set ? "tools.width.remove" : "tools.width.leave")}
          title={say(set ? "tools.width.remove.title" : "tools.width.leave")}
          onClick={() => width.remove()}
        >
          <CloseIcon />
        </button>
      </form>
    </div>
  );
}

/** The width as a number that can be typed. */
function Entry({ width, diameter }: { width: WidthTool; diameter: number }) {
  const [typed, setTyped] = useState<string | null>(null);
  const latest = useRef<string | null>(null);
  latest.current = typed;
  const enter = (text: string | null) => {
    const diameter = Number(text?.replace(",", "."));
    // A field that was emptied says nothing.
    if (diameter > 0) {
      width.type(diameter);
    }
  };
  // A number that was typed and not entered is entered when the ring is left.
  useEffect(() => () => enter(latest.current), [width]);
  return (
    <label title={say("tools.width.typed")}>
      <span aria-hidden="true">⌀</span>
      <input
        type="text"
        inputMode="decimal"
        aria-label={say("tools.width.typed")}
        value={typed ?? figure(diameter)}
        onFocus={(event) => event.currentTarget.select()}
        onInput={(event) => setTyped(event.currentTarget.value)}
        onBlur={() => {
          enter(typed);
          setTyped(null);
        }}
      />
    </label>
  );
}

/** What was set, and what came of it where widths contradict each other. */
function Figure({ constraint }: { constraint: WidthConstraint }) {
  const { diameter, effective } = constraint;
  const differs = Math.abs(effective / diameter - 1) > 0.04;
  return (
    <>
      {figure(diameter)}
      {differs && <span class="quiet"> → {figure(effective)}</span>}
    </>
  );
}

function figure(diameter: number): string {
  return numberText(diameter, diameter >= 10 ? 0.1 : diameter >= 0.1 ? 0.01 : 0.001);
}

function onCanvas(event: PointerEvent): [number, number] {
  const bounds = document.getElementById("workspace")?.getBoundingClientRect();
  return [event.clientX - (bounds?.left ?? 0), event.clientY - (bounds?.top ?? 0)];
}

function awayFrom(page: ToolPage, row: number, event: PointerEvent): number {
  const at = page.stage.seenAt(row);
  const spot = at && page.stage.projector()?.(at);
  const [x, y] = onCanvas(event);
  return spot ? Math.hypot(x - spot[0], y - spot[1]) : 0;
}

function place(label: HTMLElement, ring: Ring | null): void {
  label.style.visibility = ring ? "visible" : "hidden";
  for (const [name, value] of Object.entries(ring ? ringHandles(ring) : {})) {
    label.style.setProperty(name, value);
  }
}
