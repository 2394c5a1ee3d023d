import { useEffect, useRef, useState } from "preact/hooks";
import { type Dome, domeOf } from "../../document/appearance/sun-dome";
import {
  around,
  azimuthOfEye,
  HIGHEST_SUN,
  LOWEST_SUN,
  type ScreenAxes,
  SunDrag,
  type SunPlace,
  shownAt,
  standingAt,
} from "../../document/appearance/sun-orbit";
import type { Studio } from "../../studio";
import { say } from "../../words/say";
import { Icon } from "../icons";
import { useAnimationFrames } from "../use-animation-frames";

/** How far an arrow key moves the sun, and with shift, in degrees. */
const KEY_STEP = 3;
const BIG_STEP = 15;
/** A view that turned less than this since the last frame stands still, in degrees. */
const STILL = 0.01;
/** A view that has stood still for so many frames has come to rest. */
const REST_FRAMES = 12;
const RING_POINTS = 64;

const PinIcon = () => (
  <Icon>
    <path d="M9 4.500h6l-.8 6 3 3.500H6.800l3-3.500zM12 14v6" />
  </Icon>
);

/** The sun as a little sphere around the tree: to be dragged, and pinned while the tree turns under it. */
export function SunHandle({ studio }: { studio: Studio }) {
  const pinned = studio.sunPinned.value;
  const setPinned = (to: boolean) => {
    studio.sunPinned.value = to;
  };
  // With everything hidden a sun that is pinned still goes round with the eye, only its handle is hidden.
  const shown = pinned || (studio.layout.panel.value === "background" && !studio.layout.bare.value);
  return shown ? <Sphere studio={studio} pinned={pinned} setPinned={setPinned} /> : null;
}

type Beside = readonly [right: number, up: number];

interface SphereProps {
  readonly studio: Studio;
  readonly pinned: boolean;
  readonly setPinned: (pinned: boolean) => void;
}

