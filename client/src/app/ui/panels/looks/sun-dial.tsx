import { useRef } from "preact/hooks";
import type { AppearancePatch } from "../../../../wire/generated";
import {
  clockText,
  daylight,
  type SunPlace,
  sunAt,
  type TimeOfDay,
  timeAt,
  typedHours,
} from "../../../document/appearance/day";
import { LOOK_NUMBERS, type LookNumber, standardOf } from "../../../document/appearance/look-numbers";
import type { Studio } from "../../../studio";
import { onStep } from "../../../words/number-text";
import { say } from "../../../words/say";
import { Field } from "../../controls/field";
import { Polar } from "../../controls/polar";
import { Slider } from "../../controls/slider";
import { TypedNumber } from "../../controls/typed-number";
import { useAnimationFrames } from "../../use-animation-frames";

/** Radius of the dial's ring and of the arc, of 60 from the middle of the drawing to its edge. */
const RING = 44;
const ARC = 76;
/** The foot of the arc's tree, left of the middle and below it. */
const FOOT = { x: -34, y: 38 } as const;

const radians = (degrees: number) => (degrees * Math.PI) / 180;
const degrees = (radians: number) => (radians * 180) / Math.PI;

/** Where the sun is: by the time of day, by its direction, by its height. */
export function SunDial({ studio }: { studio: Studio }) {
  const { sun_azimuth: azimuth, sun_elevation: elevation } = studio.appearance.value.background;
  const placed = (place: Partial<SunPlace>): AppearancePatch => ({
    background: {
      ...(place.azimuth === undefined ? {} : { sun_azimuth: place.azimuth }),
      ...(place.elevation === undefined ? {} : { sun_elevation: place.elevation }),
    },
  });
  const drag = (place: Partial<SunPlace>) => studio.looks.drag(placed(place));
  const commit = (place: Partial<SunPlace>) => studio.looks.commit(placed(place));
  const turned = () => degrees(studio.stage.turned);
  return (
    <>
      <TimeSlider place={{ azimuth, elevation }} drag={drag} commit={commit} />
      <div class="sun-dials">
        <Polar
          label={say("background.sun_azimuth")}
          {...LOOK_NUMBERS["background.sun_azimuth"]}
          unit="°"
          wraps
          value={azimuth}
          valueAt={(x, y) => (Math.hypot(x, y) < 0.12 ? null : degrees(Math.atan2(x, y)) - turned())}
          onDrag={(to) => drag({ azimuth: to })}
          onCommit={(to) => commit({ azimuth: to })}
        >
          <Ring azimuth={azimuth} elevation={elevation} turned={turned} />
        </Polar>
        <Polar
          label={say("background.sun_elevation")}
          {...LOOK_NUMBERS["background.sun_elevation"]}
          unit="°"
          value={elevation}
          valueAt={(x, y) => degrees(Math.atan2(FOOT.y - 60 * y, Math.max(0, 60 * x - FOOT.x)))}
          onDrag={(to) => drag({ elevation: to })}
          onCommit={(to) => commit({ elevation: to })}
        >
          <Arc elevation={elevation} />
        </Polar>
      </div>
      <Typed name="background.sun_azimuth" value={azimuth} set={(to) => commit({ azimuth: to })} />
      <Typed name="background.sun_elevation" value={elevation} set={(to) => commit({ elevation: to })} />
    </>
  );
}

interface TimeSliderProps {
  readonly place: SunPlace;
  readonly drag: (place: SunPlace) => void;
  readonly commit: (place: SunPlace) => void;
}

/** Where the sun stands before anyone has moved it. */
const STANDARD_PLACE: SunPlace = {
  azimuth: standardOf("background.sun_azimuth"),
  elevation: standardOf("background.sun_elevation"),
};

