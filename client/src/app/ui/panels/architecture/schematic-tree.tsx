import { effect } from "@preact/signals";
import { useEffect, useRef, useState } from "preact/hooks";
import type { Parameters } from "../../../../wire/generated";
import { NUMBERS, nameOf, shownValue } from "../../../document/growth/growth-parameters";
import { grownUp } from "../../../document/growth/programme-control";
import { growSchematic } from "../../../document/growth/schematic-api";
import { NewestOnly } from "../../../requests/newest-only";
import { say } from "../../../words/say";
import { useEased } from "./eased";
import { Grip } from "./grip";
import { arc, away, type Place, short } from "./place";
import { layoutOf, pictureOf, type SchematicPicture } from "./schematic-picture";
import { sketchSettled, sketchState } from "./sketch-patience";
import { setpointAt } from "./tropism";
import type { WidgetProps } from "./widget";

/** A seedling, until the server has grown something. */
const SEEDLING: SchematicPicture = { wood: [], leaves: "", aside: 1, above: 1, below: 0 };
/** The thinnest line, in pixels. */
const HAIR = 1.1;
/** Wood is drawn thicker than it is, for in so small a picture it would be lost among its leaves. */
const BOLD = 1.6;
/** How long a server that grew no sketch is left alone, in milliseconds. */
const RETRY_AFTER = 1000;
/** The length of the arrow, as a share of the box's height, and at most in pixels. */
const ARROW = { share: 0.36, most: 84 };
/** A finger takes its tip so far around it, in pixels, which the box has to show. */
const GRIP_RADIUS = 22;

/** A small flat tree that the server grows as the user changes what trees grow by, and on it the arrow of tropism. */
export function SchematicTree({ studio }: WidgetProps) {
  const box = useRef<HTMLDivElement>(null);
  const now = studio.parameters.value;
  const { width, height } = useSize(box);
  const { picture, of, unanswered } = useSketch(studio);
  const state = sketchState(of !== null, unanswered);
  const wanted = layoutOf(picture, width, height);
  const scale = useEased(wanted.scale, false);
  const ground = useEased(wanted.ground, false);
  return (
    <div class="schematic" ref={box} data-grown={of !== null && of === now} data-metamers={picture.wood.length}>
      {width > 0 && (
        <svg width={width} height={height} role="img" aria-label={say("architecture.sketch")}>
          <path class="schematic-ground" d={`M${width * 0.08} ${short(ground)}H${width * 0.92}`} />
          {scale > 0 && (
            <g transform={`translate(${width / 2} ${short(ground)}) scale(${scale} ${-scale})`}>
              {picture.wood.map((stroke) => (
                <path
                  class="schematic-wood"
                  key={stroke.width}
                  d={stroke.path}
                  stroke-width={Math.max(HAIR / scale, BOLD * stroke.width)}
                />
              ))}
              <path
                class="schematic-leaves"
                d={picture.leaves}
                stroke-width={Math.max(2.4 / scale, Math.min(1.2, 0.65 * (now?.leaf_size ?? 1)))}
              />
            </g>
          )}
        </svg>
      )}
      {state !== "grown" && (
        <p class="schematic-note" role="status">
          {say(`architecture.sketch.${state}`)}
        </p>
      )}
      {now !== null && width > 0 && <Arrow {...{ studio, now, width, height }} />}
    </div>
  );
}

interface ArrowProps extends WidgetProps {
  readonly now: Parameters;
  readonly width: number;
  readonly height: number;
}

/** The arrow of the set-point angle θ, from the middle of the crown on; it holds for the other side mirrored. */
function Arrow({ studio, now: { setpoint_angle: theta }, width, height }: ArrowProps) {
  const length = Math.min(ARROW.most, ARROW.share * height, height / 2 - GRIP_RADIUS);
  const from: Place = { x: width / 2, y: height * 0.5 };
  const tip = away(from, theta, length);
  const neck = away(from, theta, length - 13);
  const line = (to: Place) => `M${short(from.x)} ${short(from.y)}L${short(to.x)} ${short(to.y)}`;
  return (
    <>
      <svg class="schematic-arrow" width={width} height={height} aria-hidden="true">
        <path class="arrow-dial" d={arc(from, length, 0, 180)} />
        {[0, 45, 90, 135, 180].map((angle) => {
          const [begin, end] = [away(from, angle, length - 3), away(from, angle, length + 3)];
          return <path class="arrow-dial" key={angle} d={`M${begin.x} ${begin.y}L${end.x} ${end.y}`} />;
        })}
        <path class="arrow-mirror" d={line(away(from, -theta, length - 8))} />
        <path class="arrow-shaft" d={line(neck)} />
        <circle class="arrow-root" cx={from.x} cy={from.y} r={4} />
      </svg>
      <Grip
        label={nameOf(NUMBERS.setpoint_angle)}
        text={shownValue(NUMBERS.setpoint_angle, theta)}
        {...NUMBERS.setpoint_angle}
        value={theta}
        at={tip}
        way="around"
        onPull={(to) => studio.growing.drag(setpointAt(from, to))}
        onValue={(value) => studio.growing.drag({ setpoint_angle: value })}
        onRelease={() => studio.growing.commit()}
      />
    </>
  );
}

/** What the server has grown last. */
interface Sketch {
  readonly picture: SchematicPicture;
  /** The parameters it grew with; none for the seedling. */
  readonly of: Parameters | null;
  /** How often in a row it was asked for a newer one and grew none. */
  readonly unanswered: number;
}

/** The tree of the parameters as the user has them; the old one stays until the new one is there. */
function useSketch(studio: WidgetProps["studio"]): Sketch {
  const [sketch, setSketch] = useState<Sketch>({ picture: SEEDLING, of: null, unanswered: 0 });
  useEffect(() => {
    let retry: ReturnType<typeof setTimeout> | undefined;
    const gardener = new NewestOnly(
      async (of: Parameters) => ({ picture: pictureOf(await growSchematic(matured(studio, of))), of, unanswered: 0 }),
      (sketch) => {
        setSketch(sketch);
        sketchSettled.value = true;
      },
      () => {
        setSketch((sketch) => ({ ...sketch, unanswered: sketch.unanswered + 1 }));
        sketchSettled.value = true;
        // A server that is busy, or comes back, is asked again.
        clearTimeout(retry);
        retry = setTimeout(ask, RETRY_AFTER);
      },
    );
    const ask = () => {
      const now = studio.parameters.peek();
      if (now !== null) {
        gardener.ask(now);
      }
    };
    const stop = effect(() => {
      if (studio.parameters.value !== null) {
        void studio.programme.inForce.value;
        ask();
      }
    });
    return () => {
      stop();
      clearTimeout(retry);
      gardener.stop();
    };
  }, [studio]);
  return sketch;
}

/** What the sketch grows by: by a programme the tree that it leads to, for a young one shows nothing of it. */
function matured(studio: WidgetProps["studio"], now: Parameters): Parameters {
  const programme = studio.programme.inForce.peek()?.programme;
  return programme ? grownUp(programme, studio.document.peek()?.age ?? 0, now) : now;
}

function useSize(element: { readonly current: HTMLElement | null }): {
  readonly width: number;
  readonly height: number;
} {
  const [size, setSize] = useState({ width: 0, height: 0 });
  useEffect(() => {
    if (!element.current) {
      return undefined;
    }
    const observer = new ResizeObserver(([entry]) => {
      if (entry) {
        const { width, height } = entry.contentRect;
        setSize({ width, height });
      }
    });
    observer.observe(element.current);
    return () => observer.disconnect();
  }, [element]);
  return size;
}
