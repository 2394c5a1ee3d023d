import { useEffect, useRef } from "preact/hooks";
import type { Handle, Readout } from "../../document/design/branch-handles";
import type { HandsOn } from "../../document/design/hands-on";
import type { Studio } from "../../studio";
import { numberText } from "../../words/number-text";
import { say } from "../../words/say";
import { closedPath, useAnimationFrames } from "../use-animation-frames";
import { comeTo } from "./come-to";
import { shownHandles } from "./crowding";

interface HandlesProps {
  readonly studio: Studio;
  readonly shaping: HandsOn;
}

/** How far an arrow key moves a handle, in pixels. */
const KEY_STEP = 8;
/** So far from the edge of the picture a handle stays, in pixels. */
const EDGE = 26;
const ARROWS: Readonly<Record<string, readonly [number, number]>> = {
  ArrowLeft: [-KEY_STEP, 0],
  ArrowRight: [KEY_STEP, 0],
  ArrowUp: [0, -KEY_STEP],
  ArrowDown: [0, KEY_STEP],
};

/** The axis of the chosen shape and its handles, over the picture. */
export function Handles({ studio, shaping }: HandlesProps) {
  const layer = useRef<HTMLDivElement>(null);
  const axis = useRef<SVGPolylineElement>(null);
  const held = shaping.held.value;
  const handles = shaping.handles.value;
  const [sketching, trace] = [shaping.sketching.value, shaping.trace.value];
  const isDrawing = trace.length > 0;
  // No pointer is known here: whichever comes down next is a second one.
  useEffect(() => (isDrawing ? cancelOthers(-1, () => shaping.cancel()) : undefined), [isDrawing, shaping]);
  useAnimationFrames(true, () => {
    const [project, shape] = [studio.stage.projector(), shaping.chosen.peek()];
    if (!project || !shape) {
      return;
    }
    const places = shape.axis().map(project);
    axis.current?.setAttribute(
      "points",
      places
        .filter((place) => place !== null)
        .map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`)
        .join(" "),
    );
    const all = shaping.handles.peek();
    const byId = new Map(all.map((handle) => [handle.id, handle]));
    const { ids, hidden } = shownHandles(all, shape, project, shaping.held.peek()?.handle);
    const told = shaping.hidden.peek();
    if (shaping.held.peek() === null && (told.near !== hidden.near || told.along !== hidden.along)) {
      shaping.hidden.value = hidden;
    }
    for (const mark of layer.current?.querySelectorAll<HTMLElement>("[data-handle]") ?? []) {
      const handle = byId.get(mark.dataset.handle ?? "");
      const at = handle && project(handle.place(shape));
      mark.dataset.shown = String(ids.has(mark.dataset.handle ?? ""));
      if (at && layer.current) {
        // What lies beside the picture stands at its edge.
        const [x, y] = [inside(at[0], layer.current.clientWidth), inside(at[1], layer.current.clientHeight)];
        mark.dataset.away = String(x !== at[0] || y !== at[1]);
        mark.style.translate = `${x.toFixed(1)}px ${y.toFixed(1)}px`;
      }
    }
  });
  return (
    <div class="structure-handles" ref={layer} data-held={held !== null}>
      <svg class="overlay" aria-hidden="true">
        <polyline ref={axis} class="structure-stage-axis" />
        {trace.length > 0 && shaping.draws.value === "outline" && (
          <path d={closedPath(trace)} class="structure-trace" />
        )}
        {trace.length > 0 && shaping.draws.value === "axis" && (
          <polyline points={trace.map(([x, y]) => `${x},${y}`).join(" ")} class="structure-trace-line" />
        )}
      </svg>
      {!sketching &&
        handles.map((handle) => <HandleKnob key={handle.id} studio={studio} shaping={shaping} handle={handle} />)}
    </div>
  );
}

/** One handle: what takes hold of it last counts, and a second finger lets all be as it was. */
function HandleKnob({ studio, shaping, handle }: HandlesProps & { readonly handle: Handle }) {
  const held = shaping.held.value;
  const isHeld = held?.handle === handle.id;
  const grip = useRef<{
    readonly id: number;
    readonly x: number;
    readonly y: number;
    readonly stop: () => void;
  } | null>(null);
  const letGo = (event: PointerEvent, end: () => void) => {
    if (grip.current?.id === event.pointerId) {
      grip.current.stop();
      grip.current = null;
      end();
    }
  };
  const nudge = (event: KeyboardEvent) => {
    const [by, shape, project] = [ARROWS[event.key], shaping.chosen.peek(), studio.stage.projector()];
    const at = shape && project?.(handle.place(shape));
    if (by && at) {
      event.preventDefault();
      event.stopPropagation();
      shaping.grip(handle);
      shaping.drag(at[0] + by[0], at[1] + by[1]);
      shaping.release();
    } else if (event.key === "Delete" && handle.without) {
      shaping.without(handle);
    }
  };
  return (
    <button
      type="button"
      class="structure-handle"
      data-handle={handle.id}
      data-new={handle.isNew === true}
      data-held={isHeld}
      aria-label={say(`structure.handle.${handle.id.replace(/-\d+$/, "") as "tip"}`)}
      onPointerDown={(event) => {
        if (grip.current !== null || event.button !== 0) {
          return;
        }
        event.preventDefault();
        event.currentTarget.setPointerCapture(event.pointerId);
        const [shape, host] = [shaping.chosen.peek(), event.currentTarget.offsetParent?.getBoundingClientRect()];
        const at = shape && studio.stage.projector()?.(handle.place(shape));
        if (!at || !host) {
          return;
        }
        // The finger keeps its distance to what it holds.
        const [x, y] = [event.clientX - host.left - at[0], event.clientY - host.top - at[1]];
        shaping.grip(handle);
        grip.current = { id: event.pointerId, x, y, stop: cancelOthers(event.pointerId, () => shaping.cancel()) };
      }}
      onPointerMove={(event) => {
        const [now, host] = [grip.current, event.currentTarget.offsetParent?.getBoundingClientRect()];
        if (now?.id === event.pointerId && host && (event.movementX !== 0 || event.movementY !== 0)) {
          shaping.drag(event.clientX - now.x - host.left, event.clientY - now.y - host.top);
        }
      }}
      onPointerUp={(event) => letGo(event, () => shaping.release())}
      onPointerCancel={(event) => letGo(event, () => shaping.cancel())}
      onDblClick={() => shaping.without(handle)}
      onKeyDown={nudge}
    >
      {isHeld && <output class="structure-readout">{readoutText(held.readout)}</output>}
    </button>
  );
}

function inside(at: number, length: number): number {
  return Math.min(Math.max(at, EDGE), length - EDGE);
}

/** A second finger, or Escape, lets what is in progress be as it was. Gives what ends that. */
function cancelOthers(pointer: number, cancel: () => void): () => void {
  const stop = new AbortController();
  const options = { capture: true, signal: stop.signal };
  window.addEventListener("pointerdown", (event) => event.pointerId !== pointer && cancel(), options);
  window.addEventListener(
    "keydown",
    (event) => {
      if (event.key === "Escape") {
        event.stopPropagation();
        cancel();
      }
    },
    options,
  );
  return () => stop.abort();
}

function readoutText({ length, angle, width, height, shape, place, isLowest }: Readout): string {
  const parts = [
    length !== undefined && say("structure.readout.length", { length: numberText(length, 0.1) }),
    angle !== undefined && say("structure.readout.angle", { angle: numberText(angle, 1) }),
    width !== undefined && say("structure.readout.width", { width: numberText(width, 0.1) }),
    height !== undefined && say("structure.readout.height", { height: numberText(height, 0.1) }),
    shape !== undefined && say("structure.readout.shape", { shape: numberText(shape, 0.1) }),
    place !== undefined && say("structure.readout.place", { percent: numberText(100 * place, 1) }),
    isLowest === true && say("structure.readout.lowest"),
  ];
  return parts.filter((part) => part !== false).join(" · ");
}

/** Says how many handles are not shown, and what shows them. */
export function HiddenHandles({ studio, shaping }: HandlesProps) {
  const { near, along } = shaping.hidden.value;
  if (shaping.sketching.value || near + along === 0) {
    return null;
  }
  return (
    <div class="structure-bar-hidden">
      {near > 0 && (
        <button
          type="button"
          title={say("structure.hidden.help")}
          onClick={() => comeTo(studio, shaping.chosen.peek())}
        >
          {say("structure.hidden", { handles: near })}
        </button>
      )}
      {along > 0 && <span>{say("structure.hidden.turn", { handles: along })}</span>}
    </div>
  );
}