function Sphere({ studio, pinned, setPinned }: SphereProps) {
  const host = useRef<HTMLDivElement>(null);
  const [front, back] = [useRef<SVGPathElement>(null), useRef<SVGPathElement>(null)];
  /** The finger on the sun, and how far beside its middle it took hold, in dome radii. */
  const pointer = useRef<{ readonly id: number; readonly drag: SunDrag; readonly beside: Beside } | null>(null);
  const letGo = useRef(() => {});
  const [held, setHeld] = useState(false);
  /** Whether arrow keys have moved it and none was let go since. */
  const stepping = useRef(false);
  /** Where the eye was when it was last looked, for how many frames it has stood still since, and the sun's azimuth. */
  const eye = useRef<{ azimuth: number; still: number; sun: number } | null>(null);
  const { sun_azimuth: azimuth, sun_elevation: elevation } = studio.appearance.value.background;
  const place: SunPlace = { azimuth, elevation };

  const patched = ({ azimuth, elevation }: SunPlace) => ({
    background: {
      // Tenths are finer than any eye and spare the wire.
      sun_azimuth: around(Math.round(azimuth * 10) / 10),
      sun_elevation: Math.min(HIGHEST_SUN, Math.max(LOWEST_SUN, Math.round(elevation * 10) / 10)),
    },
  });
  const drag = (to: SunPlace) => {
    // What is sent is rounded; what is followed is not, or a slow turn would leave the sun behind.
    if (eye.current) {
      eye.current.sun = to.azimuth;
    }
    studio.looks.drag(patched(to));
  };
  const commit = (to: SunPlace) => studio.looks.commit(patched(to));
  const now = (): SunPlace => {
    const { sun_azimuth, sun_elevation } = studio.appearance.peek().background;
    return { azimuth: sun_azimuth, elevation: sun_elevation };
  };

  useEffect(
    () => () => {
      // The panel has gone while the sun was on its way: it stays where it has come to.
      if (pointer.current || (eye.current && eye.current.still < REST_FRAMES)) {
        commit(now());
      }
      letGo.current();
    },
    [],
  );

  useAnimationFrames(true, () => {
    const axes = studio.stage.screenAxes();
    const dome = host.current && domeOver(host.current);
    if (!axes || !dome) {
      return;
    }
    follow(axes);
    const at = shownAt(now(), axes);
    const [x, y] = dome.pixels(at);
    host.current?.style.setProperty("--x", `${x.toFixed(1)}px`);
    host.current?.style.setProperty("--y", `${y.toFixed(1)}px`);
    host.current?.setAttribute("data-behind", String(!at.before));
    if (held) {
      const [before, behind] = ring(now().elevation, axes, dome);
      front.current?.setAttribute("d", before);
      back.current?.setAttribute("d", behind);
    }
  });

  /** A sun that is pinned or held goes round with the eye, so that it keeps its place on the screen. */
  function follow(axes: ScreenAxes): void {
    const looksFrom = azimuthOfEye(axes);
    const last = eye.current;
    if (last === null || !(pinned || held)) {
      eye.current = { azimuth: looksFrom, still: REST_FRAMES, sun: now().azimuth };
      return;
    }
    if (studio.tools.drawing.peek() && !held) {
      // A change of looks amid a stroke would cut it in two for undo; the sun catches up once it is drawn.
      return;
    }
    const turned = ((looksFrom - last.azimuth + 540) % 360) - 180;
    if (Math.abs(turned) > STILL) {
      eye.current = { azimuth: looksFrom, still: 0, sun: last.sun };
      drag({ azimuth: last.sun + turned, elevation: now().elevation });
    } else if (last.still < REST_FRAMES) {
      last.still += 1;
      if (last.still === REST_FRAMES && !held) {
        commit(now());
      }
    }
  }

  const release = (event: PointerEvent) => {
    if (pointer.current?.id !== event.pointerId) {
      return;
    }
    pointer.current = null;
    setHeld(false);
    commit(now());
    letGo.current();
  };
  const step = (event: KeyboardEvent) => {
    const by = event.shiftKey ? BIG_STEP : KEY_STEP;
    const moves: Record<string, readonly [number, number]> = {
      ArrowLeft: [-by, 0],
      ArrowRight: [by, 0],
      ArrowUp: [0, by],
      ArrowDown: [0, -by],
    };
    const move = moves[event.key];
    if (move) {
      event.preventDefault();
      event.stopPropagation();
      const { azimuth, elevation } = now();
      // A key that is held down is one change.
      stepping.current = true;
      drag({ azimuth: azimuth + move[0], elevation: elevation + move[1] });
    }
  };
  const stepped = () => {
    if (stepping.current) {
      stepping.current = false;
      commit(now());
    }
  };
  return (
    <div class="sun" ref={host} data-held={held} data-night={elevation < 0}>
      <svg class="overlay sun-ring" aria-hidden="true">
        <path class="sun-ring-behind" ref={back} />
        <path class="sun-ring-before" ref={front} />
      </svg>
      <div
        class="sun-sphere"
        role="slider"
        tabIndex={0}
        aria-label={say("sun.label")}
        aria-valuemin={0}
        aria-valuemax={360}
        aria-valuenow={Math.round(place.azimuth)}
        aria-valuetext={say("sun.value", {
          azimuth: Math.round(place.azimuth),
          elevation: Math.round(place.elevation),
        })}
        title={say("sun.title")}
        onPointerDown={(event) => {
          const axes = studio.stage.screenAxes();
          const dome = host.current && domeOver(host.current);
          if (pointer.current === null && event.button === 0 && axes && dome) {
            const shown = shownAt(now(), axes);
            const [right, up] = dome.place(event.clientX, event.clientY);
            const beside: Beside = [shown.right - right, shown.up - up];
            pointer.current = { id: event.pointerId, drag: new SunDrag(shown.before), beside };
            event.currentTarget.setPointerCapture(event.pointerId);
            setHeld(true);
            letGo.current = studio.stage.hold();
          }
        }}
        onPointerMove={(event) => {
          const axes = studio.stage.screenAxes();
          const dome = host.current && domeOver(host.current);
          if (
            pointer.current?.id === event.pointerId &&
            axes &&
            dome &&
            (event.movementX !== 0 || event.movementY !== 0)
          ) {
            const [right, up] = dome.place(event.clientX, event.clientY);
            const { beside } = pointer.current;
            drag(standingAt(pointer.current.drag.to(right + beside[0], up + beside[1]), axes));
          }
        }}
        onPointerUp={release}
        onPointerCancel={release}
        onLostPointerCapture={release}
        onKeyDown={step}
        onKeyUp={stepped}
        onBlur={stepped}
      />
      <button
        class="sun-pin"
        type="button"
        aria-label={say("sun.pin")}
        title={say("sun.pin")}
        aria-pressed={pinned}
        onClick={() => setPinned(!pinned)}
      >
        <PinIcon />
      </button>
    </div>
  );
}

/** The dome over the workspace as it is laid out now. */
function domeOver(host: HTMLElement): Dome {
  const bar = host.parentElement?.querySelector(".side-bar");
  return domeOf(host.getBoundingClientRect(), bar?.getBoundingClientRect() ?? null);
}

/** The way the sun takes around the tree at an elevation: what of it is before the tree, and what behind. */
function ring(elevation: number, axes: ScreenAxes, dome: Dome): readonly [before: string, behind: string] {
  const paths = ["", ""];
  let last = -1;
  for (let i = 0; i <= RING_POINTS; i += 1) {
    const place = shownAt({ azimuth: (360 * i) / RING_POINTS, elevation }, axes);
    const [x, y] = dome.pixels(place);
    const side = place.before ? 0 : 1;
    paths[side] += `${side === last ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`;
    last = side;
  }
  return [paths[0] ?? "", paths[1] ?? ""];
}
