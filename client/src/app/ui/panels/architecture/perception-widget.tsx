import { NUMBERS, nameOf, shownValue, WIDGETS } from "../../../document/growth/growth-parameters";
import { say } from "../../../words/say";
import { Grip } from "./grip";
import { angleAt, depthAt, type Perception, Rings, zoneAt } from "./perception";
import { arc, away, type Place, short } from "./place";
import { Diagram, WidgetFrame, type WidgetProps } from "./widget";

const [WIDTH, HEIGHT] = [196, 204];
const BUD: Place = { x: 98, y: 114 };
const RINGS = new Rings(84);
/** Grips stand outside what they pull at. */
const OUTSIDE = 15;
/** The grip of the angle goes around on this circle, in pixels. */
const DIAL = 88;

/** Markers of free space: directions in degrees and distances in internodes, strewn evenly as a sunflower's seeds. */
const MARKERS = Array.from({ length: 64 }, (_, i) => ({
  direction: (i * 137.508) % 360,
  distance: 15 * ((i + 0.6) / 64) ** 1.1,
}));

/** What a bud occupies and perceives: r, d and ζ (Figure 8B). */
export function PerceptionWidget({ studio }: WidgetProps) {
  const now = studio.parameters.value;
  if (now === null) {
    return null;
  }
  const { occupancy_radius: r, perception_depth: d, perception_angle: zeta } = now;
  const [zone, rim] = [RINGS.pixels(r), RINGS.pixels(r + d)];
  const drawn = MARKERS.map((marker) => {
    const { x, y } = away(BUD, marker.direction, RINGS.pixels(marker.distance));
    return { x, y, fate: fateOf(marker, now) };
  });
  const edge = away(BUD, zeta / 2, DIAL);
  const growth = growthOf(now);
  return (
    <WidgetFrame
      studio={studio}
      title={say("architecture.perception")}
      help={say("architecture.perception.help")}
      parameters={WIDGETS.perception}
    >
      <Diagram
        width={WIDTH}
        height={HEIGHT}
        drawing={
          <>
            <path class="limb side" d={`M${BUD.x} ${HEIGHT}V${BUD.y}`} />
            <path class="seen" d={coneOf(zone, rim, zeta)} />
            <path class="guide" d={`M${BUD.x} ${BUD.y}L${short(edge.x)} ${short(edge.y)}`} />
            {drawn.map(({ x, y, fate }) => (
              <circle class={`marker ${fate}`} key={`${x} ${y}`} cx={x} cy={y} r={fate === "claimed" ? 2.6 : 1.7} />
            ))}
            <circle class="zone" cx={BUD.x} cy={BUD.y} r={zone} />
            {growth && <path class="heading" d={arrowTo(growth)} />}
            <path class="bud" d={`M${BUD.x - 5} ${BUD.y + 4}q-2 -8 5 -15q7 7 5 15q-5 4 -10 0Z`} />
          </>
        }
      >
        <Grip
          label={nameOf(NUMBERS.perception_angle)}
          text={shownValue(NUMBERS.perception_angle, zeta)}
          {...NUMBERS.perception_angle}
          value={zeta}
          at={edge}
          way="around"
          onPull={(to) => studio.growing.drag(angleAt(BUD, to))}
          onValue={(value) => studio.growing.drag({ perception_angle: value })}
          onRelease={() => studio.growing.commit()}
        />
        <Grip
          label={nameOf(NUMBERS.perception_depth)}
          text={shownValue(NUMBERS.perception_depth, d)}
          {...NUMBERS.perception_depth}
          value={d}
          at={{ x: BUD.x, y: BUD.y - rim - OUTSIDE }}
          way="upright"
          onPull={(to) => studio.growing.drag(depthAt(RINGS.internodes(BUD.y - to.y - OUTSIDE), now))}
          onValue={(value) => studio.growing.drag({ perception_depth: value })}
          onRelease={() => studio.growing.commit()}
        />
        <Grip
          label={nameOf(NUMBERS.occupancy_radius)}
          text={shownValue(NUMBERS.occupancy_radius, r)}
          {...NUMBERS.occupancy_radius}
          value={r}
          at={{ x: BUD.x - zone - OUTSIDE, y: BUD.y }}
          way="level"
          onPull={(to) => studio.growing.drag(zoneAt(RINGS.internodes(BUD.x - to.x - OUTSIDE)))}
          onValue={(value) => studio.growing.drag({ occupancy_radius: value })}
          onRelease={() => studio.growing.commit()}
        />
      </Diagram>
    </WidgetFrame>
  );
}

interface Marker {
  readonly direction: number;
  readonly distance: number;
}

type Fate = "occupied" | "claimed" | "unseen";

function fateOf(
  { direction, distance }: Marker,
  { occupancy_radius: r, perception_depth: d, perception_angle }: Perception,
): Fate {
  if (distance < r) {
    return "occupied";
  }
  const aside = Math.min(direction, 360 - direction);
  return distance <= r + d && aside <= perception_angle / 2 ? "claimed" : "unseen";
}

/** From the bud the mean of the directions of the markers it claims (E); null where they cancel. */
function growthOf(perception: Perception): Place | null {
  const claimed = MARKERS.filter((marker) => fateOf(marker, perception) === "claimed");
  const sum = claimed.reduce<Place>((total, { direction }) => away(total, direction, 1), { x: 0, y: 0 });
  const [x, y] = [sum.x / Math.max(1, claimed.length), sum.y / Math.max(1, claimed.length)];
  return Math.hypot(x, y) < 0.15 ? null : { x: BUD.x + 46 * x, y: BUD.y + 46 * y };
}

function arrowTo(tip: Place): string {
  const direction = (Math.atan2(tip.x - BUD.x, BUD.y - tip.y) * 180) / Math.PI;
  const [left, right] = [away(tip, direction + 150, 8), away(tip, direction - 150, 8)];
  const point = ({ x, y }: Place) => `${short(x)} ${short(y)}`;
  return `M${point(BUD)}L${point(tip)}M${point(left)}L${point(tip)}L${point(right)}`;
}

/** A ring's part between two circles, as wide as the angle of perception. */
function coneOf(inner: number, outer: number, angle: number): string {
  if (angle >= 359.5) {
    const ring = (radius: number) => `${arc(BUD, radius, -179.99, 0)}${arc(BUD, radius, 0, 179.99).replace("M", "L")}Z`;
    return ring(outer) + ring(inner);
  }
  return `${arc(BUD, outer, -angle / 2, angle / 2)}${arc(BUD, inner, angle / 2, -angle / 2).replace("M", "L")}Z`;
}