/** The sun's way over the day it is on, from dawn to dusk. */
function TimeSlider({ place, drag, commit }: TimeSliderProps) {
  // While the user moves it stays on one day, however the sun's place is rounded.
  const day = useRef<TimeOfDay | null>(null);
  const { hours, declination } = day.current ?? timeAt(place);
  const [dawn, dusk] = daylight(declination);
  const step = 0.05;
  const at = (to: number) => sunAt({ hours: Math.min(dusk, Math.max(dawn, to)), declination });
  return (
    <Slider
      label={say("background.time")}
      help={say("background.time.help")}
      least={Math.ceil(dawn / step) * step}
      most={Math.floor(dusk / step) * step}
      step={step}
      value={onStep(timeAt(place).hours, 0, 24, step)}
      standard={onStep(timeAt(STANDARD_PLACE).hours, 0, 24, step)}
      onReset={() => commit(STANDARD_PLACE)}
      notation={{ write: clockText, read: typedHours }}
      onDrag={(to) => {
        day.current ??= { hours, declination };
        drag(at(to));
      }}
      onCommit={(to) => {
        day.current = null;
        commit(at(to));
      }}
    />
  );
}

function Typed({ name, value, set }: { name: LookNumber; value: number; set: (value: number) => void }) {
  const { least, most, step, unit = "" } = LOOK_NUMBERS[name];
  const standard = standardOf(name);
  return (
    <Field
      label={say(name)}
      help={say(`${name}.help`)}
      onReset={Math.abs(value - standard) < step / 2 ? undefined : () => set(standard)}
      end={<TypedNumber label={say(name)} {...{ least, most, step, unit, value }} onCommit={set} />}
    />
  );
}

/** The sun around the tree, seen from above; below is who looks at it, wherever they have gone. */
function Ring({ azimuth, elevation, turned }: SunPlace & { turned: () => number }) {
  const group = useRef<SVGGElement>(null);
  useAnimationFrames(true, () => group.current?.setAttribute("transform", `rotate(${-(azimuth + turned())})`));
  const shadow = Math.min(40, 10 / Math.max(0.2, Math.tan(radians(Math.max(1, elevation)))));
  return (
    <svg viewBox="-60 -60 120 120" aria-hidden="true">
      <circle r={RING} class="dial-track" />
      <path d="M-5 58 0 52 5 58Z" class="dial-viewer" />
      <g ref={group}>
        {elevation > 0 && <ellipse cy={-shadow / 2} rx="9" ry={9 + shadow / 2} class="dial-shadow" />}
        <SunKnob x={0} y={RING} night={elevation < 0} />
      </g>
      <circle r="11" class="dial-crown" />
      <circle r="5" cx="-3" cy="-3" class="dial-crown-light" />
    </svg>
  );
}

/** The sun above the horizon, seen from the side. */
function Arc({ elevation }: { elevation: number }) {
  const point = (degrees: number) =>
    [FOOT.x + ARC * Math.cos(radians(degrees)), FOOT.y - ARC * Math.sin(radians(degrees))] as const;
  const [low, high, sun] = [point(-10), point(90), point(elevation)];
  return (
    <svg viewBox="-60 -60 120 120" aria-hidden="true">
      <path d={`M${low.join(" ")}A${ARC} ${ARC} 0 0 0 ${high.join(" ")}`} class="dial-track" />
      <path d={`M-56 ${FOOT.y}H56`} class="dial-horizon" />
      <path d={`M${FOOT.x} ${FOOT.y}v-14`} class="dial-trunk" />
      <circle cx={FOOT.x} cy={FOOT.y - 20} r="11" class="dial-crown" />
      <circle cx={FOOT.x + 3} cy={FOOT.y - 23} r="5" class="dial-crown-light" />
      <SunKnob x={sun[0]} y={sun[1]} night={elevation < 0} />
    </svg>
  );
}

function SunKnob({ x, y, night }: { x: number; y: number; night: boolean }) {
  return (
    <g transform={`translate(${x} ${y})`} class="sun-knob" data-night={night}>
      <circle r="15" class="sun-halo" />
      <circle r="9" class="sun-disc" />
    </g>
  );
}
