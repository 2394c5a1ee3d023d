import { useEffect, useRef, useState } from "preact/hooks";
import type { Studio } from "../../studio";
import type { Stage } from "../../view/stage";
import { say } from "../../words/say";
import { useAnimationFrames } from "../use-animation-frames";

/** How far an arrow key turns, and how far a page key, in degrees. */
const KEY_TURN = 5;
const PAGE_TURN = 45;
/** How long the ruler follows a view that the user may have turned on the workspace, in milliseconds. */
const FOLLOWS = 800;

const DEGREE = Math.PI / 180;

/** A strip as long as one turn of the tree: one hand of the user turns it here while the other draws. */
export function RotationStrip({ studio }: { studio: Studio }) {
  const strip = useRef<HTMLDivElement>(null);
  const pointer = useRef<{ readonly id: number; x: number } | null>(null);
  const letGo = useRef(() => {});
  const [held, setHeld] = useState(false);
  const [degrees, setDegrees] = useState(0);
  const show = () => {
    const { turned } = studio.stage;
    setDegrees(Math.round(turned / DEGREE));
    strip.current?.style.setProperty("--turns", String(turned / (2 * Math.PI)));
  };
  const [followed, follow] = useFollowing(studio.stage, show);

  const { together } = studio;
  useAnimationFrames(held || followed || together.followed.value !== null, show);
  // Somebody else has brought the view elsewhere.
  useEffect(follow, [together.visits.value]);
  // A strip that is hidden while it is dragged lets go of the tree.
  useEffect(() => () => letGo.current(), []);
  const turn = (by: number) => {
    studio.stage.turn(by * DEGREE);
    follow();
  };
  const release = (event: PointerEvent) => {
    if (pointer.current?.id === event.pointerId) {
      pointer.current = null;
      setHeld(false);
      follow();
      letGo.current();
    }
  };
  const keys: Record<string, () => void> = {
    ArrowRight: () => turn(KEY_TURN),
    ArrowUp: () => turn(KEY_TURN),
    ArrowLeft: () => turn(-KEY_TURN),
    ArrowDown: () => turn(-KEY_TURN),
    PageUp: () => turn(PAGE_TURN),
    PageDown: () => turn(-PAGE_TURN),
    Home: () => {
      studio.stage.face();
      follow();
    },
  };
  return (
    <div
      class="panel rotation"
      data-place="rotation"
      ref={strip}
      role="slider"
      tabIndex={0}
      aria-label={say("rotation.label")}
      aria-valuemin={-180}
      aria-valuemax={180}
      aria-valuenow={degrees}
      aria-valuetext={say("rotation.value", { degrees })}
      title={say("rotation.title")}
      data-held={held}
      onPointerDown={(event) => {
        if (pointer.current === null && event.button === 0) {
          pointer.current = { id: event.pointerId, x: event.clientX };
          event.currentTarget.setPointerCapture(event.pointerId);
          setHeld(true);
          letGo.current = studio.stage.hold();
        }
      }}
      onPointerMove={(event) => {
        if (pointer.current?.id === event.pointerId) {
          const width = event.currentTarget.clientWidth || 1;
          studio.stage.turn(((event.clientX - pointer.current.x) / width) * 2 * Math.PI);
          pointer.current.x = event.clientX;
        }
      }}
      onPointerUp={release}
      onPointerCancel={release}
      onLostPointerCapture={release}
      onKeyDown={(event) => {
        const act = keys[event.key];
        if (act) {
          event.preventDefault();
          act();
        }
      }}
    >
      <span class="rotation-ruler" />
      <span class="rotation-mark" />
    </div>
  );
}

/**
 * Whether the view may be turning: for a while after the user touched the page, and when asked to; as long as it
 * takes where frames are slow. `show` shows once more where the view has come to rest.
 */
function useFollowing(stage: Stage, show: () => void): readonly [boolean, () => void] {
  const [followed, setFollowed] = useState(true);
  const timer = useRef(0);
  const follow = () => {
    setFollowed(true);
    clearTimeout(timer.current);
    timer.current = window.setTimeout(() => {
      if (stage.arrived) {
        setFollowed(false);
        show();
      } else {
        follow();
      }
    }, FOLLOWS);
  };
  useEffect(() => {
    follow();
    const stop = new AbortController();
    const options = { signal: stop.signal, capture: true, passive: true };
    for (const kind of ["pointerdown", "pointermove", "pointerup", "keydown"]) {
      addEventListener(kind, follow, options);
    }
    return () => {
      stop.abort();
      clearTimeout(timer.current);
    };
  }, []);
  return [followed, follow];
}
